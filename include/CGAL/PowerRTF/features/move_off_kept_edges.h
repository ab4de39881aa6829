// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_FEATURES_MOVE_OFF_KEPT_EDGES_H
#define CGAL_POWER_RTF_FEATURES_MOVE_OFF_KEPT_EDGES_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <algorithm>
#include <cstddef>

namespace CGAL::PowerRTF {

/// Moves the first `count` samples into their facets where they are on a kept edge. (Beside one
/// much longer than the spacing, cells reach beyond the border.) On it their triangle with the edge
/// would have no area, and no improvement could tell which way they should go.
inline void move_off_kept_edges(const Surface& surface, std::size_t count, Samples& samples)
{
  constexpr double least_height = 0.03; // of the facet's
  if (surface.kept_edges.empty()) return;
  for (std::size_t s = 0; s < count; ++s) {
    const Triangle& t = surface.triangles[samples.facets[s]];
    const Vec3d &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
    Vec3d& p = samples.points[s];
    for (int i = 0; i < 3; ++i) {
      const int from = t[i], to = t[(i + 1) % 3];
      const Vec3d side = surface.points[to] - surface.points[from];
      const double height = length(cross(side, p - surface.points[from]));
      if (height < least_height * length(cross(b - a, c - a)) &&
          std::binary_search(surface.kept_edges.begin(), surface.kept_edges.end(),
                             sorted_edge(from, to)))
        p = 0.5 * p + (1. / 6) * (a + b + c);
    }
  }
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_MOVE_OFF_KEPT_EDGES_H
