// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lines that may cut a warp's cell, in shared memory. The sites are gathered once, one site per
// lane. When only weights change, only the distances of the lines are computed again.
#ifndef CGAL_POWER_RTF_CUDA_WARP_LINES_CUH
#define CGAL_POWER_RTF_CUDA_WARP_LINES_CUH

#include "Warp_clipping.cuh"
#include "near_sites.cuh"

#include <CGAL/PowerRTF/cells/construct_cell.h>

namespace CGAL::PowerRTF::device {

template <class Real>
class Warp_lines : public Warp_clipping<Real> {
  using Base = Warp_clipping<Real>;

public:
  __device__ Warp_lines(const Group_view<Real>& view, Warp_cell_memory<Real>& memory, int place,
                        int lane)
      : Base(memory, lane), m_view(view), m_place(place), m_site(load(view.sites + place)),
        m_own(load(view.normals + place)), m_frame(m_own.normal)
  {}

  const __device__ Packed_site<Real>& site() const { return m_site; }
  const __device__ Tangent_frame<Real>& frame() const { return m_frame; }

protected:
  using Base::m_lane;
  using Base::m_memory;
  using Base::m_polygon;
  using Base::place_of_edge;
  using Base::place_of_line;

  /// The sites whose planes may come within `radius`.
  __device__ Group_query<Real> cutting_query(Real radius, Real own_weight) const
  {
    Group_query<Real> query;
    query.lo = query.hi = m_site.point;
    query.radius = radius;
    query.min_weight = own_weight;
    return query;
  }

  /// Lists the sites for `reach`; `weights`: those of (*). Where they are too many, the polygons
  /// within the square of half-size `half` are cut and the sites are forgotten.
  template <class Weights>
  __device__ void gather(Kept_sites<Real>& kept, Real half, Real reach, const Weights& weights)
  {
    kept = Kept_sites<Real>();
    kept.reach = reach;
    m_flushes = 0;
    __syncwarp();
    if (m_lane < 2) m_memory.sizes[m_lane] = m_memory.corner[m_lane] = 0;
    const Real reach2 = reach * reach;
    const auto add = [&](const Site_batch<Real>& batch) {
      unsigned lanes[batch.size];
      int found = 0;
#pragma unroll
      for (int l = 0; l < batch.size; ++l) {
        const int place = batch.places[l];
        bool offered = place >= 0 && place != m_place && batch.normals[l].patch == m_own.patch;
        if (offered) {
          const Real d2 = squared_length(batch.sites[l].point - m_site.point);
          const Real power = d2 + (weights.own_weight - weights.listed(batch.sites[l], place));
          offered = !(d2 > reach2 && power > 0 && power * power > 4 * d2 * reach2);
        }
        lanes[l] = __ballot_sync(full_warp, offered);
        found += __popc(lanes[l]);
      }
      if (kept.lines + found > Warp_cell_memory<Real>::max_lines) {
        flush(kept, half, weights);
        return false; // so that the batch need not stay in registers meanwhile
      }
#pragma unroll
      for (int l = 0; l < batch.size; ++l) {
        if (lanes[l] >> m_lane & 1) {
          const bool is_compatible =
              are_compatible(m_own.normal, batch.normals[l].normal, m_view.cos_angle);
          m_memory.neighbor[kept.lines + __popc(lanes[l] & ((1u << m_lane) - 1))] =
              is_compatible ? batch.places[l] : -1 - batch.places[l];
        }
        kept.lines += __popc(lanes[l]);
      }
      return true;
    };
    for_each_near_site(m_view, m_memory.stack, cutting_query(reach, weights.own_weight), m_lane,
                       add);
    __syncwarp();
  }

  /// c of the line a x + b y <= c of the site at `place`, which is sqrt(d2) away.
  __device__ Real constant_of_line(bool has_direction, Real d2, Real own_weight, Real weight,
                                   int place) const
  {
    const Real power = d2 + (own_weight - weight);
    if (has_direction) return power / 2;
    // Parallel to the tangent plane, or a duplicate: the first one wins.
    const bool cuts_all =
        power < 0 || (power == 0 && m_view.caller[place] < m_view.caller[m_place]);
    return cuts_all ? Real(-1) : Real(1); // 0 <= c is true nowhere or everywhere
  }

  /// Computes the lines of the sites in memory, with the current weights.
  template <class Weights>
  __device__ void set_lines(const Kept_sites<Real>& kept, const Weights& weights)
  {
    constexpr int at_once = 2;
    m_nearest2 = Real(1e30);
    for (int first = m_lane; first < kept.lines; first += 32 * at_once) {
      int places[at_once];
      Packed_site<Real> sites[at_once];
#pragma unroll
      for (int l = 0; l < at_once; ++l) { // their loads wait together
        const int k = first + 32 * l;
        places[l] = place_of_line(m_memory.neighbor[k < kept.lines ? k : first]);
        sites[l] = load(m_view.sites + places[l]);
      }
#pragma unroll
      for (int l = 0; l < at_once; ++l) {
        const int k = first + 32 * l;
        if (k >= kept.lines) continue;
        const Vec3<Real> offset = sites[l].point - m_site.point;
        const Real d2 = squared_length(offset);
        const auto [a, b] = m_frame.components(offset, d2);
        const bool has_direction = a * a + b * b > 0;
        m_nearest2 = fmin(m_nearest2, d2);
        m_memory.a[k] = a;
        m_memory.b[k] = b;
        m_memory.c[k] = constant_of_line(has_direction, d2, weights.own_now,
                                         weights.current(sites[l], places[l]), places[l]);
        m_memory.d2[k] = d2;
      }
    }
    __syncwarp();
  }

  /// The same, where only weights have changed.
  template <class Weights>
  __device__ void renew_lines(const Kept_sites<Real>& kept, const Weights& weights)
  {
    m_nearest2 = Real(1e30);
    struct Waiting {
      int place;
      typename Weights::Record record;
    };
    const auto read = [&](int k) {
      const int place = place_of_line(m_memory.neighbor[k]);
      return Waiting{place, weights.record(place)};
    };
    Waiting now{}, next{}; // the line's site, and that of the one after it
    int k = m_lane;
    if (k < kept.lines) now = read(k);
    if (k + 32 < kept.lines) next = read(k + 32);
#pragma unroll 1
    for (; k < kept.lines; k += 32) {
      const Waiting own = now;
      now = next;
      if (k + 64 < kept.lines) next = read(k + 64);
      const Real d2 = m_memory.d2[k];
      m_nearest2 = fmin(m_nearest2, d2);
      m_memory.c[k] = constant_of_line(m_memory.a[k] != 0 || m_memory.b[k] != 0, d2,
                                       weights.own_now, weights.current(own.record), own.place);
    }
    __syncwarp();
  }

  /// Cuts the polygons by the waiting lines and forgets them.
  template <class Weights>
  __device__ void flush(Kept_sites<Real>& kept, Real half, const Weights& weights)
  {
    __syncwarp();
    if (m_flushes++ == 0) {
      m_polygon.set_square(half, m_lane);
      m_wide.set_square(half, m_lane);
    }
    set_lines(kept, weights);
    // After both rounds each polygon is in its place.
#pragma unroll 1
    for (const unsigned kinds : {Base::compatible_lines, Base::all_lines}) {
      this->clip(kept.lines, kinds);
      if (m_lane < m_polygon.size && m_polygon.edge >= 0)
        m_polygon.edge = -5 - place_of_edge(m_polygon.edge);
      const Warp_polygon<Real> polygon = m_polygon;
      m_polygon = m_wide;
      m_wide = polygon;
    }
    kept.lines = 0;
    __syncwarp();
  }

  const Group_view<Real>& m_view;
  int m_place;
  Packed_site<Real> m_site;
  Packed_normal<Real> m_own;
  Tangent_frame<Real> m_frame;
  Warp_polygon<Real> m_wide; // by all lines, while lines are forgotten
  int m_flushes = 0;         // how often they were
  Real m_nearest2;           // of the waiting lines' sites, the lane's ones
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WARP_LINES_CUH
