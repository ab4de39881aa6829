// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The place of a mesh that is nearest to a point, of those that agree with a normal, by descent
// from star to star.
#ifndef CGAL_POWER_RTF_SMOOTHING_NEAREST_PLACE_H
#define CGAL_POWER_RTF_SMOOTHING_NEAREST_PLACE_H

#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/smoothing/Smoothing_parameters.h>
#include <CGAL/PowerRTF/smoothing/Star_view.h>

namespace CGAL::PowerRTF::internal {

/// A place on the face at a spoke; -1: there is none.
struct Star_place {
  Vec3d point{0, 0, 0};
  double distance = 0;
  int spoke = -1;
};

/// Looks at the star of `v`, then at that of the nearest corner of the face that is nearest to `x`
/// there, as long as these come nearer. The faces are those around vertices that may move, as `v`.
CGAL_POWER_RTF_HD inline Star_place nearest_place(const Star_view& stars, const Vec3d& x,
                                                  const Vec3d& normal, int v)
{
  Star_place nearest;
  for (int step = 0; step <= stars.surface.max_steps; ++step) {
    const Vec3d p = stars.point(v);
    int next = -1;
    for (int k = stars.first[v]; k < stars.first[v + 1]; ++k) {
      const int a = stars.neighbors[stars.next_spoke(v, k)], b = stars.neighbors[k];
      const Vec3d &pa = stars.point(a), &pb = stars.point(b), n = cross(pa - p, pb - p);
      if (!(dot(n, normal) > stars.surface.min_cosine * length(n))) continue;
      const Vec3d q = nearest_point_on_triangle(x, p, pa, pb);
      const double d = length(q - x);
      if (nearest.spoke >= 0 && !(d < clearly_less * nearest.distance)) continue;
      nearest = {q, d, k};
      const bool a_is_near = squared_length(pa - x) < squared_length(pb - x);
      const int near = a_is_near ? a : b, far = a_is_near ? b : a;
      next = stars.is_movable(near) ? near : stars.is_movable(far) ? far : -1;
    }
    if (next < 0) break;
    v = next;
  }
  return nearest;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_NEAREST_PLACE_H
