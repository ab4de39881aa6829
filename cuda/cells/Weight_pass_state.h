// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CUDA_WEIGHT_PASS_STATE_H
#define CGAL_POWER_RTF_CUDA_WEIGHT_PASS_STATE_H

namespace CGAL {
namespace PowerRTF {
namespace device {

/// What the passes leave behind, and their counters; arrays: one entry per pass.
struct Weight_pass_state {
  static constexpr int most_passes = 64;
  int done = 0;  ///< changes of the weights
  int equal = 0; ///< all masses are inside the interval
  int specials = 0; ///< cells without a list
  int outside[most_passes] = {};
  unsigned long long mass[most_passes] = {}; ///< see `Mass_sum`
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_WEIGHT_PASS_STATE_H
