// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_SINGLE_LANE_H
#define CGAL_POWER_RTF_INTERNAL_SINGLE_LANE_H

#include <CGAL/PowerRTF/internal/host_device.h>

namespace CGAL::PowerRTF {

/// A thread that works on its item alone.
struct Single_lane {
  CGAL_POWER_RTF_HD bool leads() const { return true; }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INTERNAL_SINGLE_LANE_H
