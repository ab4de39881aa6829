// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order along a space-filling curve that packed trees ask for.
#ifndef CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H
#define CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H

#include <CGAL/PowerRTF/geometry/Hilbert_table.h>
#include <CGAL/PowerRTF/geometry/box_around.h>
#include <CGAL/PowerRTF/internal/order_by_key.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A surface of no more facets needs no order in space: caches hold it as it is.
constexpr std::size_t facets_in_caches = 1 << 16;

/// The indices of `points`, a vector, along the Hilbert curve through the cube around them. No size
/// or position decides it.
template <class Points>
std::vector<int> spatial_order(const Points& points, Concurrency concurrency = Sequential_tag())
{
  if (points.empty()) return {};
  const int n = static_cast<int>(points.size());
  const Curve_cube cube(box_around(concurrency, n, points));
  const Hilbert_table& curve = Hilbert_table::get();
  std::vector<int> order(n);
  order_by_key(
      concurrency, n, [&](int i) { return curve.index(cube(points[i])); }, order.data());
  return order;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H
