// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_VERTEX_CORNERS_H
#define CGAL_POWER_RTF_GEOMETRY_VERTEX_CORNERS_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/Buckets.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// One more than the largest vertex of the triangles; 0 where there is none.
inline int vertex_range(const std::vector<Triangle>& triangles,
                        internal::Concurrency concurrency = Sequential_tag())
{
  const auto raise = [](int& most, int n) { most = (std::max)(most, n); };
  return internal::reduce(
      concurrency, static_cast<int>(triangles.size()), 0,
      [&](int& most, int f) {
        for (const int v : triangles[f]) raise(most, v + 1);
      },
      raise);
}

/// The corners by vertex; corner `3 f + i` is that of facet `f` at its vertex number `i`, and the
/// halfedge that leaves it.
inline internal::Buckets<int> vertex_corners(const std::vector<Triangle>& triangles,
                                             std::size_t number_of_vertices,
                                             internal::Concurrency concurrency = Sequential_tag())
{
  return {concurrency, static_cast<int>(3 * triangles.size()), number_of_vertices,
          [&](int c) { return triangles[c / 3][c % 3]; }, [](int c) { return c; }};
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_VERTEX_CORNERS_H
