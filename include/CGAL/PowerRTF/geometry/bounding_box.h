// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_BOUNDING_BOX_H
#define CGAL_POWER_RTF_GEOMETRY_BOUNDING_BOX_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <vector>

namespace CGAL::PowerRTF::internal {

/// Of the triangles, at least one.
inline Box3<double> bounding_box(const std::vector<Vec3d>& points,
                                 const std::vector<Triangle>& triangles,
                                 Concurrency concurrency = Sequential_tag())
{
  const Vec3d& first = points[triangles[0][0]];
  return reduce(
      concurrency, static_cast<int>(triangles.size()), Box3<double>{first, first},
      [&](Box3<double>& box, int f) {
        for (const int v : triangles[f]) box.add(points[v]);
      },
      [](Box3<double>& box, const Box3<double>& part) { box.add(part); });
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_BOUNDING_BOX_H
