// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Smoothing at the scale of the samples: a diffusion over the surface's edges.
#ifndef CGAL_POWER_RTF_FIELDS_DIFFUSION_H
#define CGAL_POWER_RTF_FIELDS_DIFFUSION_H

#include <CGAL/PowerRTF/fields/Diffusion_stage.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// The variance of a diffusion over `width` times the spacing of `n` samples, times the density.
inline double diffusion_variance(const Surface& surface, std::size_t n, double width,
                                 internal::Concurrency concurrency = Sequential_tag())
{
  return width * width * density_integral(surface, concurrency) / static_cast<double>(n);
}

/// By vertex, how long dx_v / dt = (mean of its neighbors' x) - x_v lasts, for `variance(v)`: twice
/// that over the mean squared length of the edges. At most `longest`.
template <class Variance>
std::vector<double> diffusion_times(const Surface_edges& edges, const Variance& variance,
                                    double longest,
                                    internal::Concurrency concurrency = Sequential_tag())
{
  std::vector<double> times(edges.first.size() - 1, 0);
  internal::for_each_index(concurrency, static_cast<int>(times.size()), [&](int v) {
    double squares = 0;
    const int degree = edges.first[v + 1] - edges.first[v];
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
      squares += edges.length[e] * edges.length[e];
    if (squares > 0) times[v] = (std::min)(longest, 2 * variance(v) * degree / squares);
  });
  return times;
}

/// Diffuses `values` along `edges`; see Diffusion_stage.h.
inline void diffuse(const Surface_edges& edges, const std::vector<double>& times, int steps,
                    std::vector<double>& values,
                    internal::Concurrency concurrency = Sequential_tag())
{
  if (values.empty()) return;
  const int size = static_cast<int>(values.size());
  internal::Unset_vector<double> others(values.size());
  const double* const result = diffuse(
      edges.first.data(), edges.neighbor.data(), times.data(),
      *std::max_element(times.begin(), times.end()), steps, values.data(), others.data(),
      [](int, double x) { return x; },
      [&](const auto& stage) { internal::for_each_index(concurrency, size, stage); });
  if (result != values.data())
    internal::for_each_index(concurrency, size, [&](int v) { values[v] = result[v]; });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_DIFFUSION_H
