// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order along a space-filling curve that packed trees ask for.
#ifndef CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H
#define CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H

#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <vector>

namespace CGAL::PowerRTF::internal {

/// A readable property map of points that polls: all that a sort does is to compare them.
template <class Point>
struct Polled_points {
  using key_type = int;
  using value_type = Point;
  using reference = const Point&;
  using category = boost::readable_property_map_tag;

  const Point* points;

  friend reference get(const Polled_points& map, int i)
  {
    Cancellation::poll_now_and_then();
    return map.points[i];
  }
};

/// The indices of `points` along a Hilbert curve with median cuts.
inline std::vector<int> spatial_order(const std::vector<Vec3d>& points,
                                      Concurrency concurrency = Sequential_tag())
{
  using Kernel = Exact_predicates_inexact_constructions_kernel;
  using Point_map = Polled_points<Kernel::Point_3>;
  using Sort_traits = Spatial_sort_traits_adapter_3<Kernel, Point_map>;
  std::vector<Kernel::Point_3> copies(points.size());
  std::vector<int> order(points.size());
  for_each_index(concurrency, int(points.size()), [&](int i) {
    copies[i] = Kernel::Point_3(points[i].x, points[i].y, points[i].z);
    order[i] = i;
  });
  const Sort_traits traits(Point_map{copies.data()});
  if (concurrency.is_parallel())
    Hilbert_sort_3<Sort_traits, Hilbert_sort_median_policy, Parallel_if_available_tag>{traits}(
        order.begin(), order.end());
  else
    Hilbert_sort_3<Sort_traits, Hilbert_sort_median_policy>{traits}(order.begin(), order.end());
  return order;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_SPATIAL_ORDER_H
