// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cuts one polygon into triangles: the best-shaped ear first (Meisters' two ears theorem), seen
// along the polygon's Newell normal. Keeps all its vertices, so neighbors stay connected.
#ifndef CGAL_POWER_RTF_INPUT_POLYGON_TRIANGULATION_H
#define CGAL_POWER_RTF_INPUT_POLYGON_TRIANGULATION_H

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <algorithm>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// The shape of the ear at `polygon[i]`: area over squared longest edge; below 0: not an ear.
inline double ear_quality(const std::vector<Vec3d>& points, const std::vector<int>& polygon, int i,
                          const Vec3d& normal)
{
  const int n = static_cast<int>(polygon.size());
  const int corner[3] = {polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]};
  const Vec3d &a = points[corner[0]], &b = points[corner[1]], &c = points[corner[2]];
  const double area = dot(cross(b - a, c - a), normal);
  const double longest =
      (std::max)({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
  if (!(area > 0)) return -1;
  for (const int v : polygon) {
    if (v == corner[0] || v == corner[1] || v == corner[2]) continue;
    const Vec3d& p = points[v];
    if (dot(cross(b - a, p - a), normal) >= 0 && dot(cross(c - b, p - b), normal) >= 0 &&
        dot(cross(a - c, p - c), normal) >= 0)
      return -1;
  }
  return area / longest;
}

} // namespace internal

/// Appends the `polygon.size() - 2` triangles of `polygon` (at least 3 vertices) to `triangles`.
/// Planar simple polygons are cut without overlap; any other polygon is cut somehow.
inline void triangulate_polygon(const std::vector<Vec3d>& points, std::vector<int> polygon,
                                std::vector<Triangle>& triangles)
{
  Vec3d normal{0, 0, 0};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    normal +=
        cross(points[polygon[i]] - points[polygon[0]], points[polygon[i + 1]] - points[polygon[0]]);
  normal = normalized(normal);

  std::vector<double> quality(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i)
    quality[i] = internal::ear_quality(points, polygon, static_cast<int>(i), normal);

  while (polygon.size() > 3) {
    const int n = static_cast<int>(polygon.size());
    int i = 0; // of ears that are equal up to rounding the first: it must not decide
    for (int j = 1; j < n; ++j)
      if (quality[j] > quality[i] + 1e-6) i = j;
    triangles.push_back({polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]});
    polygon.erase(polygon.begin() + i);
    quality.erase(quality.begin() + i);
    for (const int j : {(i + n - 2) % (n - 1), i % (n - 1)})
      quality[j] = internal::ear_quality(points, polygon, j, normal);
    // An ear that was blocked by the vertex just cut may be free now.
    if (*std::max_element(quality.begin(), quality.end()) < 0)
      for (int j = 0; j < n - 1; ++j)
        quality[j] = internal::ear_quality(points, polygon, j, normal);
  }
  triangles.push_back({polygon[0], polygon[1], polygon[2]});
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INPUT_POLYGON_TRIANGULATION_H
