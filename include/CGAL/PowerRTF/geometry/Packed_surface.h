// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_PACKED_SURFACE_H
#define CGAL_POWER_RTF_GEOMETRY_PACKED_SURFACE_H

#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>

#include <vector>

namespace CGAL::PowerRTF {

/// The surface as an engine gets it: its vertices in their order, its facets in that of their tree,
/// which owns them and has to live as long.
struct Packed_surface {
  Surface_view<double> facets;                                  ///< the tree's
  internal::Unset_vector<int> facet_vertices;                   ///< three per facet
  internal::Unset_vector<Vertex_attributes<double>> attributes; ///< per vertex
  double area = 0;
  // For rules that ask for the nearest vertices; else empty:
  std::vector<Vec3d> vertices;
  std::vector<Child_boxes> vertex_nodes; ///< of a `Packed_tree_layout` over the vertices
  /// The facets at vertex v are `vertex_facets[first_facet[v]]` and so on to `first_facet[v + 1]`
  /// (places in the tree, by increasing number in the surface).
  internal::Unset_vector<int> first_facet, vertex_facets;

  /// All of it; lives as long as this.
  Surface_view<double> view() const
  {
    Surface_view<double> all = facets;
    all.facet_vertices = facet_vertices.data();
    all.attributes = attributes.data();
    if (vertices.empty()) return all;
    all.vertices = vertices.data();
    all.vertex_nodes = vertex_nodes.data();
    all.vertex_tree = Packed_tree_layout(int(vertices.size()));
    all.first_facet = first_facet.data();
    all.vertex_facets = vertex_facets.data();
    return all;
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_PACKED_SURFACE_H
