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
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/nth_value.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

/// Shape of a triangle with an area. Angles are costly: they are found for corners where they
/// count.
class Triangle_shape {
public:
  explicit Triangle_shape(const std::array<Vec3d, 3>& p)
  {
    const Vec3d e[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]}; // opposite to the corners
    const double l[3] = {length(e[0]), length(e[1]), length(e[2])};
    constexpr double root_of_3 = 1.7320508075688772;
    m_twice_area = length(cross(e[0], e[1]));
    const double half_perimeter = (l[0] + l[1] + l[2]) / 2, longest = std::max({l[0], l[1], l[2]});
    m_quality = root_of_3 * m_twice_area / (half_perimeter * longest);
    for (int k = 0; k < 3; ++k) m_cosines[k] = -dot(e[(k + 1) % 3], e[(k + 2) % 3]);
  }

  bool has_area() const { return m_twice_area > 0; }
  double quality() const { return m_quality; }

  /// In degrees.
  double smallest_angle() const
  {
    const double most = std::max({m_cosines[0], m_cosines[1], m_cosines[2]});
    double smallest = 180;
    for (const double c : m_cosines)
      if (c >= most - rounding * std::fabs(most)) smallest = std::min(smallest, angle(c));
    return smallest;
  }
  double largest_angle() const
  {
    const double least = least_cosine(), near = rounding * (m_twice_area + std::fabs(least));
    double largest = 0;
    for (const double c : m_cosines)
      if (c <= least + near) largest = std::max(largest, angle(c));
    return largest;
  }
  /// Of the largest angle.
  double least_cotangent() const { return least_cosine() / m_twice_area; }
  /// Whether an angle may be as large as one with that cotangent, of [0, 1], or larger.
  bool may_reach(double cotangent) const
  {
    return least_cosine() < (cotangent + rounding) * m_twice_area;
  }

private:
  static constexpr double rounding = 1e-9; // far above that of angles

  double angle(double cosine) const
  {
    constexpr double degrees = 57.29577951308232;
    return std::atan2(m_twice_area, cosine) * degrees;
  }
  double least_cosine() const { return std::min({m_cosines[0], m_cosines[1], m_cosines[2]}); }

  double m_twice_area, m_quality;
  double m_cosines[3]; // of the corners, times the lengths of their edges
};

/// The means are sums, and the shares numbers, until all triangles have been seen.
class Quality_sums {
public:
  Quality_sums()
  {
    m_sums.q_min = 1;
    m_sums.theta_min = m_sums.theta_max = 60;
  }

  void add(const Triangle_shape& shape)
  {
    const bool has_area = shape.has_area();
    const double q = has_area ? shape.quality() : 0,
                 smallest = has_area ? shape.smallest_angle() : 0;
    m_sums.q_min = std::min(m_sums.q_min, q);
    m_sums.q_avg += q;
    m_sums.theta_min = std::min(m_sums.theta_min, smallest);
    m_sums.theta_min_avg += smallest;
    m_sums.below_30 += smallest < 30;
    if (!has_area) {
      m_sums.theta_max = 180;
    } else if (shape.may_reach(std::max(0., m_cotangent))) {
      const double largest = shape.largest_angle();
      m_sums.above_90 += q > 0 && largest > 90;
      m_sums.theta_max = std::max(m_sums.theta_max, largest);
      m_cotangent = std::min(m_cotangent, shape.least_cotangent());
    }
  }
  void join(const Quality_sums& part)
  {
    const Quality_statistics& s = part.m_sums;
    m_sums.q_min = std::min(m_sums.q_min, s.q_min);
    m_sums.q_avg += s.q_avg;
    m_sums.theta_min = std::min(m_sums.theta_min, s.theta_min);
    m_sums.theta_min_avg += s.theta_min_avg;
    m_sums.theta_max = std::max(m_sums.theta_max, s.theta_max);
    m_sums.below_30 += s.below_30;
    m_sums.above_90 += s.above_90;
  }
  Quality_statistics statistics(int triangles) const
  {
    Quality_statistics result = m_sums;
    for (double* sum : {&result.q_avg, &result.theta_min_avg, &result.below_30, &result.above_90})
      *sum /= triangles;
    return result;
  }

private:
  Quality_statistics m_sums;
  double m_cotangent =
      1; // of the largest angle so far; at first that of 45 degrees: all are larger
};

} // namespace internal

/// Quality of the `triangles` (#F indices into `points`). Per triangle
/// Q_t = 6/sqrt(3) * A_t / (S_t E_t) (area, half-perimeter, longest edge; 1: equilateral, 0: flat).
/// A triangle without area has quality 0, smallest angle 0 and largest angle 180, which does not
/// count as above 90. All zero when there is no triangle.
inline Quality_statistics triangle_quality(const std::vector<Vec3d>& points,
                                           const std::vector<Triangle>& triangles,
                                           internal::Concurrency concurrency = Sequential_tag())
{
  using internal::Quality_sums;
  if (triangles.empty()) return {};
  const int size = static_cast<int>(triangles.size());
  const auto add = [&](Quality_sums& sums, int f) {
    const auto [a, b, c] = triangles[f];
    sums.add(internal::Triangle_shape({points[a], points[b], points[c]}));
  };
  return internal::reduce(concurrency, size, Quality_sums(), add,
                          [](Quality_sums& sums, const Quality_sums& part) { sums.join(part); })
      .statistics(size);
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

namespace internal {

/// The lengths of the edges; `is_closed`: each edge is there once in either direction, and they may
/// come in any order.
inline Unset_vector<double> lengths_of_edges(const std::vector<Vec3d>& points,
                                             const std::vector<Triangle>& triangles,
                                             Concurrency concurrency, bool is_closed)
{
  Unset_vector<double> lengths;
  const auto set_length = [&](int e, int a, int b) { lengths[e] = length(points[b] - points[a]); };
  if (is_closed) {
    const auto source = [&](int h) { return halfedge_source(triangles, h); };
    const auto target = [&](int h) { return halfedge_target(triangles, h); };
    select(
        concurrency, static_cast<int>(3 * triangles.size()),
        [&](int h) { return source(h) < target(h); }, [&](int n) { lengths.resize(n); },
        [&](int e, int h) { set_length(e, source(h), target(h)); });
  } else {
    const std::vector<Edge> edges = edges_of(triangles, concurrency);
    lengths.resize(edges.size());
    for_each_index(concurrency, static_cast<int>(edges.size()),
                   [&](int e) { set_length(e, edges[e][0], edges[e][1]); });
  }
  return lengths;
}

} // namespace internal

/// Lengths of the edges of the `triangles`, in the unit of the `points`. All zero when there is no
/// triangle. `is_closed`: each edge is there once in either direction.
inline Edge_length_statistics edge_lengths(const std::vector<Vec3d>& points,
                                           const std::vector<Triangle>& triangles,
                                           internal::Concurrency concurrency = Sequential_tag(),
                                           bool is_closed = false)
{
  const auto lengths = internal::lengths_of_edges(points, triangles, concurrency, is_closed);
  if (lengths.empty()) return {};
  const int size = static_cast<int>(lengths.size());
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
