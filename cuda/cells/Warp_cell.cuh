// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `construct_cell()` by a warp, for cells that are guarded, empty, irregular or at a feature: the
// sites are gathered once, a lane looks at one site; then all lines that wait are tried against the
// polygon together, and the nearest one that cuts it is cut off. Cells with more than 32 edges are
// incomplete.
//
// What is known. `gather(reach)` lists every site j of the patch but those with
//   d >= reach  and  d^2 - 2 d reach > w_j - w_i                                            (*)
// whose planes pass beyond `reach`. When weights change, these pass beyond reach - g / (2 reach) as
// long as w_j - w_i has grown by no more than g (see Kept_lists.h). With k > guard radius known in
// this way the cell within the guard square is
// - empty, when the listed lines leave nothing;
// - ok, when they leave a polygon of radius at most the guard radius: no other line reaches it;
// - guarded, when the listed lines, the incompatible ones too, leave a polygon of radius at most k:
//   the compatible ones then leave what reaches from there to the guard radius or beyond it, as
//   their polygon is convex and the others cut it beyond k only.
#ifndef CGAL_POWER_RTF_CUDA_WARP_CELL_CUH
#define CGAL_POWER_RTF_CUDA_WARP_CELL_CUH

#include "Warp_cell_memory.cuh"
#include "Warp_polygon.cuh"
#include "near_sites.cuh"

#include <CGAL/PowerRTF/cells/construct_cell.h>

namespace CGAL {
namespace PowerRTF {
namespace device {

template <class Real>
class Warp_cell {
public:
  __device__ Warp_cell(const Group_view<Real>& view, Warp_cell_memory<Real>& memory, int place,
                       int lane)
      : m_view(view), m_memory(memory), m_place(place), m_lane(lane),
        m_site(load(view.sites + place)), m_own(load(view.normals + place)), m_frame(m_own.normal)
  {}

  const __device__ Packed_site<Real>& site() const { return m_site; }
  const __device__ Tangent_frame<Real>& frame() const { return m_frame; }
  const __device__ Warp_polygon<Real>& polygon() const { return m_polygon; }
  /// The neighbour of the lane's edge, or the number of a side of the square.
  __device__ int neighbor() const
  {
    const int edge = m_polygon.edge;
    if (m_lane >= m_polygon.size) return -1;
    return edge < 0 && edge >= -4 ? edge : place_of_edge(edge);
  }
  __device__ Real radius() const { return std::sqrt(m_polygon.squared_radius(m_lane)); }

  /// Makes the cell. `radius`: the last one, if that was ok, else at most 0; `guard`: the guard
  /// radius, 0 if it is not known (then it is found when it is needed, from `guess` > 0 on).
  /// `kept`: what is in the memory.
  ///
  /// First the plain cell, by the sites near the last radius: it is ok when it is complete and its
  /// radius no larger than guard_factor times the distance of the nearest site. Else the cell
  /// within the guard square; at last by all sites that can cut the square.
  template <class Weights>
  __device__ Cell_status construct(const Weights& weights, Real radius, Real& guard, Real guess,
                                   Kept_sites<Real>& kept)
  {
    Cell_status status = Cell_status::incomplete;
    const bool is_kept = Weights::keeps && kept.place == m_place;
    constexpr int plain = 0, further = 1, guarded = 2, all = 3;
    int attempt = is_kept ? -1 : radius > 0 && m_view.guard_factor >= 1 ? plain : guarded;
    bool needs_guard = Weights::keeps && !is_kept; // it pays to know it, for all passes
#pragma unroll 1
    for (;; ++attempt) {
      if (needs_guard || attempt >= guarded) find_guard(guard, guess);
      // A plain cell is for those that are small: for others the guard square has fewer sites.
      const Real plain_reach = Weights::plain_part * radius * (attempt == further ? 2 : 1);
      if (attempt >= plain && attempt < guarded && guard > 0 && !(plain_reach < guard))
        attempt = guarded;
      const bool is_plain = attempt < 0 ? kept.is_plain : attempt < guarded;
      const Real whole = Real(1.4144) * guard; // the square's corners
      if (attempt >= 0) {
        const Real reach = is_plain             ? plain_reach
                           : attempt == guarded ? Weights::guard_part * guard
                                                : weights.reach_for(whole) * (1 + rounding());
        gather(kept, is_plain ? reach : guard, reach, weights);
        if (Weights::keeps) find_near_groups(kept, weights.own_weight);
        kept.is_plain = is_plain;
        if (Weights::keeps && attempt < all && m_flushes == 0) kept.place = m_place;
      } else {
        m_flushes = 0;
        attempt = is_plain ? further : guarded; // the next one is what may help
      }
      const Real known = attempt == all ? whole : known_radius(kept, weights);
      if (finish(kept, guard, known, status) || attempt == all) return status;
      needs_guard = is_plain;
      if (is_plain && status == Cell_status::ok && this->radius() <= known) {
        // Complete, but perhaps not within the guard radius.
        find_guard(guard, guess);
        if (this->radius() <= guard) return status;
        attempt = further;
      }
    }
  }

private:
  __device__ void find_guard(Real& guard, Real guess)
  {
    if (guard > 0) return;
    guard = m_view.guard_factor *
            neighbor_distances(m_view, m_memory.stack, m_place, guess, Real(-2), 6, m_lane).sixth;
  }

  static constexpr unsigned compatible_lines = 1, other_lines = 2, all_lines = 3;

  __device__ static Real rounding() { return 256 * internal::epsilon<Real>(); }

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
    if (m_lane < 2) m_memory.sizes[m_lane] = 0;
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
          const Real power = d2 + (weights.own_weight - weights(batch.sites[l], place));
          offered = !(d2 > reach2 && power > 0 && power * power > 4 * d2 * reach2);
        }
        lanes[l] = __ballot_sync(full_warp, offered);
        found += __popc(lanes[l]);
      }
      if (kept.lines + found > Warp_cell_memory<Real>::most_lines) {
        flush(kept, half);
        return false; // so that the batch need not stay in registers meanwhile
      }
#pragma unroll
      for (int l = 0; l < batch.size; ++l) {
        if (lanes[l] >> m_lane & 1) {
          const bool is_compatible =
              !(m_view.cos_angle > -1 &&
                !(dot(m_own.normal, batch.normals[l].normal) > m_view.cos_angle));
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

  /// Computes line k, that of the site at `place`.
  __device__ void set_line(int k, const Packed_site<Real>& other, int place)
  {
    const Vec3<Real> offset = other.point - m_site.point;
    const Real d2 = squared_length(offset), power = d2 + (m_site.weight - other.weight);
    m_nearest2 = fmin(m_nearest2, d2);
    Real a = dot(offset, m_frame.u), b = dot(offset, m_frame.v), c = power / 2;
    const Real t2 = a * a + b * b;
    float distance = quick_quotient(float(power), 2 * quick_sqrt(float(t2))); // for the order only
    if (!(t2 > 0)) { // parallel to the tangent plane, or a duplicate: the first one stays
      const bool cuts_all = power < 0 || (power == 0 && d2 == 0 &&
                                          m_view.caller[place] < m_view.caller[m_place]);
      a = b = 0;
      c = cuts_all ? Real(-1) : Real(1); // 0 <= c is true nowhere or everywhere
      distance = cuts_all ? -1e30f : 1e30f;
    }
    m_memory.a[k] = a;
    m_memory.b[k] = b;
    m_memory.c[k] = c;
    const int bits = __float_as_int(distance);
    m_memory.order[k] = bits ^ ((bits >> 31) & 0x7fffffff);
  }

  /// Computes the lines of the sites in memory, with the current weights.
  __device__ void set_lines(const Kept_sites<Real>& kept)
  {
    constexpr int at_once = 2;
    m_nearest2 = Real(1e30);
    for (int first = m_lane; first < kept.lines; first += 32 * at_once) {
      int places[at_once];
      Packed_site<Real> sites[at_once];
#pragma unroll
      for (int l = 0; l < at_once; ++l) { // their loads wait together
        const int k = first + 32 * l, j = m_memory.neighbor[k < kept.lines ? k : first];
        places[l] = j < 0 ? -1 - j : j;
        sites[l] = load(m_view.sites + places[l]);
      }
#pragma unroll
      for (int l = 0; l < at_once; ++l)
        if (first + 32 * l < kept.lines) set_line(first + 32 * l, sites[l], places[l]);
    }
    __syncwarp();
  }

  /// Lists the groups outside which sites obey (*) with twice the reach.
  __device__ void find_near_groups(Kept_sites<Real>& kept, Real own_weight)
  {
    search_groups(m_view, m_memory.stack, cutting_query(2 * kept.reach, own_weight), m_lane,
                  [&](bool reached, int group) {
                    const unsigned lanes = __ballot_sync(full_warp, reached);
                    const int k = kept.groups + __popc(lanes & ((1u << m_lane) - 1));
                    if (reached && k < Warp_cell_memory<Real>::most_groups)
                      m_memory.groups[k] = group;
                    kept.groups += __popc(lanes);
                  });
    __syncwarp();
  }

  /// Within which radius no site's line is missing.
  __device__ Real known_radius(const Kept_sites<Real>& kept, const Current_weights<Real>&) const
  { return kept.reach * (1 - rounding()); }
  __device__ Real known_radius(const Kept_sites<Real>& kept, const Kept_weights<Real>& w) const
  {
    const auto radius = [](Real reach, Real growth) {
      return reach - quick_quotient(growth, 2 * reach);
    };
    Real growth = w.all_growth;
    if (kept.groups <= Warp_cell_memory<Real>::most_groups) {
      growth = 0;
      for (int k = m_lane; k < kept.groups; k += 32)
        growth = fmax(growth, __ldcg(w.lists.growth + m_memory.groups[k]));
      growth = fmax(warp_max(growth) - w.own_growth, Real(0));
    }
    return fmin(radius(kept.reach, growth), radius(2 * kept.reach, w.all_growth)) -
           kept.reach * rounding();
  }

  /// Cuts the polygons by the waiting lines and forgets them.
  __device__ void flush(Kept_sites<Real>& kept, Real half)
  {
    __syncwarp();
    if (m_flushes++ == 0) {
      m_polygon.set_square(half, m_lane);
      m_wide.set_square(half, m_lane);
    }
    set_lines(kept);
#pragma unroll 1
    for (const unsigned kinds : {compatible_lines, all_lines}) { // after both they are in place
      clip(kept.lines, kinds);
      if (m_lane < m_polygon.size && m_polygon.edge >= 0)
        m_polygon.edge = -5 - place_of_edge(m_polygon.edge);
      const Warp_polygon<Real> polygon = m_polygon;
      m_polygon = m_wide;
      m_wide = polygon;
    }
    kept.lines = 0;
    __syncwarp();
  }

  /// Edges carry the numbers of lines; those of lines that are forgotten carry -5 - place.
  __device__ int place_of_edge(int edge) const
  {
    if (edge < 0) return -5 - edge;
    const int j = m_memory.neighbor[edge];
    return j < 0 ? -1 - j : j;
  }

  /// The cell by the sites gathered. `known`: within which radius no site's line is missing.
  /// Returns whether that is enough.
  __device__ bool finish(const Kept_sites<Real>& kept, Real guard, Real known, Cell_status& status)
  {
    const bool is_whole = m_flushes == 0, keep = kept.place == m_place;
    status = Cell_status::incomplete;
    if (kept.is_plain && !is_whole) return false;
    set_lines(kept);
    if (kept.is_plain) { // within the square of what is known
      const Real f = m_view.guard_factor;
      known = fmin(known, f * std::sqrt(warp_least(m_nearest2)));
      guard = kept.reach;
    }
#pragma unroll 1
    for (int stage = 0;; ++stage) { // by compatible lines, then by the others, too
      unsigned kinds = stage == 0 ? compatible_lines : other_lines;
      if (is_whole && (stage == 0 || m_memory.sizes[stage] > 0)) {
        start(stage, guard);
        if (stage == 1) kinds = all_lines;
      } else if (!is_whole && stage == 1) {
        m_polygon = m_wide;
        kinds = all_lines;
      }
      clip(kept.lines, kinds);
      if (keep) keep_edges(stage);
      status = m_polygon.overflow ? Cell_status::incomplete : Cell_status::empty;
      if (m_polygon.overflow || m_polygon.size == 0) return !kept.is_plain;
      const Real r2 = m_polygon.squared_radius(m_lane);
      if (stage == 1) {
        status = Cell_status::guarded;
        return known > guard && r2 <= known * known;
      }
      if (r2 <= guard * guard && !m_polygon.touches_square(m_lane)) {
        status = Cell_status::ok;
        return r2 <= known * known;
      }
      if (kept.is_plain) return false;
    }
  }

  __device__ void keep_edges(int which)
  {
    __syncwarp();
    if (m_lane < m_polygon.size) m_memory.edges[which][m_lane] = short(m_polygon.edge);
    if (m_lane == 0) m_memory.sizes[which] = m_polygon.overflow ? 0 : m_polygon.size;
    __syncwarp();
  }

  /// The polygon to begin with: that of the last time's edges, where these still make one, or the
  /// square.
  __device__ void start(int which, Real guard)
  {
    m_polygon.set_square(guard, m_lane);
    int size = m_memory.sizes[which], edge = 0;
    bool is_edge = false;
    Real x = 0, y = 0;
    constexpr int tries = 3;
#pragma unroll 1
    for (int k = 0;; ++k) {
      if (size < 3 || k == tries) return;
      is_edge = m_lane < size;
      edge = is_edge ? m_memory.edges[which][m_lane] : 0;
      Real a = 1, b = 0, c = 1;
      if (is_edge && edge >= 0) {
        a = m_memory.a[edge];
        b = m_memory.b[edge];
        c = m_memory.c[edge];
      } else if (is_edge) {
        const Side_normal normal = normal_of_side(-1 - edge);
        a = normal.a;
        b = normal.b;
        c = guard;
      }
      const int before = m_lane > 0 ? m_lane - 1 : size - 1;
      const int after = m_lane + 1 < size ? m_lane + 1 : 0;
      const Real pa = __shfl_sync(full_warp, a, before), pb = __shfl_sync(full_warp, b, before);
      const Real pc = __shfl_sync(full_warp, c, before);
      const Real turn = pa * b - pb * a;
      const Real squares = (pa * pa + pb * pb) * (a * a + b * b);
      const Real inverse = quick_quotient(Real(1), turn);
      x = (pc * b - pb * c) * inverse;
      y = (pa * c - pc * a) * inverse;
      const Real dx = __shfl_sync(full_warp, x, after) - x;
      const Real dy = __shfl_sync(full_warp, y, after) - y;
      // Left turns that go round once, each edge in its line's direction.
      const bool is_good = turn > 0 && turn * turn > Real(0.01) * squares && a * dy - b * dx > 0;
      const int rounds = __popc(__ballot_sync(full_warp, is_edge && pb < 0 && b >= 0));
      const unsigned good = __ballot_sync(full_warp, is_edge && is_good);
      if (__popc(good) == size) {
        if (rounds != 1) return;
        break;
      }
      // Without the edges that have vanished.
      if (is_edge && is_good)
        m_memory.edges[which][__popc(good & ((1u << m_lane) - 1))] = short(edge);
      __syncwarp();
      size = __popc(good);
    }
    m_polygon.x = x;
    m_polygon.y = y;
    m_polygon.edge = edge;
    m_polygon.size = size;
    if (!__any_sync(full_warp, is_edge && (std::fabs(x) > guard || std::fabs(y) > guard))) return;
    for (int side = 0; side < 4; ++side) { // the other sides of the square
      if (__any_sync(full_warp, is_edge && edge == -1 - side)) continue;
      const Side_normal normal = normal_of_side(side);
      m_polygon.clip(normal.a, normal.b, guard, -1 - side, m_lane);
    }
  }

  struct Side_normal {
    Real a, b;
  };
  /// The right one is side 0 of the square, the upper one side 1.
  __device__ static Side_normal normal_of_side(int side)
  {
    return {side == 0 ? Real(1) : side == 2 ? Real(-1) : Real(0),
            side == 1 ? Real(1) : side == 3 ? Real(-1) : Real(0)};
  }

  /// Cuts the polygon by the first `lines` lines in memory that are of the wanted `kinds`.
  __device__ void clip(int lines, unsigned kinds)
  {
    constexpr int last = 0x7fffffff;
    Warp_polygon<Real>& polygon = m_polygon;
    const int used = (lines + 31) / 32;
    unsigned left = 0; // bit k: line k * 32 + lane may cut
    for (int k = 0; k < used; ++k) {
      const int line = k * 32 + m_lane;
      if (line < lines &&
          (kinds & (m_memory.neighbor[line] < 0 ? other_lines : compatible_lines)) != 0)
        left |= 1u << k;
    }
    for (int v = 0; v < polygon.size; ++v) { // its edges would cut it by rounding only
      const int line = __shfl_sync(full_warp, polygon.edge, v);
      if (line >= 0 && line % 32 == m_lane) left &= ~(1u << line / 32);
    }
    // What does not cut the polygon does not cut a part of it.
    while (polygon.size > 0 && !polygon.overflow) {
      int nearest = last, number = 0;
      for (int k = 0; k < used; ++k) {
        const int line = k * 32 + m_lane;
        if (!__any_sync(full_warp, left >> k & 1)) continue;
        const bool may_cut = left >> k & 1;
        const Real a = may_cut ? m_memory.a[line] : Real(0);
        const Real b = may_cut ? m_memory.b[line] : Real(0);
        const Real c = may_cut ? m_memory.c[line] : Real(0);
        bool cuts = false;
        for (int first = 0; first < polygon.size; first += 4) { // the values wait together
#pragma unroll
          for (int l = 0; l < 4; ++l) {
            const int v = first + l < polygon.size ? first + l : 0;
            const Real x = __shfl_sync(full_warp, polygon.x, v);
            const Real y = __shfl_sync(full_warp, polygon.y, v);
            cuts |= fma(a, x, fma(b, y, -c)) > 0;
          }
        }
        if (!cuts) left &= ~(1u << k);
        if (cuts && m_memory.order[line] < nearest) {
          nearest = m_memory.order[line];
          number = line;
        }
      }
      const int least = warp_least(nearest);
      if (least == last) break;
      const unsigned owners = __ballot_sync(full_warp, nearest == least);
      const int owner = __ffs(int(owners)) - 1;
      if (m_lane == owner) left &= ~(1u << number / 32);
      number = __shfl_sync(full_warp, number, owner);
      polygon.clip(m_memory.a[number], m_memory.b[number], m_memory.c[number], number, m_lane);
    }
  }

  const Group_view<Real>& m_view;
  Warp_cell_memory<Real>& m_memory;
  int m_place, m_lane;
  Packed_site<Real> m_site;
  Packed_normal<Real> m_own;
  Tangent_frame<Real> m_frame;
  Warp_polygon<Real> m_polygon; // by compatible lines; at the end the cell
  Warp_polygon<Real> m_wide;    // by all lines, while lines are forgotten
  int m_flushes = 0;            // how often they were
  Real m_nearest2;              // of the waiting lines' sites, the lane's ones
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_WARP_CELL_CUH
