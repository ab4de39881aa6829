// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CUDA_WEIGHT_PASS_STATE_H
#define CGAL_POWER_RTF_CUDA_WEIGHT_PASS_STATE_H

namespace CGAL {
namespace PowerRTF {
namespace device {

/// What the passes leave behind.
struct Weight_pass_state {
  int done = 0;  ///< changes of the weights
  int equal = 0; ///< all masses are inside the interval
  double mean_mass = 0;
};

/// What a warp tells of its site: the weight of the last cells, the distance that the rule takes
/// for it, and the cell's mass.
template <class Real>
struct alignas(16) Pass_record {
  Real weight, distance;
  double mass;
};

/// What cells have in common in a pass.
struct Pass_totals {
  double mass = 0, most = 0, least = 1e300; ///< sum and extremes of the masses
  double growth = 0;                        ///< the most that a weight will have grown
};

/// What the warps tell each other, at first zero; arrays: one entry per pass, used in turn.
template <class Real>
struct Pass_counters {
  static constexpr int most_groups = 256, turns = 3;
  using Bits = unsigned long long;                         ///< of numbers that are not negative
  Bits most[turns], not_least[turns], all_growth[turns];   ///< see `Pass_totals`
  unsigned arrivals;                                       ///< of blocks, at barriers
  Real growth[turns][most_groups];                         ///< of groups, see `Kept_lists`
};

/// Also the counters of the passes by lists; arrays: one entry per pass.
struct List_pass_state : Weight_pass_state {
  static constexpr int most_passes = 64;
  int specials = 0; ///< cells without a list
  int outside[most_passes] = {};
  unsigned long long mass[most_passes] = {}; ///< see `Mass_sum`
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_WEIGHT_PASS_STATE_H
