// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Self-intersections of a triangle soup, manifold or not, decided by exact predicates. The same
// answer as CGAL::Polygon_mesh_processing::self_intersections() gives for a mesh; CGAL 5.5 has no
// version for soups.
#ifndef CGAL_POWER_RTF_QUALITY_SELF_INTERSECTIONS_H
#define CGAL_POWER_RTF_QUALITY_SELF_INTERSECTIONS_H

#include <CGAL/PowerRTF/internal/triangles_intersect.h>
#include <CGAL/PowerRTF/surface/Surface.h>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <array>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

/// Decides whether two facets of a soup meet in more than the vertices and edges that they share.
class Facets_intersect
{
  using Point = Epick::Point_3;

public:
  Facets_intersect(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles)
      : m_points(points), m_triangles(triangles)
  {
  }

  bool is_degenerate(int f) const
  {
    const Triangle& t = m_triangles[f];
    return collinear(point(t[0]), point(t[1]), point(t[2]));
  }

  bool operator()(int f, int g) const
  {
    return triangles_intersect(m_triangles[f], points(f), m_triangles[g], points(g));
  }

private:
  Point point(int v) const { return Point(m_points[v].x, m_points[v].y, m_points[v].z); }
  std::array<Point, 3> points(int f) const
  {
    const Triangle& t = m_triangles[f];
    return {point(t[0]), point(t[1]), point(t[2])};
  }

  const std::vector<Vec3d>& m_points;
  const std::vector<Triangle>& m_triangles;
};

} // namespace internal

/// The number of pairs of facets of the soup that meet in more than a shared vertex or edge; a
/// facet without area counts as a pair with itself. `points` must be finite.
inline std::size_t self_intersections(const std::vector<Vec3d>& points,
                                      const std::vector<Triangle>& triangles)
{
  using Box =
      Box_intersection_d::Box_with_info_d<double, 3, int, Box_intersection_d::ID_FROM_BOX_ADDRESS>;
  const internal::Facets_intersect intersect(points, triangles);
  std::size_t count = 0;
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const int f = static_cast<int>(i);
    if (intersect.is_degenerate(f)) {
      ++count;
      continue;
    }
    Bbox_3 box;
    for (const int v : triangles[i]) {
      const Vec3d& p = points[v];
      box += Bbox_3(p.x, p.y, p.z, p.x, p.y, p.z);
    }
    boxes.emplace_back(box, f);
  }
  std::vector<const Box*> pointers;
  pointers.reserve(boxes.size());
  for (const Box& box : boxes) pointers.push_back(&box);
  // larger than the default: the leaves are cheap against the recursion (see PMP)
  const std::ptrdiff_t cutoff = 2000;
  box_self_intersection_d(
      pointers.begin(), pointers.end(),
      [&](const Box* a, const Box* b) { count += intersect(a->info(), b->info()); }, cutoff);
  return count;
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_QUALITY_SELF_INTERSECTIONS_H
