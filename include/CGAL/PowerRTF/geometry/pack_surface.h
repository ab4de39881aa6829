// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What engines work on is made from a surface and the tree of its facets.
#ifndef CGAL_POWER_RTF_GEOMETRY_PACK_SURFACE_H
#define CGAL_POWER_RTF_GEOMETRY_PACK_SURFACE_H

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Packed_surface.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// Adds what the rules over the nearest vertices look at.
inline void add_vertex_tree(const Surface& surface, const Facet_tree& tree, Packed_surface& result,
                            Concurrency concurrency)
{
  const std::size_t vertices = surface.points.size();
  result.vertices = surface.points;
  result.vertex_nodes = child_boxes(Packed_tree_layout(static_cast<int>(vertices)), [&](int v) {
    return Box3<double>{surface.points[v], surface.points[v]};
  });
  result.first_facet = surface.adjacency.corners.first;
  result.vertex_facets = surface.adjacency.corners.entries;
  for_each_index(concurrency, static_cast<int>(result.vertex_facets.size()),
                 [&](int k) { result.vertex_facets[k] = tree.place(result.vertex_facets[k] / 3); });
}

/// `tree`: of the surface's facets; `has_vertex_tree`: for rules that ask for the nearest vertices.
inline Packed_surface packed_surface(const Surface& surface, const Facet_tree& tree,
                                     bool has_vertex_tree,
                                     Concurrency concurrency = Sequential_tag())
{
  Packed_surface result;
  result.facets = tree.view();
  result.area = surface.area;
  result.attributes.resize(surface.points.size());
  for_each_index(concurrency, static_cast<int>(surface.points.size()), [&](int v) {
    result.attributes[v] = {surface.vertex_normals[v], surface.vertex_density[v]};
  });
  result.facet_vertices.resize(3 * surface.triangles.size());
  for_each_index(concurrency, static_cast<int>(surface.triangles.size()), [&](int k) {
    const Triangle& t = surface.triangles[tree.order()[k]];
    std::copy(t.begin(), t.end(), &result.facet_vertices[3 * k]);
  });
  if (has_vertex_tree) add_vertex_tree(surface, tree, result, concurrency);
  return result;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_PACK_SURFACE_H
