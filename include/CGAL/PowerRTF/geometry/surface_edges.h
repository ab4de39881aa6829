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
  std::vector<int> first;
  internal::Unset_vector<int> neighbor;
  internal::Unset_vector<double> length;
};

inline Surface_edges surface_edges(const Surface& surface,
                                   internal::Concurrency concurrency = Sequential_tag())
{
  const auto& triangles = surface.triangles;
  const int vertices = static_cast<int>(surface.points.size());
  const internal::Buckets<int>& corners = surface.adjacency.corners;
  // Every edge is one halfedge from each of its ends, except border edges: they have one only.
  const auto for_each_neighbor = [&](int v, auto&& f) {
    for (int k = corners.first[v]; k < corners.first[v + 1]; ++k) {
      const int h = corners.entries[k], before = previous_halfedge(h);
      if (surface.adjacency.opposite[before] == Facet_adjacency::none)
        f(halfedge_source(triangles, before));
      f(halfedge_target(triangles, h));
    }
  };
  Surface_edges edges;
  edges.first.assign(vertices + 1, 0);
  internal::for_each_index(concurrency, vertices,
                           [&](int v) { for_each_neighbor(v, [&](int) { ++edges.first[v]; }); });
  internal::exclusive_scan(concurrency, vertices + 1, edges.first.data());
  edges.neighbor.resize(edges.first[vertices]);
  edges.length.resize(edges.first[vertices]);
  internal::for_each_index(concurrency, vertices, [&](int v) {
    int end = edges.first[v];
    for_each_neighbor(v, [&](int u) {
      edges.neighbor[end] = u;
      edges.length[end++] = length(surface.points[u] - surface.points[v]);
    });
  });
  return edges;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SURFACE_EDGES_H
