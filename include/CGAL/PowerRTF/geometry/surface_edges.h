// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges of a surface as a graph on its vertices, in compressed rows.
#ifndef CGAL_POWER_RTF_GEOMETRY_SURFACE_EDGES_H
#define CGAL_POWER_RTF_GEOMETRY_SURFACE_EDGES_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// The neighbors of vertex `v` are `neighbor[first[v]] .. neighbor[first[v + 1] - 1]`, each once,
/// at distance `length` (same index).
struct Surface_edges {
  std::vector<int> first, neighbor;
  std::vector<double> length;
};

inline Surface_edges surface_edges(const Surface& surface)
{
  const auto& triangles = surface.triangles;
  const std::size_t vertices = surface.points.size();
  const int halfedges = static_cast<int>(3 * triangles.size());

  // Every edge is one halfedge from each of its ends, except border edges: they have one only.
  const auto is_border = [&](int h) {
    return surface.adjacency.opposite[h] == Facet_adjacency::none;
  };
  Surface_edges edges;
  edges.first.assign(vertices + 1, 0);
  for (int h = 0; h < halfedges; ++h) {
    ++edges.first[halfedge_source(triangles, h) + 1];
    if (is_border(h)) ++edges.first[halfedge_target(triangles, h) + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) edges.first[v + 1] += edges.first[v];
  edges.neighbor.resize(edges.first[vertices]);
  edges.length.resize(edges.first[vertices]);
  std::vector<int> end(edges.first.begin(), edges.first.end() - 1);
  for (int h = 0; h < halfedges; ++h) {
    const int a = halfedge_source(triangles, h), b = halfedge_target(triangles, h);
    const double l = length(surface.points[b] - surface.points[a]);
    edges.neighbor[end[a]] = b;
    edges.length[end[a]++] = l;
    if (!is_border(h)) continue;
    edges.neighbor[end[b]] = a;
    edges.length[end[b]++] = l;
  }
  return edges;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SURFACE_EDGES_H
