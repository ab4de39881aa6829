// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order along a space-filling curve that packed trees ask for.
#ifndef CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H
#define CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H

#include <CGAL/PowerRTF/geometry/Hilbert_table.h>
#include <CGAL/PowerRTF/geometry/box_around.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The indices of `points`, a vector, along the Hilbert curve through the cube around them. No size
/// or position decides it.
template <class Points>
std::vector<int> spatial_order(const Points& points, Concurrency concurrency = Sequential_tag())
{
  if (points.empty()) return {};
  const int n = static_cast<int>(points.size());
  const Curve_cube cube(box_around(concurrency, n, points));
  const Hilbert_table& curve = Hilbert_table::get();
  Unset_vector<std::pair<std::uint64_t, int>> codes(n);
  for_each_index(concurrency, n, [&](int i) { codes[i] = {curve.index(cube(points[i])), i}; });
  sort(concurrency, codes.begin(), codes.end());
  std::vector<int> order(n);
  for_each_index(concurrency, n, [&](int k) { order[k] = codes[k].second; });
  return order;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H
