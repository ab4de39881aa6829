// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_NTH_VALUE_H
#define CGAL_POWER_RTF_INTERNAL_NTH_VALUE_H

#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The value that would be at place `n` if the finite `values`, a vector, were sorted. Counts how
/// many are in each of many intervals, and looks at those of one only: linear time while they are
/// spread out.
template <class Values>
double nth_value(Concurrency concurrency, const Values& values, std::size_t n)
{
  constexpr int intervals = 4096, chunk = 1 << 16;
  using Range = std::pair<double, double>;
  const int size = static_cast<int>(values.size());
  const auto [least, most] = reduce(
      concurrency, size, Range(values[0], values[0]),
      [&](Range& r, int i) {
        r = {(std::min)(r.first, values[i]), (std::max)(r.second, values[i])};
      },
      [](Range& r, const Range& part) {
        r = {(std::min)(r.first, part.first), (std::max)(r.second, part.second)};
      });
  const double first = least, scale = (intervals - 1) / (most - least);
  const auto interval = [&](int i) {
    return std::isfinite(scale) ? static_cast<int>((values[i] - first) * scale) : 0;
  };
  using Counts = std::array<int, intervals>;
  const Counts counts = reduce(
      concurrency, size, Counts{}, [&](Counts& c, int i) { ++c[interval(i)]; },
      [](Counts& c, const Counts& part) {
        for (int k = 0; k < intervals; ++k) c[k] += part[k];
      },
      chunk);
  int wanted = 0;
  for (; n >= static_cast<std::size_t>(counts[wanted]); ++wanted) n -= counts[wanted];
  std::vector<double> inside;
  for (const int i : select(concurrency, size, [&](int i) { return interval(i) == wanted; }))
    inside.push_back(values[i]);
  std::nth_element(inside.begin(), inside.begin() + n, inside.end());
  return inside[n];
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_NTH_VALUE_H
