// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shape of the triangles: the columns of the paper's Tables 1 and 2 (measures of Khan, Plopski,
// Fujimoto, Kanbara, Jabeen, Zhang, Zhang and Kato, "Surface remeshing: a systematic literature
// review of methods and research directions", 2020); and lengths of the edges.
#ifndef CGAL_POWER_RTF_QUALITY_TRIANGLE_QUALITY_H
#define CGAL_POWER_RTF_QUALITY_TRIANGLE_QUALITY_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/vertex_corners.h>
#include <CGAL/PowerRTF/internal/nth_value.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

struct Triangle_shape {
  double q = 0, smallest = 0, largest = 180; ///< quality, and angles in degrees
};

inline Triangle_shape triangle_shape(const std::array<Vec3d, 3>& p)
{
  const double degrees = 45 / std::atan(1.0);
  const Vec3d e[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]}; // opposite to the corners
  const double l[3] = {length(e[0]), length(e[1]), length(e[2])};
  const double twice_area = length(cross(e[0], e[1]));
  if (!(twice_area > 0)) return {};
  const double half_perimeter = (l[0] + l[1] + l[2]) / 2, longest = std::max({l[0], l[1], l[2]});
  Triangle_shape shape{std::sqrt(3.0) * twice_area / (half_perimeter * longest), 180, 0};
  for (int k = 0; k < 3; ++k) {
    const double angle = std::atan2(twice_area, -dot(e[(k + 1) % 3], e[(k + 2) % 3])) * degrees;
    shape.smallest = std::min(shape.smallest, angle);
    shape.largest = std::max(shape.largest, angle);
  }
  return shape;
}

} // namespace internal

/// Quality of the `triangles` (#F indices into `points`). Per triangle
/// Q_t = 6/sqrt(3) * A_t / (S_t E_t) (area, half-perimeter, longest edge; 1: equilateral, 0: flat).
/// A triangle without area has quality 0, smallest angle 0 and largest angle 180, which does not
/// count as above 90. All zero when there is no triangle.
inline Quality_statistics triangle_quality(const std::vector<Vec3d>& points,
                                           const std::vector<Triangle>& triangles,
                                           internal::Concurrency concurrency = Sequential_tag())
{
  if (triangles.empty()) return {};
  // The means are sums, and the shares numbers, until all have been seen.
  Quality_statistics start;
  start.q_min = 1;
  start.theta_min = start.theta_max = 60;
  const auto add = [&](Quality_statistics& s, int f) {
    const internal::Triangle_shape shape = internal::triangle_shape(
        {points[triangles[f][0]], points[triangles[f][1]], points[triangles[f][2]]});
    s.q_min = std::min(s.q_min, shape.q);
    s.q_avg += shape.q;
    s.theta_min = std::min(s.theta_min, shape.smallest);
    s.theta_min_avg += shape.smallest;
    s.theta_max = std::max(s.theta_max, shape.largest);
    s.below_30 += shape.smallest < 30;
    s.above_90 += shape.q > 0 && shape.largest > 90;
  };
  Quality_statistics result =
      internal::reduce(concurrency, static_cast<int>(triangles.size()), start, add,
                       [](Quality_statistics& s, const Quality_statistics& part) {
                         s.q_min = std::min(s.q_min, part.q_min);
                         s.q_avg += part.q_avg;
                         s.theta_min = std::min(s.theta_min, part.theta_min);
                         s.theta_min_avg += part.theta_min_avg;
                         s.theta_max = std::max(s.theta_max, part.theta_max);
                         s.below_30 += part.below_30;
                         s.above_90 += part.above_90;
                       });
  for (double* sum : {&result.q_avg, &result.theta_min_avg, &result.below_30, &result.above_90})
    *sum /= static_cast<double>(triangles.size());
  return result;
}

/// The edges of the triangles, each once, sorted.
inline std::vector<Edge> edges_of(const std::vector<Triangle>& triangles,
                                  internal::Concurrency concurrency = Sequential_tag())
{
  const int vertices = vertex_range(triangles, concurrency);
  const auto edge = [&](int h) {
    return sorted_edge(halfedge_source(triangles, h), halfedge_target(triangles, h));
  };
  const internal::Buckets<int> ends(
      concurrency, static_cast<int>(3 * triangles.size()), vertices,
      [&](int h) { return edge(h)[0]; }, [&](int h) { return edge(h)[1]; });
  const auto for_each_edge = [&](int v, auto&& f) {
    for (int k = ends.first[v]; k < ends.first[v + 1]; ++k)
      if (k == ends.first[v] || ends.entries[k] != ends.entries[k - 1]) f(ends.entries[k]);
  };
  std::vector<int> first(vertices + 1, 0);
  internal::for_each_index(concurrency, vertices,
                           [&](int v) { for_each_edge(v, [&](int) { ++first[v]; }); });
  std::vector<Edge> edges;
  internal::resize_in_parallel(concurrency, edges,
                               internal::exclusive_scan(concurrency, vertices + 1, first.data()));
  internal::for_each_index(concurrency, vertices, [&](int v) {
    int e = first[v];
    for_each_edge(v, [&](int w) { edges[e++] = {v, w}; });
  });
  return edges;
}

/// The same where each edge is there once in either direction, in less time, in any order.
inline std::vector<Edge> edges_of_closed(const std::vector<Triangle>& triangles,
                                         internal::Concurrency concurrency = Sequential_tag())
{
  const auto edge = [&](int h) {
    return Edge{halfedge_source(triangles, h), halfedge_target(triangles, h)};
  };
  const std::vector<int> halfedges =
      internal::select(concurrency, static_cast<int>(3 * triangles.size()),
                       [&](int h) { return edge(h)[0] < edge(h)[1]; });
  std::vector<Edge> edges;
  internal::resize_in_parallel(concurrency, edges, halfedges.size());
  internal::for_each_index(concurrency, static_cast<int>(edges.size()),
                           [&](int e) { edges[e] = edge(halfedges[e]); });
  return edges;
}

/// Lengths of the edges of the `triangles`, in the unit of the `points`. All zero when there is no
/// triangle. `is_closed`: each edge is there once in either direction.
inline Edge_length_statistics edge_lengths(const std::vector<Vec3d>& points,
                                           const std::vector<Triangle>& triangles,
                                           internal::Concurrency concurrency = Sequential_tag(),
                                           bool is_closed = false)
{
  const std::vector<Edge> edges =
      is_closed ? edges_of_closed(triangles, concurrency) : edges_of(triangles, concurrency);
  if (edges.empty()) return {};
  const int size = static_cast<int>(edges.size());
  std::vector<double> lengths;
  internal::resize_in_parallel(concurrency, lengths, size);
  internal::for_each_index(concurrency, size, [&](int e) {
    lengths[e] = length(points[edges[e][1]] - points[edges[e][0]]);
  });
  Edge_length_statistics result = internal::reduce(
      concurrency, size, Edge_length_statistics{0, 0, std::numeric_limits<double>::max(), 0},
      [&](Edge_length_statistics& s, int e) {
        s = {s.mean + lengths[e], 0, std::min(s.min, lengths[e]), std::max(s.max, lengths[e])};
      },
      [](Edge_length_statistics& s, const Edge_length_statistics& part) {
        s = {s.mean + part.mean, 0, std::min(s.min, part.min), std::max(s.max, part.max)};
      });
  result.mean /= size;
  result.median = internal::nth_value(concurrency, lengths, size / 2);
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_QUALITY_TRIANGLE_QUALITY_H
