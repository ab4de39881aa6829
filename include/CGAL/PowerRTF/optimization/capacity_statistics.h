// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far the capacities are from equal: the interval test of Algorithms 2 and 3.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_CAPACITY_STATISTICS_H
#define CGAL_POWER_RTF_OPTIMIZATION_CAPACITY_STATISTICS_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace PowerRTF {

/// Statistics of the masses `mass(i)`, i < n, against [(1 - gamma), (1 + gamma)] times their mean,
/// but for those with `is_left_out(i)`.
template <class ConcurrencyTag, class Mass, class IsLeftOut>
Capacity_statistics capacity_statistics(int n, Mass&& mass, IsLeftOut&& is_left_out, double gamma)
{
  Capacity_statistics s;
  s.left_out = static_cast<std::size_t>(
      internal::sum<ConcurrencyTag>(n, [&](int i) { return double(is_left_out(i)); }));
  const double count = double(n) - double(s.left_out);
  if (!(count > 0)) return s;
  s.mean = internal::sum<ConcurrencyTag>(n, [&](int i) { return is_left_out(i) ? 0 : mass(i); }) / count;
  if (!(s.mean > 0)) return s;
  struct Partial {
    double inside = 0, squares = 0, largest = 0, least = std::numeric_limits<double>::infinity();
  };
  const Partial p = internal::reduce<ConcurrencyTag>(
      n, Partial{},
      [&](Partial& q, int i) {
        if (is_left_out(i)) return;
        const double m = mass(i), deviation = std::abs(m / s.mean - 1);
        q.least = std::min(q.least, m);
        q.inside += deviation <= gamma;
        q.squares += deviation * deviation;
        q.largest = std::max(q.largest, deviation);
      },
      [](Partial& q, const Partial& r) {
        q.inside += r.inside;
        q.squares += r.squares;
        q.largest = std::max(q.largest, r.largest);
        q.least = std::min(q.least, r.least);
      });
  s.least = p.least;
  s.inside_interval = p.inside / count;
  s.rms = std::sqrt(p.squares / count);
  s.largest_deviation = p.largest;
  return s;
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_OPTIMIZATION_CAPACITY_STATISTICS_H
