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
inline double diffusion_variance(double integral, std::size_t n, double width)
{
  return width * width * integral / static_cast<double>(n);
}
inline double diffusion_variance(const Surface& surface, std::size_t n, double width,
                                 internal::Concurrency concurrency = Sequential_tag())
{
  return diffusion_variance(density_integral(surface, concurrency), n, width);
}

/// `diffusion_time()` by vertex, for `variance(v)`.
template <class Variance>
std::vector<double> diffusion_times(const Surface_edges& edges, const Variance& variance,
                                    double longest,
                                    internal::Concurrency concurrency = Sequential_tag())
{
  const Edges_view view = edges.view();
  std::vector<double> times(edges.first.size() - 1);
  internal::for_each_index(concurrency, static_cast<int>(times.size()), [&](int v) {
    times[v] = diffusion_time(view, v, variance(v), longest);
  });
  return times;
}

/// Diffuses `values` along `edges`; see Diffusion_stage.h.
template <class Value, class Finish = Keep_value>
void diffuse(const Surface_edges& edges, const std::vector<double>& times, int steps,
             std::vector<Value>& values, internal::Concurrency concurrency = Sequential_tag(),
             const Finish& finish = {})
{
  if (values.empty()) return;
  const int size = static_cast<int>(values.size());
  internal::Unset_vector<Value> others(values.size());
  const Value* const result = diffuse(
      edges.first.data(), edges.neighbor.data(), times.data(),
      *std::max_element(times.begin(), times.end()), steps, values.data(), others.data(), finish,
      [&](const auto& stage) { internal::for_each_index(concurrency, size, stage); });
  if (result != values.data())
    internal::for_each_index(concurrency, size, [&](int v) { values[v] = result[v]; });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_DIFFUSION_H
