// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CUDA_SUMMARY_RULE_H
#define CGAL_POWER_RTF_CUDA_SUMMARY_RULE_H

#include <CGAL/PowerRTF/internal/Totals.h>
#include "sample_rules.h"

#include <CGAL/PowerRTF/engines/Cuda_engine_api.h>

#include <cmath>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// What the host looks at once per iteration.
struct Iteration_summary {
  Device_summary cells;
  int passes = 0; ///< over the weights, of the last call for them
};

/// Sums up the current cells, by all threads of a team together.
template <class Real>
struct Summary_rule {
  Usable_rule<Real> usable; ///< mean mass 0: that of these cells
  const Vec3<Real>* offset;
  double tolerance; ///< gamma
  const unsigned char* is_left_out; ///< of the capacities; null: none is
  int n;
  const int* passes; ///< null: none were made
  Device_summary* result;
  Iteration_summary* host_result;

  template <class Team>
  CGAL_POWER_RTF_HD void operator()(Team& team) const
  {
    Device_summary s;
    Capacity_statistics& c = s.capacity;
    Totals<7, 1> sums;
    sums.clear();
    for (int i = team.first(); i < n; i += team.stride()) {
      const double m = mass(i);
      sums.add(0, m);
      sums.add(1, squared_offset(i));
      for (int k = 0; k < 3; ++k) sums.add(2 + k, usable.status[i] == k);
      if (!is_counted(i)) continue;
      sums.add(5, 1);
      sums.add(6, m);
      sums.raise(0, -m);
    }
    team.join(sums);
    s.mass = sums.sum(0);
    s.displacement = sums.sum(1);
    s.counts[3] = n;
    for (int k = 0; k < 3; ++k) s.counts[3] -= s.counts[k] = sums.sum(2 + k);
    const double counted = sums.sum(5);
    c.left_out = static_cast<std::size_t>(n - counted);
    c.mean = counted > 0 ? sums.sum(6) / counted : 0;
    c.least = -sums.maximum(0);

    Usable_rule<Real> is_usable = usable;
    if (!(is_usable.mean_mass > 0)) is_usable.mean_mass = s.mass / n;
    Totals<3, 1> deviations;
    deviations.clear();
    for (int i = team.first(); i < n; i += team.stride()) {
      if (is_usable(i)) deviations.add(2, squared_offset(i));
      if (!is_counted(i) || !(c.mean > 0)) continue;
      const double deviation = std::fabs(mass(i) / c.mean - 1);
      deviations.add(0, deviation <= tolerance);
      deviations.add(1, deviation * deviation);
      deviations.raise(0, deviation);
    }
    team.join(deviations);
    s.residual = deviations.sum(2);
    if (c.mean > 0) {
      c.inside_interval = deviations.sum(0) / counted;
      c.rms = std::sqrt(deviations.sum(1) / counted);
      c.largest_deviation = deviations.maximum(0);
    }
    if (team.first() != 0) return;
    *result = s;
    host_result->cells = s;
    if (passes) host_result->passes = *passes;
  }

private:
  CGAL_POWER_RTF_HD bool is_counted(int i) const { return !is_left_out || !is_left_out[i]; }
  CGAL_POWER_RTF_HD double mass(int i) const
  { return double(usable.density[i]) * usable.area[i]; }
  CGAL_POWER_RTF_HD double squared_offset(int i) const
  {
    const double x = offset[i].x, y = offset[i].y, z = offset[i].z;
    return x * x + y * y + z * z;
  }
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_SUMMARY_RULE_H
