// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A halfedge mesh from triangles, all at once.
#ifndef CGAL_POWER_RTF_EXTRACTION_CONNECT_HALFEDGES_H
#define CGAL_POWER_RTF_EXTRACTION_CONNECT_HALFEDGES_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <vector>

namespace CGAL {

template <class Point>
class Surface_mesh;

namespace PowerRTF::internal {

/// Makes `triangles`, on vertices below `vertices`, the faces of an empty mesh; its points are not
/// set. The halfedges of edge e are 2 e, of the first of its triangles, and 2 e + 1; the edges
/// count in the order of these.
/// \returns `false`, with nothing done, if the triangles are no oriented 2-manifold.
template <class Point>
bool connect_halfedges(CGAL::Surface_mesh<Point>& mesh, const std::vector<Triangle>& triangles,
                       int vertices, Concurrency concurrency)
{
  using Mesh = CGAL::Surface_mesh<Point>;
  using Vertex = typename Mesh::Vertex_index;
  using Halfedge = typename Mesh::Halfedge_index;
  using Face = typename Mesh::Face_index;
  constexpr int none = Facet_adjacency::none;
  const Facet_adjacency adjacency = facet_adjacency(triangles, vertices, concurrency);
  if (adjacency.non_manifold_edges > 0 || adjacency.same_direction ||
      count_non_manifold_vertices(adjacency, concurrency) > 0)
    return false;

  const std::vector<int>& opposite = adjacency.opposite;
  const int halfedges = int(opposite.size());
  const auto is_first = [&](int h) { return opposite[h] == none || h < opposite[h]; };
  Unset_vector<int> edges(halfedges); // before each halfedge
  for_each_index(concurrency, halfedges, [&](int h) { edges[h] = is_first(h); });
  const int count = exclusive_scan(concurrency, halfedges, edges.data());
  mesh.resize(vertices, count, typename Mesh::size_type(triangles.size()));

  const auto halfedge = [&](int h) {
    return is_first(h) ? Halfedge(2 * edges[h]) : Halfedge(2 * edges[opposite[h]] + 1);
  };
  std::vector<int> last(vertices, -1); // of the halfedges to each vertex
  for_each_index(concurrency, halfedges, [&](int h) {
    mesh.set_target(halfedge(h), Vertex(halfedge_target(triangles, h)));
    mesh.set_next(halfedge(h), halfedge(next_halfedge(h)));
    mesh.set_face(halfedge(h), Face(h / 3));
    if (h % 3 == 0) mesh.set_halfedge(Face(h / 3), halfedge(h));
    atomic_max(&last[halfedge_target(triangles, h)], h);
  });
  for_each_index(concurrency, vertices, [&](int v) {
    if (last[v] >= 0) mesh.set_halfedge(Vertex(v), halfedge(last[v]));
  });
  if (adjacency.border_edges == 0) return true;
  const std::vector<int> at_border =
      select(concurrency, halfedges, [&](int h) { return opposite[h] == none; });
  std::vector<Halfedge> leaving(vertices); // on the border
  for (const int h : at_border) {
    mesh.set_target(mesh.opposite(halfedge(h)), Vertex(halfedge_source(triangles, h)));
    leaving[halfedge_target(triangles, h)] = mesh.opposite(halfedge(h));
  }
  for (const int h : at_border) {
    const Halfedge border = mesh.opposite(halfedge(h));
    mesh.set_next(border, leaving[halfedge_source(triangles, h)]);
    mesh.set_halfedge(mesh.target(border), border);
  }
  return true;
}

} // namespace PowerRTF::internal
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_CONNECT_HALFEDGES_H
