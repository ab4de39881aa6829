// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_MIRROR_PLANE_H
#define CGAL_POWER_RTF_GEOMETRY_MIRROR_PLANE_H

#include <CGAL/PowerRTF/geometry/vector.h>

namespace CGAL::PowerRTF {

/// A plane of symmetry, across an axis. In coordinates of the unit box `at` is on the grid of the
/// result's points, so that their images are there, too, without rounding.
struct Mirror_plane {
  int axis;  ///< 0, 1, 2: x, y, z
  double at; ///< the coordinate of all its points

  static double& coordinate(Vec3d& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }
  static double coordinate(const Vec3d& p, int axis)
  {
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  }

  /// How far `p` is above the plane.
  double height(const Vec3d& p) const { return coordinate(p, axis) - at; }
  bool has(const Vec3d& p) const { return height(p) == 0; }
  Vec3d image(Vec3d p) const
  {
    coordinate(p, axis) = 2 * at - coordinate(p, axis);
    return p;
  }
  /// The point of the plane that is nearest to `p`.
  Vec3d foot(Vec3d p) const
  {
    coordinate(p, axis) = at;
    return p;
  }
  /// What of a vector is along the plane.
  Vec3d along(Vec3d n) const
  {
    coordinate(n, axis) = 0;
    return n;
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_MIRROR_PLANE_H
