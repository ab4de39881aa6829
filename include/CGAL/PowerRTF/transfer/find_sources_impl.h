// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for find_sources.h.
#ifndef CGAL_POWER_RTF_TRANSFER_FIND_SOURCES_IMPL_H
#define CGAL_POWER_RTF_TRANSFER_FIND_SOURCES_IMPL_H

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/transfer/Source_triangles.h>
#include <CGAL/PowerRTF/transfer/find_sources.h>
#include <CGAL/PowerRTF/transfer/point_of_face.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// Finds the sources of single points.
class Source_search {
public:
  Source_search(const Polygon_soup& input, const Normalization& normalization, bool is_oriented,
                Concurrency concurrency)
      : m_input(input, normalization), m_tree(m_input.points, m_input.triangles, {}, concurrency),
        m_is_oriented(is_oriented)
  {}

  /// `normal`: of the mesh at `p`; places that face the other way count where none else is within
  /// `reach`.
  Source source(const Vec3d& p, const Vec3d& normal, double reach) const
  {
    Surface_point<double> nearest;
    if (m_is_oriented) nearest = m_tree.nearest(p, normal, 0, -1);
    if (nearest.facet < 0 || nearest.squared_distance > reach * reach)
      nearest = m_tree.nearest_anywhere(p);
    return m_input.source(nearest.facet, nearest.point);
  }

private:
  Source_triangles m_input;
  Facet_tree m_tree;
  bool m_is_oriented;
};

} // namespace internal

CGAL_POWER_RTF_INLINE Sources find_sources(const Polygon_soup& input,
                                           const Normalization& normalization, bool is_oriented,
                                           const std::vector<Vec3d>& points,
                                           const std::vector<Triangle>& triangles,
                                           internal::Concurrency concurrency, bool finds_shares)
{
  const internal::Source_search search(input, normalization, is_oriented, concurrency);
  const int vertices = static_cast<int>(points.size()), faces = static_cast<int>(triangles.size());
  std::vector<Vec3d> normals(faces), vertex_normals(vertices, Vec3d{0, 0, 0});
  std::vector<double> reach(faces), vertex_reach(vertices, 0);
  for (int f = 0; f < faces; ++f) {
    const Triangle& t = triangles[f];
    const Vec3d ab = points[t[1]] - points[t[0]], ac = points[t[2]] - points[t[0]];
    normals[f] = cross(ab, ac);
    reach[f] =
        0.5 *
        std::sqrt((std::max)({squared_length(ab), squared_length(ac), squared_length(ac - ab)}));
    for (const int v : t) {
      vertex_normals[v] += normals[f];
      vertex_reach[v] = (std::max)(vertex_reach[v], reach[f]);
    }
  }
  Sources sources;
  sources.vertices.resize(vertices);
  internal::for_each_index(concurrency, vertices, [&](int v) {
    sources.vertices[v] = search.source(points[v], vertex_normals[v], vertex_reach[v]);
  });
  sources.faces.resize(faces);
  internal::for_each_index(concurrency, faces, [&](int f) {
    const Triangle& t = triangles[f];
    const Vec3d center = (points[t[0]] + points[t[1]] + points[t[2]]) * (1. / 3);
    sources.faces[f] = search.source(center, normals[f], reach[f]);
  });
  if (!finds_shares) return sources;
  sources.shares.resize(faces);
  internal::for_each_index(concurrency, faces, [&](int f) {
    const Triangle& t = triangles[f];
    sources.shares[f][0] = sources.faces[f].face;
    for (int k = 1; k < points_of_face; ++k) {
      const Vec3d p = internal::point_of_face(k, points[t[0]], points[t[1]], points[t[2]]);
      sources.shares[f][k] = search.source(p, normals[f], reach[f]).face;
    }
  });
  return sources;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_TRANSFER_FIND_SOURCES_IMPL_H
