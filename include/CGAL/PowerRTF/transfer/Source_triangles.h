// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What sources lie on: the triangles of the input, as its user has it.
#ifndef CGAL_POWER_RTF_TRANSFER_SOURCE_TRIANGLES_H
#define CGAL_POWER_RTF_TRANSFER_SOURCE_TRIANGLES_H

#include <CGAL/PowerRTF/geometry/degenerate_facets.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/input/Polygon_soup.h>
#include <CGAL/PowerRTF/input/polygon_triangulation.h>
#include <CGAL/PowerRTF/transfer/Sources.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The triangles of a polygon soup that have an area, in coordinates of the unit box.
struct Source_triangles {
  std::vector<Vec3d> points;
  std::vector<Triangle> triangles;
  std::vector<int> polygons; ///< of the triangles

  Source_triangles(const Polygon_soup& soup, const Normalization& normalization)
      : points(soup.points.size(), Vec3d{0, 0, 0})
  {
    for (const int v : soup.corners) points[v] = normalization.to_inside(soup.points[v]);
    triangles.reserve(soup.first.size());
    polygons.reserve(soup.first.size());
    std::vector<Triangle> cut;
    for (std::size_t k = 0; k + 1 < soup.first.size(); ++k) {
      const std::vector<int> polygon(soup.corners.begin() + soup.first[k],
                                     soup.corners.begin() + soup.first[k + 1]);
      if (polygon.size() < 3) continue;
      cut.clear();
      triangulate_polygon(points, polygon, cut);
      for (const Triangle& t : cut) {
        if (is_degenerate(points[t[0]], points[t[1]], points[t[2]])) continue;
        triangles.push_back(t);
        polygons.push_back(static_cast<int>(k));
      }
    }
  }

  /// The place of a point of triangle `t`.
  Source source(int t, const Vec3d& p) const
  {
    Source result;
    result.face = polygons[t];
    result.vertices = triangles[t];
    auto& [alpha, beta, gamma] = result.weights;
    const auto corner = [&](int i) { return points[result.vertices[i]]; };
    barycentric_coordinates(p, corner(0), corner(1), corner(2), beta, gamma);
    alpha = (std::max)(0., 1 - beta - gamma);
    return result;
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_TRANSFER_SOURCE_TRIANGLES_H
