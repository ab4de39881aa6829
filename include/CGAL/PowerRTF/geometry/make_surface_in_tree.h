// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_MAKE_SURFACE_IN_TREE_H
#define CGAL_POWER_RTF_GEOMETRY_MAKE_SURFACE_IN_TREE_H

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/Surface_in_tree.h>
#include <CGAL/PowerRTF/internal/parallel.h>

namespace CGAL::PowerRTF::internal {

/// `has_vertex_tree`: for rules that ask for the nearest vertices.
inline Surface_in_tree make_surface_in_tree(const Surface& surface, const Facet_tree& tree,
                                            bool has_vertex_tree = false,
                                            Concurrency concurrency = Sequential_tag())
{
  Surface_in_tree result;
  result.facets = surface;
  result.resident = surface.resident.value;
  result.vertex_normals = surface.vertex_normals.data();
  result.vertex_density = surface.vertex_density.data();
  result.area = surface.area;
  result.tree = tree.view();
  result.order = tree.order().data();
  if (!has_vertex_tree) return result;
  result.vertex_nodes = child_boxes(Packed_tree_layout(result.facets.vertices), [&](int v) {
    return Box3<double>{surface.points[v], surface.points[v]};
  });
  const Unset_vector<int>& corners = surface.adjacency.corners.entries;
  result.vertex_facets.resize(corners.size());
  for_each_index(concurrency, static_cast<int>(corners.size()),
                 [&](int k) { result.vertex_facets[k] = tree.place(corners[k] / 3); });
  return result;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_MAKE_SURFACE_IN_TREE_H
