// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface and the tree of its facets as an engine takes them: plain arrays of the host.
#ifndef CGAL_POWER_RTF_GEOMETRY_SURFACE_IN_TREE_H
#define CGAL_POWER_RTF_GEOMETRY_SURFACE_IN_TREE_H

#include <CGAL/PowerRTF/geometry/Surface_facets.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>

#include <memory>
#include <vector>

namespace CGAL::PowerRTF {

/// Refers to both.
struct Surface_in_tree {
  Surface_facets facets;
  std::shared_ptr<const Resident_surface> resident; ///< where a GPU has these, or null
  const Vec3d* vertex_normals = nullptr;
  const double* vertex_density = nullptr;
  double area = 0;
  Surface_view<double> tree;  ///< the facets alone
  const int* order = nullptr; ///< the facets by their places there
  // For rules that ask for the nearest vertices; else empty:
  std::vector<Child_boxes> vertex_nodes; ///< of a `Packed_tree_layout` over the vertices
  /// Places in the tree, of the corners `facets.vertex_corners`.
  internal::Unset_vector<int> vertex_facets;

  bool has_vertex_tree() const { return !vertex_nodes.empty(); }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SURFACE_IN_TREE_H
