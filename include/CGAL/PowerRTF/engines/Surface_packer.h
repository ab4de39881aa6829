// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface as an engine gets it.
#ifndef CGAL_POWER_RTF_ENGINES_SURFACE_PACKER_H
#define CGAL_POWER_RTF_ENGINES_SURFACE_PACKER_H

#include <CGAL/PowerRTF/engines/Engine_base.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/vertex_facets.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The surface in the order of its trees.
class Surface_packer {
public:
  Surface_packer(const Surface& surface, const Facet_tree& tree, const Remeshing_options& options)
  {
    const std::vector<int> vertices = spatial_order(surface.points);
    std::vector<int> vertex_places(vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) vertex_places[vertices[k]] = int(k);
    const Surface_view<double> view = tree.view();
    m_result.has_patches = view.patches != nullptr;
    for (int k = 0; k < view.facet_tree.items; ++k) {
      const Facet_corners<double>& f = view.facets[k];
      const Triangle& t = surface.triangles[tree.order()[k]];
      m_result.facets.push_back({{f.a, f.b, f.c},
                                 f.normal,
                                 {vertex_places[t[0]], vertex_places[t[1]], vertex_places[t[2]]},
                                 view.patches ? view.patches[k] : 0});
    }
    m_result.facet_nodes = tree.nodes();
    for (const int v : vertices)
      m_result.vertices.push_back(
          {surface.points[v], surface.vertex_normals[v], surface.vertex_density[v]});
    m_result.area = surface.area;
    if (options.projection == Projection::nearest_vertices ||
        options.attributes == Attributes::nearest_vertices)
      add_vertex_tree(surface, vertices, tree);
  }

  const Packed_surface& result() const { return m_result; }

private:
  void add_vertex_tree(const Surface& surface, const std::vector<int>& vertices,
                       const Facet_tree& tree)
  {
    m_result.vertex_nodes =
        child_boxes(Packed_tree_layout(static_cast<int>(vertices.size())), [&](int place) {
          const Vec3d& p = surface.points[vertices[place]];
          return Box3<double>{p, p};
        });
    const Vertex_facets around = vertex_facets(surface);
    m_result.first_facet.push_back(0);
    for (const int v : vertices) {
      for (int k = around.first[v]; k < around.first[v + 1]; ++k)
        m_result.vertex_facets.push_back(tree.place(around.facet[k]));
      m_result.first_facet.push_back(static_cast<int>(m_result.vertex_facets.size()));
    }
  }

  Packed_surface m_result;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_SURFACE_PACKER_H
