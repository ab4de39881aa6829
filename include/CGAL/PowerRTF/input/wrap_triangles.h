// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A closed surface around triangles, by CGAL's alpha wrapping (Portaneri et al. 2022): what a ball
// touches that rolls around them from outside, a little away from them.
#ifndef CGAL_POWER_RTF_INPUT_WRAP_TRIANGLES_H
#define CGAL_POWER_RTF_INPUT_WRAP_TRIANGLES_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/input/Triangle_set.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A 2-manifold without borders and intersections that encloses the triangles.
/// \param radius of the ball: it goes through holes that are wider, and into such gaps
/// \param offset the result's distance from the triangles
/// \param grid the result's coordinates are multiples of it
inline Triangle_set wrapped_triangles(const Triangle_set& set, double radius, double offset,
                                      double grid)
{
  using Point = Exact_predicates_inexact_constructions_kernel::Point_3;
  std::vector<Point> points;
  points.reserve(set.points.size());
  for (const Vec3d& p : set.points) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::array<std::size_t, 3>> triangles;
  triangles.reserve(set.triangles.size());
  for (const Triangle& t : set.triangles)
    triangles.push_back({std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2])});
  Surface_mesh<Point> wrap;
  alpha_wrap_3(points, triangles, radius, offset, wrap);

  Triangle_set result;
  std::vector<int> place(wrap.num_vertices());
  for (const auto v : wrap.vertices()) {
    place[v] = static_cast<int>(result.points.size());
    const Point& p = wrap.point(v);
    result.points.push_back(snapped({p.x(), p.y(), p.z()}, grid));
  }
  for (const auto f : wrap.faces()) {
    const auto h = wrap.halfedge(f);
    result.triangles.push_back(
        {place[wrap.source(h)], place[wrap.target(h)], place[wrap.target(wrap.next(h))]});
  }
  return result;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INPUT_WRAP_TRIANGLES_H
