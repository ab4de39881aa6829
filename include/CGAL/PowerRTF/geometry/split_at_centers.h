// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_SPLIT_AT_CENTERS_H
#define CGAL_POWER_RTF_GEOMETRY_SPLIT_AT_CENTERS_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/surface_geometry.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <vector>

namespace CGAL::PowerRTF {

/// Cuts `facets` of `surface` into three each, at their centers: their edges stay whole. The new
/// vertices have the mean density of the facets' corners and the place in the input of one of them.
inline void split_at_centers(Surface& surface, const std::vector<int>& facets,
                             internal::Concurrency concurrency = Sequential_tag())
{
  for (const int f : facets) {
    const Triangle t = surface.triangles[f];
    const auto [a, b, c] = t;
    const int center = static_cast<int>(surface.points.size());
    const auto mean = [&t](const auto& values) {
      return (values[t[0]] + values[t[1]] + values[t[2]]) * (1. / 3);
    };
    surface.points.push_back(mean(surface.points));
    surface.vertex_density.push_back(mean(surface.vertex_density));
    surface.input_vertices.push_back(surface.input_vertices[a]);
    surface.triangles[f] = {a, b, center};
    surface.triangles.insert(surface.triangles.end(), {{b, c, center}, {c, a, center}});
    if (!surface.facet_labels.empty())
      surface.facet_labels.resize(surface.triangles.size(), surface.facet_labels[f]);
  }
  surface.topology = {};
  surface.adjacency = facet_adjacency(surface.triangles, surface.points.size(), concurrency);
  compute_geometry(surface, concurrency);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SPLIT_AT_CENTERS_H
