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

#include <algorithm>
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
  const Box3<double> box = box_around(concurrency, n, points);
  const Vec3d middle = 0.5 * box.lo + 0.5 * box.hi, half = 0.5 * box.hi - 0.5 * box.lo;
  const double reach = std::max({half.x, half.y, half.z});
  const Hilbert_table& curve = Hilbert_table::get();
  Unset_vector<std::pair<std::uint64_t, int>> codes(n);
  for_each_index(concurrency, n, [&](int i) {
    const Vec3d p = points[i] - middle;
    const Vec3d inside{p.x / reach, p.y / reach, p.z / reach};
    codes[i] = {reach > 0 ? curve.index(hilbert_cube(inside)) : 0, i};
  });
  sort(concurrency, codes.begin(), codes.end());
  std::vector<int> order(n);
  for_each_index(concurrency, n, [&](int k) { order[k] = codes[k].second; });
  return order;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H
