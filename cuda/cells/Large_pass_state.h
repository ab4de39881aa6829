// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CUDA_LARGE_PASS_STATE_H
#define CGAL_POWER_RTF_CUDA_LARGE_PASS_STATE_H

namespace CGAL {
namespace PowerRTF {
namespace device {

/// What the passes over many cells leave behind on the device.
struct Large_pass_state {
  static constexpr int most_passes = 11; ///< between two looks at it; odd: there is no padding
  double mean_mass = 0, mean_weight = 0;
  int open = 0; ///< groups with cells that their lists did not give, before the last change
  int outside[most_passes] = {}; ///< of each pass: a mass was outside the interval
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_LARGE_PASS_STATE_H
