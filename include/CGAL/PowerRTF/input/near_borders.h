// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices that are one vertex: at the same place, or on borders up to rounding: cracks between
// facets that a file format or a transformation has torn.
#ifndef CGAL_POWER_RTF_INPUT_NEAR_BORDERS_H
#define CGAL_POWER_RTF_INPUT_NEAR_BORDERS_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/point_grid.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace CGAL::PowerRTF {

/// The first vertex at the same place, for each vertex (open addressing on the coordinates' bits).
inline std::vector<int> first_of_equal_points(const std::vector<Vec3d>& points,
                                              internal::Concurrency concurrency = Sequential_tag())
{
  const int size = static_cast<int>(points.size());
  std::size_t slots = 16;
  while (slots < 2 * points.size()) slots *= 2;
  std::vector<int> table(slots, -1);
  internal::Unset_vector<std::size_t> slot_of(points.size());
  // Of equal points the first one stays in the table, whichever slot they find.
  internal::for_each_index(concurrency, size, [&](int v) {
    const double key[3] = {points[v].x + 0., points[v].y + 0., points[v].z + 0.}; // -0 becomes 0
    std::uint64_t bits[3], hash = 0;
    std::memcpy(bits, key, sizeof(key));
    for (const std::uint64_t b : bits) {
      hash = (hash ^ b) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 32;
    }
    std::size_t slot = hash & (slots - 1);
    const auto is_free_for = [&](int found) { return found < 0 || points[found] == points[v]; };
    while (!is_free_for(atomic_exchange_if(&table[slot], -1, v))) slot = (slot + 1) & (slots - 1);
    atomic_min(&table[slot], v);
    slot_of[v] = slot;
  });
  std::vector<int> first(points.size());
  internal::for_each_index(concurrency, size, [&](int v) { first[v] = table[slot_of[v]]; });
  return first;
}

/// The widest crack: of the unit box, and of the shortest border edge beside it.
constexpr double crack_width = 1e-5;
constexpr double crack_width_per_edge = 0.05;

/// For each vertex the one that stands for it, once border vertices within the width of a crack are
/// one; empty: all are as they were. `points`: in the unit box.
inline std::vector<int> merged_near_borders(const std::vector<Vec3d>& points,
                                            const std::vector<Triangle>& triangles,
                                            const Facet_adjacency& adjacency,
                                            internal::Concurrency concurrency)
{
  const std::vector<int> halfedges =
      internal::select(concurrency, static_cast<int>(adjacency.opposite.size()),
                       [&](int h) { return adjacency.opposite[h] == Facet_adjacency::none; });
  std::vector<int> border;
  for (const int h : halfedges)
    border.insert(border.end(), {halfedge_source(triangles, h), halfedge_target(triangles, h)});
  sort_uniquely(border);
  const auto place = [&](int v) {
    return std::lower_bound(border.begin(), border.end(), v) - border.begin();
  };
  std::vector<double> width(border.size(), crack_width);
  for (const int h : halfedges) {
    const int a = halfedge_source(triangles, h), b = halfedge_target(triangles, h);
    const double of_edge = crack_width_per_edge * length(points[b] - points[a]);
    for (const int v : {a, b}) width[place(v)] = (std::min)(width[place(v)], of_edge);
  }

  boost::disjoint_sets_with_storage<> merged(border.size());
  const Point_grid grid(points, border, crack_width);
  bool is_any_merged = false;
  for (std::size_t k = 0; k < border.size(); ++k)
    grid.for_each_near(points[border[k]], width[k], [&](int b, double squared_distance) {
      const std::size_t other = place(b);
      if (other == k || squared_distance > width[other] * width[other]) return;
      merged.union_set(k, other);
      is_any_merged = true;
    });
  if (!is_any_merged) return {};
  std::vector<int> result(points.size());
  internal::for_each_index(concurrency, static_cast<int>(result.size()),
                           [&](int v) { result[v] = v; });
  for (std::size_t k = 0; k < border.size(); ++k) result[border[k]] = border[merged.find_set(k)];
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INPUT_NEAR_BORDERS_H
