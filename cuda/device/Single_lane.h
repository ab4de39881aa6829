// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CUDA_SINGLE_LANE_H
#define CGAL_POWER_RTF_CUDA_SINGLE_LANE_H

#include <CGAL/PowerRTF/cells/vector.h>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// A thread that works on its item alone.
struct Single_lane {
  CGAL_POWER_RTF_HD bool leads() const { return true; }
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_SINGLE_LANE_H
