// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Self-intersections of a triangle soup, manifold or not, decided by exact predicates. The same
// answer as CGAL::Polygon_mesh_processing::self_intersections() gives for a mesh; CGAL 5.5 has no
// version for soups.
#ifndef CGAL_POWER_RTF_GEOMETRY_SELF_INTERSECTIONS_H
#define CGAL_POWER_RTF_GEOMETRY_SELF_INTERSECTIONS_H

#include <CGAL/PowerRTF/geometry/Find_close_faces.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/intersecting_pairs.h>

#include <boost/range/irange.hpp>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// The facets of a soup for `Intersecting_pairs`.
struct Soup_triangles {
  using Face = int;

  const std::vector<Vec3d>& all_points;
  const std::vector<Triangle>& triangles;

  const Triangle& corners(Face f) const { return triangles[f]; }
  Triangle_points points(const Triangle& t) const
  {
    return {point(t[0]), point(t[1]), point(t[2])};
  }
  bool intersect(const Triangle& s, const Triangle_points& p, const Triangle& t,
                 const Triangle_points& q) const
  {
    return triangles_intersect(s, p, t, q);
  }

private:
  Epick::Point_3 point(int v) const { return {all_points[v].x, all_points[v].y, all_points[v].z}; }
};

} // namespace internal

/// The pairs of facets of the soup that meet in more than a shared vertex or edge, sorted; a facet
/// without area counts as a pair with itself. `points` must be finite. `find`: what finds most of
/// the others instead, where it does.
inline Face_pairs intersecting_facets(const std::vector<Vec3d>& points,
                                      const std::vector<Triangle>& triangles,
                                      internal::Concurrency concurrency = Sequential_tag(),
                                      const Find_close_faces& find = {})
{
  const internal::Intersecting_pairs<internal::Soup_triangles> pairs({points, triangles},
                                                                     concurrency);
  const int facets = static_cast<int>(triangles.size());
  Face_pairs close;
  return find && facets > 0 &&
                 find(static_cast<int>(points.size()), points.data(), facets,
                      triangles.front().data(), close)
             ? pairs.find_among(close)
             : pairs.find(boost::irange(0, facets));
}

/// Their number.
inline std::size_t self_intersections(const std::vector<Vec3d>& points,
                                      const std::vector<Triangle>& triangles,
                                      internal::Concurrency concurrency = Sequential_tag(),
                                      const Find_close_faces& find = {})
{
  return intersecting_facets(points, triangles, concurrency, find).size();
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SELF_INTERSECTIONS_H
