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
  int n;
  const int* passes; ///< null: none were made
  Device_summary* result;
  Iteration_summary* host_result;

  template <class Team>
  CGAL_POWER_RTF_HD void operator()(Team& team) const
  {
    Device_summary s;
    Totals<6, 1> sums;
    sums.clear();
    for (int i = team.first(); i < n; i += team.stride()) {
      const double m = double(usable.density[i]) * usable.area[i];
      sums.add(0, m);
      sums.add(1, squared_offset(i));
      for (int k = 0; k < 4; ++k) sums.add(2 + k, usable.status[i] == k);
      sums.raise(0, -m);
    }
    team.join(sums);
    s.mass = sums.sum(0);
    s.displacement = sums.sum(1);
    for (int k = 0; k < 4; ++k) s.counts[k] = sums.sum(2 + k);
    s.least = -sums.maximum(0);

    Usable_rule<Real> is_usable = usable;
    if (!(is_usable.mean_mass > 0)) is_usable.mean_mass = s.mass / n;
    Totals<3, 1> deviations;
    deviations.clear();
    for (int i = team.first(); i < n; i += team.stride()) {
      const double m = double(usable.density[i]) * usable.area[i];
      const double deviation = std::fabs(m / (s.mass / n) - 1);
      deviations.add(0, deviation <= tolerance);
      deviations.add(1, deviation * deviation);
      if (is_usable(i)) deviations.add(2, squared_offset(i));
      deviations.raise(0, deviation);
    }
    team.join(deviations);
    s.inside = deviations.sum(0);
    s.squares = deviations.sum(1);
    s.residual = deviations.sum(2);
    s.largest = deviations.maximum(0);
    if (team.first() != 0) return;
    *result = s;
    host_result->cells = s;
    if (passes) host_result->passes = *passes;
  }

private:
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
