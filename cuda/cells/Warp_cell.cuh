// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `construct_cell()` by a warp, for cells that are guarded, empty, irregular or at a feature, or
// where there are warps enough. Cells with more than 32 edges are incomplete.
//
// What is known. `gather(reach)` lists every site j of the patch but those with
//   d >= reach  and  d^2 - 2 d reach > w_j - w_i                                            (*)
// whose planes pass beyond `reach`. When weights change, these pass beyond reach - g / (2 reach) as
// long as w_j - w_i has grown by no more than g (see Verlet_lists.h). With k > guard radius known
// in this way the cell within the guard square is
// - empty, when the listed lines leave nothing;
// - ok, when they leave a polygon of radius at most the guard radius: no other line reaches it;
// - guarded, when the listed lines, the incompatible ones too, leave a polygon of radius at most k:
//   the compatible ones then leave what reaches from there to the guard radius or beyond it, as
//   their polygon is convex and the others cut it beyond k only.
#ifndef CGAL_POWER_RTF_CUDA_WARP_CELL_CUH
#define CGAL_POWER_RTF_CUDA_WARP_CELL_CUH

#include "Warp_lines.cuh"

namespace CGAL::PowerRTF::device {

template <class Real>
class Warp_cell : public Warp_lines<Real> {
  using Base = Warp_lines<Real>;

public:
  using Base::Base;
  using Base::radius;

  /// The cell by the lines that are kept in memory, whose sites' weights may have changed. Returns
  /// whether that is proved to be the cell. `guard`: the guard radius, 0 if it is not known.
  template <class Weights>
  __device__ bool renew(const Weights& weights, const Kept_sites<Real>& kept, Real guard,
                        Cell_status& status)
  {
    m_flushes = 0;
    renew_lines(kept, weights);
    return finish(kept, guard, known_radius(kept, weights), true, false, status);
  }

  /// What `construct()` may begin with where `renew()` has failed: the radius of the cell now, when
  /// only far sites may be missing, else -`guard` (which is known).
  __device__ Real radius_to_begin(const Kept_sites<Real>& kept, Cell_status status,
                                  Real guard) const
  {
    const Real now = kept.is_plain && status == Cell_status::ok ? radius() : guard;
    return now < guard ? now : -guard;
  }

  /// Makes the cell. `radius`: the last one, if that was ok, else at most 0; `guard`: the guard
  /// radius, 0 if it is not known (then it is found when it is needed, from `guess` > 0 on).
  /// `kept`: what is in the memory after it.
  ///
  /// First the plain cell, by the sites near the last radius: it is ok when it is complete and its
  /// radius no larger than guard_factor times the distance of the nearest site. Else the cell
  /// within the guard square; at last by all sites that can cut the square.
  template <class Weights>
  __device__ Cell_status construct(const Weights& weights, Real radius, Real& guard, Real guess,
                                   Kept_sites<Real>& kept)
  {
    Cell_status status = Cell_status::incomplete;
    bool is_narrow = !Weights::keeps; // no more sites than are needed now
    constexpr int plain = 0, further = 1, guarded = 2, all = 3;
    int attempt = radius > 0 && m_view.guard_factor >= 1 ? plain : guarded;
    bool needs_guard = Weights::keeps; // it pays to know it, for all passes
#pragma unroll 1
    for (;; ++attempt) {
      if (needs_guard || attempt >= guarded) find_guard(guard, guess);
      // A plain cell is for those that are small: for others the guard square has fewer sites.
      const Real plain_reach = Weights::plain_part * radius * (attempt == further ? 2 : 1);
      if (attempt < guarded && guard > 0 && !(plain_reach < guard)) attempt = guarded;
      const bool is_plain = attempt < guarded;
      const Real whole = Real(1.4144) * guard; // the square's corners
      const Real guard_part = is_narrow ? narrow_part : Weights::guard_part;
      const Real reach = is_plain             ? plain_reach
                         : attempt == guarded ? guard_part * weights.reach_for(guard)
                                              : Weights::whole_part * weights.reach_for(whole);
      gather(kept, is_plain ? reach : guard, reach, weights);
      if (attempt == guarded && !is_narrow && m_flushes > 0) { // fewer may be kept
        is_narrow = true;
        --attempt;
        continue;
      }
      if (Weights::keeps) find_near_groups(kept, weights.own_weight);
      kept.is_plain = is_plain;
      if (Weights::keeps && m_flushes == 0) kept.place = m_place;
      const bool is_usable = !is_plain || m_flushes == 0;
      if (is_usable) set_lines(kept, weights);
      const Real known = attempt == all ? whole : known_radius(kept, weights);
      status = Cell_status::incomplete;
      if ((is_usable && finish(kept, guard, known, kept.place == m_place, true, status)) ||
          attempt == all)
        return status;
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
  using Base::clip;
  using Base::cutting_query;
  using Base::gather;
  using Base::guess_edges;
  using Base::has_corner_beyond;
  using Base::keep_corner;
  using Base::keep_edges;
  using Base::m_flushes;
  using Base::m_lane;
  using Base::m_memory;
  using Base::m_nearest2;
  using Base::m_place;
  using Base::m_polygon;
  using Base::m_view;
  using Base::m_wide;
  using Base::renew_lines;
  using Base::set_lines;
  using Base::start;

  __device__ void find_guard(Real& guard, Real guess)
  {
    if (guard > 0) return;
    guard = m_view.guard_factor * neighbor_distances(m_view, m_memory.stack, m_place, guess,
                                                     {Real(-2), Real(-2)}, 6, m_lane)
                                      .sixth;
  }

  static constexpr Real narrow_part = Real(1.02);

  __device__ static Real rounding() { return 256 * internal::epsilon<Real>(); }

  /// Lists the groups outside which sites obey (*) with twice the reach.
  __device__ void find_near_groups(Kept_sites<Real>& kept, Real own_weight)
  {
    search_groups(m_view, m_memory.stack, cutting_query(2 * kept.reach, own_weight), m_lane,
                  [&](bool reached, int group) {
                    const unsigned lanes = __ballot_sync(full_warp, reached);
                    const int k = kept.groups + __popc(lanes & ((1u << m_lane) - 1));
                    if (reached && k < Warp_cell_memory<Real>::max_groups)
                      m_memory.groups[k] = group;
                    kept.groups += __popc(lanes);
                  });
    __syncwarp();
  }

  /// Within which radius no site's line is missing.
  template <class Weights>
  __device__ Real known_radius(const Kept_sites<Real>& kept, const Weights& weights) const
  {
    if constexpr (!Weights::keeps) {
      return kept.reach * (1 - rounding());
    } else {
      const auto radius = [](Real reach, Real growth) {
        return reach - quick_quotient(growth, 2 * reach);
      };
      Real growth = weights.all_growth;
      if (kept.groups <= Warp_cell_memory<Real>::max_groups) {
        growth = 0;
        for (int k = m_lane; k < kept.groups; k += 32)
          growth = fmax(growth, weights.growth_of(m_memory.groups[k]));
        growth = fmax(warp_max_nonnegative(growth) - weights.own_growth, Real(0));
      }
      return fmin(radius(kept.reach, growth), radius(2 * kept.reach, weights.all_growth)) -
             kept.reach * rounding();
    }
  }

  /// The cell by the sites gathered. `known`: within which radius no site's line is missing.
  /// `keep`: its edges too; `is_new`: there are none to begin with. Returns whether that is enough.
  __device__ bool finish(const Kept_sites<Real>& kept, Real guard, Real known, bool keep,
                         bool is_new, Cell_status& status)
  {
    const bool is_whole = m_flushes == 0;
    if (kept.is_plain) { // within the square of what is known
      const Real f = m_view.guard_factor;
      known = fmin(known, fmax(guard, f * std::sqrt(warp_min_nonnegative(m_nearest2))));
      guard = kept.reach;
    }
    const bool is_guarded =
        keep && !is_new && !kept.is_plain && has_corner_beyond(kept.lines, guard);
#pragma unroll 1
    for (int stage = is_guarded;; ++stage) { // by compatible lines, then by the others, too
      unsigned kinds = stage == 0 ? Base::compatible_lines : Base::other_lines;
      if (is_whole && (stage == 0 || is_guarded || m_memory.sizes[stage] > 0)) {
        if (is_new && stage == 0) guess_edges(0, kept.lines, kinds, guard);
        start(stage, guard);
        if (stage == 1) kinds = Base::all_lines;
      } else if (!is_whole && stage == 1) {
        m_polygon = m_wide;
        kinds = Base::all_lines;
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
      if (keep) keep_corner();
    }
  }
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WARP_CELL_CUH
