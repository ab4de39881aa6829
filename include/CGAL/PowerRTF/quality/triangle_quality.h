// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shape of the triangles: the columns of the paper's Tables 1 and 2 (measures of Khan, Plopski,
// Fujimoto, Kanbara, Jabeen, Zhang, Zhang and Kato, "Surface remeshing: a systematic literature
// review of methods and research directions", 2020); and lengths of the edges.
#ifndef CGAL_POWER_RTF_QUALITY_TRIANGLE_QUALITY_H
#define CGAL_POWER_RTF_QUALITY_TRIANGLE_QUALITY_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/Surface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace CGAL::PowerRTF {

/// Quality of the `triangles` (#F indices into `points`). Per triangle
/// Q_t = 6/sqrt(3) * A_t / (S_t E_t) (area, half-perimeter, longest edge; 1: equilateral, 0: flat).
/// A triangle without area has quality 0, smallest angle 0 and largest angle 180, which does not
/// count as above 90. All zero when there is no triangle.
inline Quality_statistics triangle_quality(const std::vector<Vec3d>& points,
                                           const std::vector<Triangle>& triangles)
{
  Quality_statistics result;
  if (triangles.empty()) return result;
  const double degrees = 45 / std::atan(1.0);
  double q_sum = 0, theta_sum = 0, q_min = 1, theta_min = 60, theta_max = 60;
  std::size_t below_30 = 0, above_90 = 0;
  for (const Triangle& t : triangles) {
    // e[k]: edge opposite to corner k
    const Vec3d e[3] = {points[t[2]] - points[t[1]], points[t[0]] - points[t[2]],
                        points[t[1]] - points[t[0]]};
    const double l[3] = {length(e[0]), length(e[1]), length(e[2])};
    const double twice_area = length(cross(e[0], e[1]));
    const double half_perimeter = (l[0] + l[1] + l[2]) / 2, longest = std::max({l[0], l[1], l[2]});
    double q = 0, theta = 0, largest = 180;
    if (twice_area > 0) {
      q = std::sqrt(3.0) * twice_area / (half_perimeter * longest);
      largest = 0;
      theta = 180;
      for (int k = 0; k < 3; ++k) {
        const double angle = std::atan2(twice_area, -dot(e[(k + 1) % 3], e[(k + 2) % 3])) * degrees;
        theta = std::min(theta, angle);
        largest = std::max(largest, angle);
      }
      above_90 += largest > 90;
    }
    below_30 += theta < 30;
    q_min = std::min(q_min, q);
    theta_min = std::min(theta_min, theta);
    theta_max = std::max(theta_max, largest);
    q_sum += q;
    theta_sum += theta;
  }
  const double n = static_cast<double>(triangles.size());
  result.q_min = q_min;
  result.q_avg = q_sum / n;
  result.theta_min = theta_min;
  result.theta_min_avg = theta_sum / n;
  result.theta_max = theta_max;
  result.below_30 = static_cast<double>(below_30) / n;
  result.above_90 = static_cast<double>(above_90) / n;
  return result;
}

/// The edges of the triangles, each once, sorted.
inline std::vector<Edge> edges_of(const std::vector<Triangle>& triangles)
{
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) edges.push_back(sorted_edge(t[k], t[(k + 1) % 3]));
  sort_uniquely(edges);
  return edges;
}

/// Lengths of the edges of the `triangles`, in the unit of the `points`. All zero when there is no
/// triangle.
inline Edge_length_statistics edge_lengths(const std::vector<Vec3d>& points,
                                           const std::vector<Triangle>& triangles)
{
  const std::vector<Edge> edges = edges_of(triangles);
  if (edges.empty()) return {};
  double sum = 0, min = std::numeric_limits<double>::max(), max = 0;
  for (const Edge& e : edges) {
    const double l = length(points[e[1]] - points[e[0]]);
    sum += l;
    min = std::min(min, l);
    max = std::max(max, l);
  }
  return {sum / static_cast<double>(edges.size()), min, max};
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_QUALITY_TRIANGLE_QUALITY_H
