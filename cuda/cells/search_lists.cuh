// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The neighbour search: for every cell, the list of the compatible sites that may cut it as long as
// it stays within a radius. A warp gathers for its 32 cells together.
#ifndef CGAL_POWER_RTF_CUDA_SEARCH_LISTS_CUH
#define CGAL_POWER_RTF_CUDA_SEARCH_LISTS_CUH

#include "group_cells.cuh"

namespace CGAL {
namespace PowerRTF {
namespace device {

/// Lists the groups that sites may come from which cut one of the cells of the lanes with `wants`.
template <class Real>
__device__ inline void keep_groups(const Group_view<Real>& view, const Kept_lists<Real>& lists,
                                   Search_stack& stack, const Lane_cell<Real>& cell, bool wants,
                                   int group, int lane)
{
  constexpr Real further = 2; // than the lists' radius
  const Real radius = further * warp_max(wants ? cell.radius : Real(0));
  int* const out = lists.groups + group * Kept_lists<Real>::most_groups;
  int found = 0;
  for (unsigned lanes; (lanes = __ballot_sync(full_warp, wants)) != 0;) {
    const bool is_near = is_near_lane(cell, __ffs(int(lanes)) - 1);
    const Group_query<Real> query = query_of_lanes(cell, wants && is_near, radius);
    wants = wants && !is_near;
    search_groups(view, stack, query, lane, [&](bool reached, int k) {
      const unsigned reaching = __ballot_sync(full_warp, reached);
      const int at = found + __popc(reaching & ((1u << lane) - 1));
      if (reached && at < Kept_lists<Real>::most_groups) out[at] = k;
      found += __popc(reaching);
    });
  }
  if (lane == 0) {
    lists.group_sizes[group] = found <= Kept_lists<Real>::most_groups ? found : -1;
    lists.group_radius[group] = radius;
  }
}

/// The shared memory of a warp of the search.
template <class Real>
struct List_memory {
  static constexpr int most_candidates = 192, most_listed = 32;
  Packed_site<Real> sites[most_candidates];
  int places[most_candidates];
  unsigned char listed[most_listed * 32]; ///< numbers of candidates, one column per lane
  Search_stack stack;

  __device__ List_memory() {}
};

/// The former edges of a lane's cell, if all of them are still compatible.
template <class Real>
struct Former_edges {
  static constexpr int most = 8;
  int count = 0;
  int places[most];

  template <class Compatible>
  __device__ Former_edges(const Kept_lists<Real>& lists, int place, bool known,
                          const Compatible& is_compatible)
  {
    const int sizes = known ? lists.sizes[place] : Kept_lists<Real>::none;
    count = sizes == Kept_lists<Real>::none || sizes >> 8 > most ? 0 : sizes >> 8;
    bool all = true;
#pragma unroll
    for (int k = 0; k < most; ++k)
      places[k] = k < count ? lists.neighbors[std::size_t(k) * lists.stride + place] : -1;
#pragma unroll
    for (int k = 0; k < most; ++k) all = all && (k >= count || is_compatible(places[k]));
    if (all) return;
    count = 0;
#pragma unroll
    for (int k = 0; k < most; ++k) places[k] = -1;
  }
  __device__ bool has(int place) const
  {
    bool found = false;
#pragma unroll
    for (int k = 0; k < most; ++k) found |= places[k] == place;
    return found;
  }
};

template <class Real>
constexpr int search_warps = 2; // of a block: it is there until the slower one is done

/// Lists for radii of `growth` times the last ones; one warp per 32 sites. `former`: the lists'
/// places are those of the present order. `groups`: also the groups near each group.
template <class Real>
__global__ void __launch_bounds__(32 * search_warps<Real>, sizeof(Real) == 4 ? 12 : 8)
search_lists_kernel(const __grid_constant__ Group_view<Real> view,
                    const __grid_constant__ Kept_lists<Real> lists, const Real* radius, Real growth,
                    bool former, bool groups)
{
  using Memory = List_memory<Real>;
  __shared__ Memory memories[search_warps<Real>];
  Memory& memory = memories[threadIdx.x / 32];
  const int lane = threadIdx.x % 32;
  const int place = blockIdx.x * blockDim.x + threadIdx.x, group = place / 32;
  if (group * 32 >= view.tree.items) return;
  const bool exists = place < view.tree.items;
  Lane_cell<Real> cell;
  cell.place = exists ? place : view.tree.items - 1;
  cell.site = load(view.sites + cell.place);
  const int id = view.caller[cell.place];
  const Real last_radius = exists && id < view.cells ? radius[id] : Real(-1);
  cell.radius = last_radius * growth;
  const bool wants = last_radius > 0; // else no list could be complete, or none is known

  const Packed_normal<Real> own = load(view.normals + cell.place);
  const auto is_compatible = [&](int j) {
    const Packed_normal<Real> other = load(view.normals + j);
    return other.patch == own.patch &&
           !(view.cos_angle > -1 && !(dot(own.normal, other.normal) > view.cos_angle));
  };

  // Along the curve there are jumps, of any length: the lanes near the first one go first.
  bool waits = wants;
  int size = 0, edges = 0;
  for (unsigned lanes; (lanes = __ballot_sync(full_warp, waits)) != 0;) {
    const bool is_near = is_near_lane(cell, __ffs(int(lanes)) - 1), now = waits && is_near;
    waits = waits && !is_near;
    const Former_edges<Real> first(lists, place, former && now, is_compatible);
    if (now) size = edges = first.count;
    int gathered = 0;
    // Takes those of the gathered sites that may cut the lane's cell into its list.
    const auto list = [&]() {
      __syncwarp();
      unsigned char* const column = memory.listed + lane;
      const int before = cell.listed;
      if (now)
        cell.list(memory, gathered, view.guard_factor, 0, 1, [&](int number, int k) {
          if (number - before < Memory::most_listed)
            column[(number - before) * 32] = static_cast<unsigned char>(k);
        });
      const int listed = cell.listed - before;
      if (listed > Memory::most_listed) size = Kept_lists<Real>::capacity + 1;
      for (int k = 0; k < listed && k < Memory::most_listed; ++k) {
        const int j = memory.places[column[k * 32]];
        if (first.has(j) || !is_compatible(j)) continue;
        if (size < Kept_lists<Real>::capacity)
          lists.neighbors[std::size_t(size) * lists.stride + place] = j;
        ++size;
      }
      gathered = 0;
      __syncwarp();
    };
    const Real most_radius = warp_max(now ? cell.radius : Real(0));
    search_sites(view, memory.stack, query_of_lanes(cell, now, most_radius), lane,
                 [&](bool reached, const Packed_site<Real>& site, int j) {
                   const unsigned reaching = __ballot_sync(full_warp, reached);
                   if (gathered + __popc(reaching) > Memory::most_candidates) list();
                   const int k = gathered + __popc(reaching & ((1u << lane) - 1));
                   if (reached) {
                     memory.sites[k] = site;
                     memory.places[k] = j;
                   }
                   gathered += __popc(reaching);
                 });
    list();
  }
  if (groups) keep_groups(view, lists, memory.stack, cell, wants, group, lane);
  if (!exists) return;
  const bool kept = wants && size <= Kept_lists<Real>::capacity && cell.near <= 6 &&
                    view.guard_factor >= 1;
  lists.sizes[place] =
      kept ? static_cast<unsigned short>(size + 256 * edges) : Kept_lists<Real>::none;
  lists.radius[place] = cell.radius;
  lists.outside[place] = std::fmin(cell.radius, std::sqrt(cell.outside2));
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_SEARCH_LISTS_CUH
