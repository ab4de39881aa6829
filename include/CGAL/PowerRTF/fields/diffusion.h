// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Smoothing at the scale of the samples: a diffusion over the surface's edges.
#ifndef CGAL_POWER_RTF_FIELDS_DIFFUSION_H
#define CGAL_POWER_RTF_FIELDS_DIFFUSION_H

#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
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

/// Diffuses `values`, numbers or vectors, for `times`. Each of the `steps` has s Legendre stages
/// and goes as far as (s^2 + s) / 4 plain ones of a half (RKL1: Meyer, Balsara, Aslam, "A
/// stabilized Runge-Kutta-Legendre method for explicit super-time-stepping of parabolic and mixed
/// equations", J. Comput. Phys. 257, 2014). The mean over a ring is all that a single long one
/// makes: several make nearly a Gaussian of it. After each, `finish(v, x)` stands for the value x.
template <class Value, class Finish>
void diffuse(const Surface_edges& edges, const std::vector<double>& times, int steps,
             std::vector<Value>& values, internal::Concurrency concurrency, const Finish& finish)
{
  if (values.empty()) return;
  const double last = *std::max_element(times.begin(), times.end()) / steps;
  const double stages = std::ceil(std::sqrt(0.25 + 4 * last) - 0.5);
  const double share = 2 / (stages * (stages + 1) * steps); // of the times, by one stage
  const int size = static_cast<int>(values.size());
  internal::Unset_vector<Value> others(values.size());
  Value *now = values.data(), *before = others.data(); // the latter become the next ones
  for (int step = 0; step < steps; ++step)
    for (double j = 1; j <= stages; ++j) {
      const double mu = (2 * j - 1) / j, nu = (1 - j) / j; // their sum is 1
      internal::for_each_index(concurrency, size, [&](int v) {
        Value sum{}; // of the differences: a constant stays as it is
        for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
          sum += now[edges.neighbor[e]] - now[v];
        const int degree = (std::max)(1, edges.first[v + 1] - edges.first[v]);
        const Value old = j > 1 ? before[v] : now[v]; // where nu is 0, there may be none before
        const Value next = now[v] + nu * (old - now[v]) + mu * share * times[v] / degree * sum;
        before[v] = j == stages ? finish(v, next) : next;
      });
      std::swap(before, now);
    }
  if (now == values.data()) return;
  internal::for_each_index(concurrency, size, [&](int v) { values[v] = now[v]; });
}
template <class Value>
void diffuse(const Surface_edges& edges, const std::vector<double>& times, int steps,
             std::vector<Value>& values, internal::Concurrency concurrency = Sequential_tag())
{
  diffuse(edges, times, steps, values, concurrency, [](int, const Value& x) { return x; });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_DIFFUSION_H
