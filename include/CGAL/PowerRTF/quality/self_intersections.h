// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Self-intersections of a triangle soup, manifold or not, decided by exact predicates. The same
// answer as CGAL::Polygon_mesh_processing::self_intersections() gives for a mesh; CGAL 5.5 has no
// version for soups.
#ifndef CGAL_POWER_RTF_QUALITY_SELF_INTERSECTIONS_H
#define CGAL_POWER_RTF_QUALITY_SELF_INTERSECTIONS_H

#include <CGAL/PowerRTF/surface/Surface.h>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

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
  using Kernel = Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_3;

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
    const Triangle &s = m_triangles[f], &t = m_triangles[g];
    int shared = 0, k_s = 0, k_t = 0; // the last pair of corners with the same vertex
    bool s_is_shared[3] = {false, false, false}, t_is_shared[3] = {false, false, false};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (s[i] == t[j]) {
          ++shared;
          s_is_shared[i] = t_is_shared[j] = true;
          k_s = i;
          k_t = j;
        }
    if (shared == 0) return do_intersect(triangle(s), triangle(t));
    if (shared == 1)
      return do_intersect(triangle(s), opposite_edge(t, k_t)) ||
             do_intersect(triangle(t), opposite_edge(s, k_s));
    if (shared == 3) return true;
    // a shared edge: the facets overlap when they are coplanar and on the same side of it
    const int a = s_is_shared[0] ? (s_is_shared[1] ? 2 : 1) : 0; // the corners off the edge
    const int b = t_is_shared[0] ? (t_is_shared[1] ? 2 : 1) : 0;
    const Point p = point(s[(a + 1) % 3]), q = point(s[(a + 2) % 3]), r = point(s[a]),
                x = point(t[b]);
    return coplanar(p, q, r, x) && coplanar_orientation(p, q, r, x) == POSITIVE;
  }

private:
  Point point(int v) const { return Point(m_points[v].x, m_points[v].y, m_points[v].z); }
  Kernel::Triangle_3 triangle(const Triangle& t) const
  {
    return Kernel::Triangle_3(point(t[0]), point(t[1]), point(t[2]));
  }
  Kernel::Segment_3 opposite_edge(const Triangle& t, int k) const
  {
    return Kernel::Segment_3(point(t[(k + 1) % 3]), point(t[(k + 2) % 3]));
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
