// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the capacities are from equal: the interval test of Algorithms 2 and 3.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_CAPACITY_STATISTICS_H
#define CGAL_POWER_RTF_OPTIMIZATION_CAPACITY_STATISTICS_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cmath>

namespace CGAL {
namespace PowerRTF {

/// Statistics of the masses `mass(i)`, i < n, against [(1 - gamma), (1 + gamma)] times their mean.
template <class ConcurrencyTag, class Mass>
Capacity_statistics capacity_statistics(int n, Mass&& mass, double gamma)
{
  Capacity_statistics s;
  if (n == 0) return s;
  const double mean = internal::sum<ConcurrencyTag>(n, mass) / n;
  if (!(mean > 0)) return s;
  struct Partial { double inside = 0, squares = 0, largest = 0; };
  const Partial p = internal::reduce<ConcurrencyTag>(
      n, Partial{},
      [&](Partial& q, int i) {
        const double deviation = std::abs(mass(i) / mean - 1);
        q.inside += deviation <= gamma;
        q.squares += deviation * deviation;
        q.largest = std::max(q.largest, deviation);
      },
      [](Partial& q, const Partial& r) {
        q.inside += r.inside;
        q.squares += r.squares;
        q.largest = std::max(q.largest, r.largest);
      });
  s.inside_interval = p.inside / n;
  s.rms = std::sqrt(p.squares / n);
  s.largest_deviation = p.largest;
  return s;
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_OPTIMIZATION_CAPACITY_STATISTICS_H
