// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_SNAPPED_H
#define CGAL_POWER_RTF_GEOMETRY_SNAPPED_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <cmath>

namespace CGAL::PowerRTF {

/// The point of a grid that is nearest to `p`. \pre `grid` > 0
CGAL_POWER_RTF_HD inline Vec3d snapped(const Vec3d& p, double grid)
{
  return {std::nearbyint(p.x / grid) * grid, std::nearbyint(p.y / grid) * grid,
          std::nearbyint(p.z / grid) * grid};
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SNAPPED_H
