// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Self-intersections of a triangle soup, manifold or not, decided by exact predicates. The same
// answer as CGAL::Polygon_mesh_processing::self_intersections() gives for a mesh; CGAL 5.5 has no
// version for soups.
#ifndef CGAL_POWER_RTF_GEOMETRY_SELF_INTERSECTIONS_H
#define CGAL_POWER_RTF_GEOMETRY_SELF_INTERSECTIONS_H

#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
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
/// without area counts as a pair with itself. `points` must be finite. `there`: where an engine has
/// the soup, or null.
inline Face_pairs intersecting_facets(const std::vector<Vec3d>& points,
                                      const std::vector<Triangle>& triangles,
                                      internal::Concurrency concurrency = Sequential_tag(),
                                      Resident_mesh* there = nullptr)
{
  const internal::Intersecting_pairs<internal::Soup_triangles> pairs({points, triangles},
                                                                     concurrency);
  Face_pairs close;
  return there && there->find_close_faces(close)
             ? pairs.find_among(close)
             : pairs.find(boost::irange(0, static_cast<int>(triangles.size())));
}

/// Their number.
inline std::size_t self_intersections(const std::vector<Vec3d>& points,
                                      const std::vector<Triangle>& triangles,
                                      internal::Concurrency concurrency = Sequential_tag(),
                                      Resident_mesh* there = nullptr)
{
  return intersecting_facets(points, triangles, concurrency, there).size();
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SELF_INTERSECTIONS_H
