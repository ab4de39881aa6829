// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edges of the border that the result has as they are: another mesh goes on there.
#ifndef CGAL_POWER_RTF_FEATURES_KEPT_EDGES_H
#define CGAL_POWER_RTF_FEATURES_KEPT_EDGES_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// Keeps edges of the border of `surface`, given by the input's vertices at their ends.
/// \param wanted, merged the edges, and the same between the vertices that these have become where
///   vertices were merged
/// \throws Invalid_input_error the border lacks one of them
inline void keep_edges(Surface& surface, const std::vector<Edge>& wanted,
                       const std::vector<Edge>& merged)
{
  std::vector<Edge> all = wanted, found; // by their ends in the input
  all.insert(all.end(), merged.begin(), merged.end());
  sort_uniquely(all);
  const std::vector<int>& opposite = surface.adjacency.opposite;
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h) {
    if (opposite[h] != Facet_adjacency::none) continue;
    const int a = halfedge_source(surface.triangles, h), b = halfedge_target(surface.triangles, h);
    const Edge ends = sorted_edge(surface.input_vertices[a], surface.input_vertices[b]);
    if (!std::binary_search(all.begin(), all.end(), ends)) continue;
    found.push_back(ends);
    surface.kept_edges.push_back(sorted_edge(a, b));
    surface.kept_vertices.insert(surface.kept_vertices.end(), {a, b});
  }
  sort_uniquely(found);
  sort_uniquely(surface.kept_edges);
  sort_uniquely(surface.kept_vertices);
  const auto is_found = [&](const Edge& e) {
    return std::binary_search(found.begin(), found.end(), e);
  };
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (!is_found(wanted[k]) && !is_found(merged[k]))
      throw Invalid_input_error("an edge that is to be kept cannot be: a facet at it has no area, "
                                "or it has more than one on the side that is remeshed");
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_KEPT_EDGES_H
