// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges of a surface as a graph on its vertices, in compressed rows.
#ifndef CGAL_POWER_RTF_GEOMETRY_SURFACE_EDGES_H
#define CGAL_POWER_RTF_GEOMETRY_SURFACE_EDGES_H

#include <CGAL/PowerRTF/geometry/Edges_view.h>
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

  Edges_view view() const { return {first.data(), neighbor.data(), length.data()}; }
};

inline Surface_edges surface_edges(const Surface& surface,
                                   internal::Concurrency concurrency = Sequential_tag())
{
  const int vertices = static_cast<int>(surface.points.size());
  const internal::Buckets<int>& corners = surface.adjacency.corners;
  const internal::Vertex_neighbors neighbors{corners.first.data(), corners.entries.data(),
                                             surface.triangles.data()->data(),
                                             surface.adjacency.opposite.data()};
  Surface_edges edges;
  edges.first.assign(vertices + 1, 0);
  internal::for_each_index(concurrency, vertices,
                           internal::Count_neighbors{neighbors, edges.first.data()});
  internal::exclusive_scan(concurrency, vertices + 1, edges.first.data());
  edges.neighbor.resize(edges.first[vertices]);
  edges.length.resize(edges.first[vertices]);
  internal::for_each_index(concurrency, vertices,
                           internal::List_neighbors{neighbors, surface.points.data(),
                                                    edges.first.data(), edges.neighbor.data(),
                                                    edges.length.data()});
  return edges;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SURFACE_EDGES_H
