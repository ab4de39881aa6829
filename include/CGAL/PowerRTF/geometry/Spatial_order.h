// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order along a space-filling curve that packed trees ask for.
#ifndef CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H
#define CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <numeric>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The indices of `points` along a Hilbert curve with median cuts.
inline std::vector<int> spatial_order(const std::vector<Vec3d>& points)
{
  using Kernel = Exact_predicates_inexact_constructions_kernel;
  using Point_map = Pointer_property_map<Kernel::Point_3>::type;
  std::vector<Kernel::Point_3> copies;
  copies.reserve(points.size());
  for (const Vec3d& p : points) copies.emplace_back(p.x, p.y, p.z);
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  using Sort_traits = Spatial_sort_traits_adapter_3<Kernel, Point_map>;
  Hilbert_sort_3<Sort_traits, Hilbert_sort_median_policy> sort{
      Sort_traits(make_property_map(copies))};
  sort(order.begin(), order.end());
  return order;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H
