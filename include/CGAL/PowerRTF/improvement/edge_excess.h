// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_IMPROVEMENT_EDGE_EXCESS_H
#define CGAL_POWER_RTF_IMPROVEMENT_EDGE_EXCESS_H

#include <CGAL/PowerRTF/improvement/Star_mesh.h>

#include <algorithm>
#include <cmath>

namespace CGAL::PowerRTF::internal {

/// Of the triangles at the target of `h` that no feature parts from the face of `h`: how many more
/// they are than equilateral ones that would fill their angle. Inside a flat part that is the
/// number of edges above six.
inline double corner_excess(const Star_mesh& m, Star_mesh::Halfedge h)
{
  using Halfedge = Star_mesh::Halfedge;
  const auto& mesh = m.working().mesh;
  const Vec3d p = m.point(mesh.target(h));
  const auto is_open = [&](Halfedge g) {
    return !m.is_feature(mesh.edge(g)) && !mesh.is_border(mesh.edge(g));
  };
  const auto next = [&](Halfedge g) { return mesh.opposite(mesh.next(g)); };
  const auto previous = [&](Halfedge g) { return mesh.prev(mesh.opposite(g)); };
  Halfedge first = h;
  while (is_open(first) && previous(first) != h) first = previous(first);
  constexpr double sixty_degrees = 1.0471975511965976;
  double excess = 0;
  for (Halfedge g = first;;) {
    const Vec3d a = normalized(m.point(mesh.source(g)) - p),
                b = normalized(m.point(mesh.target(mesh.next(g))) - p);
    excess += 1 - std::acos(std::clamp(dot(a, b), -1., 1.)) / sixty_degrees;
    if (!is_open(mesh.next(g))) return excess;
    g = next(g);
    if (g == first) return excess;
  }
}

/// The excess of the ends of `e` less that of the two opposite corners. A flip lowers it by four,
/// so where it is two or more, and the triangles may become rounder by it; where it is large, a
/// vertex is missing, and where it is low, there is one too many.
inline double edge_excess(const Star_mesh& m, Star_mesh::Edge e)
{
  const auto& mesh = m.working().mesh;
  const Star_mesh::Halfedge h = mesh.halfedge(e, 0), o = mesh.halfedge(e, 1);
  return corner_excess(m, h) + corner_excess(m, o) - corner_excess(m, mesh.next(h)) -
         corner_excess(m, mesh.next(o));
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_EDGE_EXCESS_H
