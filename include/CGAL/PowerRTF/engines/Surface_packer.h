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
      : m_facets(tree.view())
  {
    const std::vector<int> vertices = spatial_order(surface.points);
    std::vector<int> vertex_places(vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) vertex_places[vertices[k]] = int(k);

    const std::size_t facets = surface.triangles.size();
    m_result.facets.resize(facets);
    m_result.has_patches = m_facets.patches != nullptr;
    for (std::size_t k = 0; k < facets; ++k) {
      const auto& from = m_facets.facets[k];
      auto& to = m_result.facets[k];
      to.corners[0] = from.a;
      to.corners[1] = from.b;
      to.corners[2] = from.c;
      to.normal = m_facets.normals[k];
      for (int c = 0; c < 3; ++c) to.vertices[c] = vertex_places[surface.triangles[from.id][c]];
      to.patch = m_facets.patches ? m_facets.patches[k] : 0;
    }
    m_result.facet_nodes.assign(m_facets.nodes, m_facets.nodes + m_facets.tree.nodes());
    for (const int v : vertices)
      m_result.vertices.push_back(
          {surface.points[v], surface.vertex_normals[v], surface.vertex_density[v]});
    m_result.area = surface.area;
    if (options.projection == Projection::nearest_vertices ||
        options.attributes == Attributes::nearest_vertices)
      add_vertex_tree(surface, vertices);
  }

  const Packed_surface& result() const { return m_result; }

private:
  void add_vertex_tree(const Surface& surface, const std::vector<int>& vertices)
  {
    const Packed_tree_layout tree(static_cast<int>(vertices.size()));
    std::vector<Box3<double>> boxes(tree.nodes());
    m_result.vertex_nodes.resize(tree.nodes());
    for (int level = 0; level < tree.levels; ++level)
      for (int k = 0; k < tree.nodes(level); ++k) {
        const int begin = tree.children_begin(k), end = tree.children_end(level, k);
        const int node = tree.first[level] + k;
        for (int c = begin; c < end; ++c) {
          const Vec3d* const p = level == 0 ? &surface.points[vertices[c]] : nullptr;
          const Box3<double> box = p ? Box3<double>{*p, *p} : boxes[tree.first[level - 1] + c];
          m_result.vertex_nodes[node].set(c - begin, box);
          if (c > begin)
            boxes[node].add(box);
          else
            boxes[node] = box;
        }
        for (int c = end - begin; c < Child_boxes::size; ++c) // unused
          m_result.vertex_nodes[node].set(c, boxes[node]);
      }
    const Vertex_facets around = vertex_facets(surface);
    m_result.first_facet.push_back(0);
    for (const int v : vertices) {
      for (int k = around.first[v]; k < around.first[v + 1]; ++k)
        m_result.vertex_facets.push_back(m_facets.places[around.facet[k]]);
      m_result.first_facet.push_back(static_cast<int>(m_result.vertex_facets.size()));
    }
  }

  Facets_view<double> m_facets;
  Packed_surface m_result;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_SURFACE_PACKER_H
