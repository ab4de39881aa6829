// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether two triangles of a mesh meet in more than the vertices and edges that they share, decided
// by exact predicates.
#ifndef CGAL_POWER_RTF_GEOMETRY_TRIANGLES_INTERSECT_H
#define CGAL_POWER_RTF_GEOMETRY_TRIANGLES_INTERSECT_H

#include <CGAL/PowerRTF/geometry/Parting_plane.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>

namespace CGAL::PowerRTF::internal {

using Epick = Exact_predicates_inexact_constructions_kernel;
using Triangle_points = std::array<Epick::Point_3, 3>;

inline bool has_no_area(const Triangle_points& p) { return collinear(p[0], p[1], p[2]); }

inline Bbox_3 box_of(const Triangle_points& p) { return p[0].bbox() + p[1].bbox() + p[2].bbox(); }

/// See there.
inline bool has_parting_plane(const Triangle_points& p, const Triangle_points& q, int i = -1,
                              int j = -1)
{
  Vec3d a[3], b[3];
  for (int k = 0; k < 3; ++k) {
    a[k] = {p[k].x(), p[k].y(), p[k].z()};
    b[k] = {q[k].x(), q[k].y(), q[k].z()};
  }
  return Parting_plane(a, b, i, j).exists();
}

/// \param s, t the triangles' vertices, of any type that compares; distinct in each
/// \param p, q their points, not collinear in either
template <class Vertex>
bool triangles_intersect(const std::array<Vertex, 3>& s, const Triangle_points& p,
                         const std::array<Vertex, 3>& t, const Triangle_points& q)
{
  const Shared_corners shared = shared_corners(s, t);
  const auto triangle = [](const Triangle_points& x) {
    return Epick::Triangle_3(x[0], x[1], x[2]);
  };
  const auto opposite_edge = [](const Triangle_points& x, int i) {
    return Epick::Segment_3(x[(i + 1) % 3], x[(i + 2) % 3]);
  };
  if (shared.count == 0) return !has_parting_plane(p, q) && do_intersect(triangle(p), triangle(q));
  if (shared.count == 1)
    return !has_parting_plane(p, q, shared.first, shared.second) &&
           (do_intersect(triangle(p), opposite_edge(q, shared.second)) ||
            do_intersect(triangle(q), opposite_edge(p, shared.first)));
  if (shared.count == 3) return true;
  // a shared edge: the triangles overlap when they are coplanar and on the same side of it
  const int a = shared.first_off, b = shared.second_off;
  const auto &e = p[(a + 1) % 3], &f = p[(a + 2) % 3];
  return coplanar(e, f, p[a], q[b]) && coplanar_orientation(e, f, p[a], q[b]) == POSITIVE;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_TRIANGLES_INTERSECT_H
