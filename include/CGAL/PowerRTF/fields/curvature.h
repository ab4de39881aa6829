// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normal curvature of the surface at its vertices, kappa^v of the paper (Section 4.3).
#ifndef CGAL_POWER_RTF_FIELDS_CURVATURE_H
#define CGAL_POWER_RTF_FIELDS_CURVATURE_H

#include <CGAL/PowerRTF/fields/density_steps.h>
#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/nth_value.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// The root mean square of the normal curvatures `(n_a - n_b).(v_a - v_b) / |v_a - v_b|^2` along
/// the edges at each vertex (#V, per unit-box length). A sphere of radius r: 1/r.
inline std::vector<double> vertex_curvature(const Surface& surface, const Surface_edges& edges,
                                            internal::Concurrency concurrency = Sequential_tag())
{
  std::vector<double> curvature(surface.points.size());
  internal::for_each_index(concurrency, static_cast<int>(curvature.size()),
                           internal::Find_curvature{edges.view(), surface.points.data(),
                                                    surface.vertex_normals.data(),
                                                    curvature.data()});
  return curvature;
}

/// Replaces each value by the mean of itself and its neighbors' mean, `passes` times.
inline void smooth_over_edges(const Surface_edges& edges, int passes, std::vector<double>& values,
                              internal::Concurrency concurrency = Sequential_tag())
{
  std::vector<double> smooth(values.size());
  for (int pass = 0; pass < passes; ++pass) {
    internal::for_each_index(
        concurrency, static_cast<int>(values.size()),
        internal::Smooth_over_edges{edges.view(), values.data(), smooth.data()});
    values.swap(smooth);
  }
}

/// The curvature of the vertices as a pure number in `[0.05, 1]`: smoothed 3 times and divided by
/// its 98th percentile. 1 everywhere on a flat surface.
inline std::vector<double>
normalized_curvature(const Surface& surface, const Surface_edges& edges,
                     internal::Concurrency concurrency = Sequential_tag())
{
  using Normalize = internal::Normalize_curvature;
  std::vector<double> curvature = vertex_curvature(surface, edges, concurrency);
  smooth_over_edges(edges, Normalize::smoothing_passes, curvature, concurrency);
  const std::size_t size = curvature.size();
  double unit = internal::nth_value(concurrency, curvature, Normalize::rank(size));
  if (Normalize::is_flat(unit, surface.area)) // almost everywhere
    unit = *std::max_element(curvature.begin(), curvature.end());
  if (Normalize::is_flat(unit, surface.area)) return std::vector<double>(size, 1);
  internal::for_each_index(concurrency, static_cast<int>(size), Normalize{unit, curvature.data()});
  return curvature;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_CURVATURE_H
