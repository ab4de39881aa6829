// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Smoothing at the scale of the samples: a diffusion over the surface's edges, by which a value at
// v spreads over `width` times the local spacing h_v = sqrt(integral(rho) / (n rho_v)).
#ifndef CGAL_POWER_RTF_FIELDS_DIFFUSION_H
#define CGAL_POWER_RTF_FIELDS_DIFFUSION_H

#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// By vertex, how long dx_v / dt = (mean of its neighbors' x) - x_v lasts, for a standard deviation
/// of `width` times the local spacing of `n` samples: twice its square over the mean squared length
/// of the edges.
inline std::vector<double> diffusion_times(const Surface& surface, const Surface_edges& edges,
                                           std::size_t n, double width,
                                           internal::Concurrency concurrency = Sequential_tag())
{
  const double mass = density_integral(surface, concurrency);
  std::vector<double> times(surface.points.size(), 0);
  internal::for_each_index(concurrency, static_cast<int>(times.size()), [&](int v) {
    double squares = 0;
    const int degree = edges.first[v + 1] - edges.first[v];
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
      squares += edges.length[e] * edges.length[e];
    if (!(squares > 0)) return;
    const double h2 = mass / (double(n) * surface.vertex_density[v]);
    times[v] = 2 * width * width * h2 * degree / squares;
  });
  return times;
}

/// Diffuses `values` for `times`, at most 4000 each: where the input's edges are shorter than a
/// 45th of the width, less. Steps of s Legendre stages, each of which goes as far as (s^2 + s) / 4
/// plain ones of a half (RKL1: Meyer, Balsara, Aslam, "A stabilized Runge-Kutta-Legendre method for
/// explicit super-time-stepping of parabolic and mixed equations", J. Comput. Phys. 257, 2014). The
/// mean over a ring is all that a single long one makes: several make nearly a Gaussian of it.
inline void diffuse(const Surface_edges& edges, std::vector<double> times,
                    std::vector<double>& values,
                    internal::Concurrency concurrency = Sequential_tag())
{
  constexpr double longest = 4000;
  constexpr int steps = 4;
  double last = 0;
  for (double& t : times) last = (std::max)(last, t = (std::min)(t, longest) / steps);
  const double stages = std::ceil(std::sqrt(0.25 + 4 * last) - 0.5);
  const double share = 2 / (stages * (stages + 1)); // of the step, by one stage
  std::vector<double> before(values.size()), next(values.size());
  for (int step = 0; step < steps; ++step)
    for (double j = 1; j <= stages; ++j) {
      const double mu = (2 * j - 1) / j, nu = (1 - j) / j; // their sum is 1
      internal::for_each_index(concurrency, static_cast<int>(values.size()), [&](int v) {
        double sum = 0; // of the differences: a constant stays as it is
        for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
          sum += values[edges.neighbor[e]] - values[v];
        const int degree = (std::max)(1, edges.first[v + 1] - edges.first[v]);
        next[v] = values[v] + nu * (before[v] - values[v]) + mu * share * times[v] * sum / degree;
      });
      before.swap(values);
      values.swap(next);
    }
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_DIFFUSION_H
