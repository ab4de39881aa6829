// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_VERTEX_FACETS_H
#define CGAL_POWER_RTF_GEOMETRY_VERTEX_FACETS_H

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// The facets at vertex `v` are `facet[first[v]] .. facet[first[v + 1] - 1]`, increasing.
struct Vertex_facets {
  std::vector<int> first, facet;
};

inline Vertex_facets vertex_facets(const Surface& surface)
{
  Vertex_facets result;
  result.first.assign(surface.points.size() + 1, 0);
  for (const Triangle& t : surface.triangles)
    for (const int v : t) ++result.first[v + 1];
  for (std::size_t v = 0; v < surface.points.size(); ++v) result.first[v + 1] += result.first[v];
  result.facet.resize(3 * surface.triangles.size());
  std::vector<int> end(result.first.begin(), result.first.end() - 1);
  for (std::size_t f = 0; f < surface.triangles.size(); ++f)
    for (const int v : surface.triangles[f]) result.facet[end[v]++] = static_cast<int>(f);
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_VERTEX_FACETS_H
