// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sites near one site and their distances, by a warp.
#ifndef CGAL_POWER_RTF_CUDA_NEAR_SITES_CUH
#define CGAL_POWER_RTF_CUDA_NEAR_SITES_CUH

#include "warp_search.cuh"

namespace CGAL::PowerRTF::device {

/// The lane's sites of up to two groups, loaded together to overlap the latencies.
template <class Real>
struct Site_batch {
  static constexpr int size = 2;
  Packed_site<Real> sites[size];
  Packed_normal<Real> normals[size];
  int places[size]; ///< -1: none
};

/// Calls `f(batch)` on all lanes together for all sites of the groups that the query reaches; where
/// it returns false, once more.
template <class Real, class F>
__device__ inline void for_each_near_site(const Group_view<Real>& view, Search_stack& stack,
                                          const Group_query<Real>& query, int lane, F&& f)
{
  search_groups(view, stack, query, lane, [&](bool reached, int group) {
    for (unsigned left = __ballot_sync(full_warp, reached); left != 0;) {
      Site_batch<Real> batch;
      unsigned others = left;
#pragma unroll
      for (int k = 0; k < batch.size; ++k) {
        batch.places[k] = -1;
        if (others == 0) continue;
        const int place = 32 * __shfl_sync(full_warp, group, lowest_bit(others)) + lane;
        others &= others - 1;
        if (place >= view.tree.items) continue;
        batch.places[k] = place;
        batch.sites[k] = load(view.sites + place);
        batch.normals[k] = load(view.normals + place);
      }
      if (f(batch)) left = others;
    }
  });
}

template <class Real>
struct Neighbor_distances {
  Real first, sixth;
};

/// What is compatible, by the cosine of the angle between normals (-2: everything).
template <class Real>
struct Neighbor_angles {
  Real first, sixth;
};

/// Distances of the site at `place` to the nearest and to the sixth site of its patch that are
/// compatible by `angles`; see `distance_to_neighbor()`. `guess` is where the search begins;
/// `wanted`: 1 or 6. (Not inlined: its registers would count for every caller.)
template <class Real>
__device__ __noinline__ Neighbor_distances<Real>
neighbor_distances(const Group_view<Real>& view, Search_stack& stack, int place, Real guess,
                   Neighbor_angles<Real> angles, int wanted, int lane)
{
  constexpr Real infinity = Real(1e30);
  const Packed_site<Real> own_site = load(view.sites + place);
  const Packed_normal<Real> own = load(view.normals + place);
  const auto distance = [=](Real d2) { return d2 < infinity ? std::sqrt(d2) : Real(0); };
  Group_query<Real> query;
  query.lo = query.hi = own_site.point;
  query.min_weight = infinity; // what is nearer than the radius, whatever the weights
  for (query.radius = guess > 0 ? guess : Real(1);; query.radius *= 2) {
    Real first = infinity;
    Real nearest[6] = {infinity, infinity, infinity, infinity, infinity, infinity};
    int seen = 0;
    for_each_near_site(view, stack, query, lane, [&](const Site_batch<Real>& batch) {
#pragma unroll
      for (int l = 0; l < batch.size; ++l) {
        const int other = batch.places[l];
        seen += __popc(__ballot_sync(full_warp, other >= 0));
        if (other < 0 || other == place) continue;
        Real d2 = squared_length(batch.sites[l].point - own_site.point);
        const Packed_normal<Real>& normal = batch.normals[l];
        if (!(d2 < nearest[5] || d2 < first) || normal.patch != own.patch) continue;
        if (are_compatible(normal.normal, own.normal, angles.first)) first = fmin(first, d2);
        if (!are_compatible(normal.normal, own.normal, angles.sixth)) continue;
#pragma unroll
        for (int k = 0; k < 6; ++k) {
          const Real nearer = fmin(nearest[k], d2);
          d2 = fmax(nearest[k], d2);
          nearest[k] = nearer;
        }
      }
      return true;
    });
    first = warp_min_nonnegative(first);
    Real last = 0, needed = first;
    for (int k = 0; k < 6 && wanted == 6; ++k) { // the least of all lanes
      const Real least = warp_min_nonnegative(nearest[0]);
      const unsigned lanes = __ballot_sync(full_warp, nearest[0] == least);
      if (lane == __ffs(int(lanes)) - 1) {
#pragma unroll
        for (int l = 0; l < 5; ++l) nearest[l] = nearest[l + 1];
        nearest[5] = infinity;
      }
      if (least < infinity) last = least;
      needed = fmax(first, least);
    }
    // Within the query's radius nothing is missed.
    if (needed <= query.radius * query.radius || seen == view.tree.items)
      return {distance(first), std::sqrt(last)};
  }
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_NEAR_SITES_CUH
