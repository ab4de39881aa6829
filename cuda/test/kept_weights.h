// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weights for a `Warp_cell` that keeps its sites while weights change, as `Pass_weights` of the
// device, without its records.
#ifndef CGAL_POWER_RTF_CUDA_KEPT_WEIGHTS_H
#define CGAL_POWER_RTF_CUDA_KEPT_WEIGHTS_H

#include "../cells/Verlet_lists.h"
#include "../cells/Warp_cell_memory.cuh"

namespace CGAL::PowerRTF::device {

/// Sites are gathered, and kept, for the weights that `lists` were made for; so is the tree.
template <class Real>
struct Kept_weights {
  static constexpr bool keeps = true;
  // They serve for a while.
  static constexpr Real plain_part = 2, guard_part = Real(1.15), whole_part = Real(1.1);
  const Verlet_lists<Real>& lists;
  const Packed_site<Real>* sites; ///< with the current weights
  Real own_weight, own_now, own_growth, all_growth;

  __device__ Kept_weights(const Verlet_lists<Real>& l, const Packed_site<Real>* s, int place)
      : lists(l), sites(s), own_weight(l.weights[place]), own_now(s[place].weight),
        own_growth(own_now - own_weight), all_growth(fmax(*l.all_growth - own_growth, Real(0)))
  {}
  __device__ Real listed(const Packed_site<Real>&, int place) const { return lists.weights[place]; }
  __device__ Real current(const Packed_site<Real>& site, int) const { return site.weight; }
  using Record = Real;
  __device__ Real record(int place) const { return sites[place].weight; }
  __device__ Real current(Real record) const { return record; }
  __device__ Real growth_of(int group) const { return lists.growth[group]; }
  __device__ Real reach_for(Real radius) const { return reach_after_growth(radius, all_growth); }
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_KEPT_WEIGHTS_H
