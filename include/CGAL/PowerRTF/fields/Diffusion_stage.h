// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A diffusion over the edges of a graph, for host and device.
#ifndef CGAL_POWER_RTF_FIELDS_DIFFUSION_STAGE_H
#define CGAL_POWER_RTF_FIELDS_DIFFUSION_STAGE_H

#include <CGAL/PowerRTF/geometry/Edges_view.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/host_device.h>

#include <cmath>
#include <utility>

namespace CGAL::PowerRTF {

/// How long dx_v / dt = (mean of the neighbors' x) - x_v lasts at `v` for a variance: twice that
/// over the mean squared length of the edges. At most `longest`.
CGAL_POWER_RTF_HD inline double diffusion_time(const Edges_view& edges, int v, double variance,
                                               double longest)
{
  double squares = 0;
  const int degree = edges.first[v + 1] - edges.first[v];
  for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
    squares += edges.length[e] * edges.length[e];
  if (!(squares > 0)) return 0;
  const double time = 2 * variance * degree / squares;
  return time < longest ? time : longest;
}

/// Sets these times, and finds the longest.
struct Set_diffusion_times {
  Edges_view edges;
  double variance; ///< see `diffusion_variance()`
  const double* density;
  double longest;
  double* times;

  CGAL_POWER_RTF_HD void operator()(int v, Totals<0, 1>& most) const
  {
    times[v] = diffusion_time(edges, v, variance / density[v], longest);
    most.raise(0, times[v]);
  }
};

/// What a diffusion leaves as it is.
struct Keep_value {
  CGAL_POWER_RTF_HD double operator()(int, double x) const { return x; }
};

/// One stage of a diffusion, at a vertex.
template <class Value, class Finish>
struct Diffusion_stage {
  const int *first, *neighbor; ///< as of `Surface_edges`
  const double* times;
  const Value* now;
  Value* before; ///< these become the next ones
  double mu, nu; ///< their sum is 1
  double share;  ///< of the times
  bool is_last;  ///< of a step
  Finish finish;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    Value sum{}; // of the differences: a constant stays as it is
    const int begin = first[v], end = first[v + 1];
    for (int e = begin; e < end; ++e) sum += now[neighbor[e]] - now[v];
    const double degree = end > begin ? end - begin : 1;
    const Value old = nu < 0 ? before[v] : now[v]; // where nu is 0, there may be none before
    const Value next = now[v] + nu * (old - now[v]) + mu * share * times[v] / degree * sum;
    before[v] = is_last ? finish(v, next) : next;
  }
};

/// Diffuses numbers or vectors for `times`, none of which is above `longest`. Each of the `steps`
/// has s Legendre stages and goes as far as (s^2 + s) / 4 plain ones of a half (RKL1: Meyer,
/// Balsara, Aslam, "A stabilized Runge-Kutta-Legendre method for explicit super-time-stepping of
/// parabolic and mixed equations", J. Comput. Phys. 257, 2014). The mean over a ring is all that a
/// single long one makes: several make nearly a Gaussian of it. After each, `finish(v, x)` stands
/// for the value x. `run(stage)` calls `stage(v)` for all vertices.
/// \returns where the result is: in `values` or in `others`, which has as many
template <class Value, class Finish, class Run>
Value* diffuse(const int* first, const int* neighbor, const double* times, double longest,
               int steps, Value* values, Value* others, const Finish& finish, const Run& run)
{
  const double stages = std::ceil(std::sqrt(0.25 + 4 * (longest / steps)) - 0.5);
  const double share = 2 / (stages * (stages + 1) * steps);
  for (int step = 0; step < steps; ++step)
    for (double j = 1; j <= stages; ++j) {
      run(Diffusion_stage<Value, Finish>{first, neighbor, times, values, others, (2 * j - 1) / j,
                                         (1 - j) / j, share, j == stages, finish});
      std::swap(values, others);
    }
  return values;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_DIFFUSION_STAGE_H
