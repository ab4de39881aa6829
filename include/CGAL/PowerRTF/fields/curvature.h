// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normal curvature of the surface at its vertices, kappa^v of the paper (Section 4.3).
#ifndef CGAL_POWER_RTF_FIELDS_CURVATURE_H
#define CGAL_POWER_RTF_FIELDS_CURVATURE_H

#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/nth_value.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// The root mean square of the normal curvatures `(n_a - n_b).(v_a - v_b) / |v_a - v_b|^2` along
/// the edges at each vertex (#V, per unit-box length). A sphere of radius r: 1/r.
inline std::vector<double> vertex_curvature(const Surface& surface, const Surface_edges& edges,
                                            internal::Concurrency concurrency = Sequential_tag())
{
  std::vector<double> curvature(surface.points.size(), 0);
  internal::for_each_index(concurrency, static_cast<int>(curvature.size()), [&](int v) {
    double sum = 0;
    int count = 0;
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e) {
      const int u = edges.neighbor[e];
      const Vec3d d = surface.points[u] - surface.points[v];
      const double length_2 = squared_length(d);
      if (!(length_2 > 0)) continue;
      const double k = dot(surface.vertex_normals[u] - surface.vertex_normals[v], d) / length_2;
      sum += k * k;
      ++count;
    }
    if (count > 0) curvature[v] = std::sqrt(sum / count);
  });
  return curvature;
}

/// Replaces each value by the mean of itself and its neighbors' mean, `passes` times.
inline void smooth_over_edges(const Surface_edges& edges, int passes, std::vector<double>& values,
                              internal::Concurrency concurrency = Sequential_tag())
{
  std::vector<double> smooth(values.size());
  for (int pass = 0; pass < passes; ++pass) {
    internal::for_each_index(concurrency, static_cast<int>(values.size()), [&](int v) {
      double sum = 0;
      for (int e = edges.first[v]; e < edges.first[v + 1]; ++e) sum += values[edges.neighbor[e]];
      smooth[v] = (values[v] + sum / (edges.first[v + 1] - edges.first[v])) / 2;
    });
    values.swap(smooth);
  }
}

/// The curvature of the vertices as a pure number in `[0.05, 1]`: smoothed 3 times and divided by
/// its 98th percentile. 1 everywhere on a flat surface.
inline std::vector<double>
normalized_curvature(const Surface& surface, const Surface_edges& edges,
                     internal::Concurrency concurrency = Sequential_tag())
{
  constexpr int smoothing_passes = 3;
  constexpr double percentile = 0.98, smallest = 0.05;
  // Curvature times size below this is rounding (a radius of 10^4 times the surface's size).
  constexpr double flat = 1e-4;

  std::vector<double> curvature = vertex_curvature(surface, edges, concurrency);
  smooth_over_edges(edges, smoothing_passes, curvature, concurrency);
  double unit = internal::nth_value(concurrency, curvature,
                                    static_cast<std::size_t>(percentile * (curvature.size() - 1)));
  const double size = std::sqrt(surface.area);
  if (unit * size < flat) // flat almost everywhere
    unit = *std::max_element(curvature.begin(), curvature.end());
  if (unit * size < flat) return std::vector<double>(curvature.size(), 1);
  for (double& k : curvature) k = (std::min)(1., (std::max)(smallest, k / unit));
  return curvature;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_CURVATURE_H
