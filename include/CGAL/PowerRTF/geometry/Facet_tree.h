// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Owns the arrays behind a `Facets_view`: the surface's facets in a packed tree.
#ifndef CGAL_POWER_RTF_GEOMETRY_FACET_TREE_H
#define CGAL_POWER_RTF_GEOMETRY_FACET_TREE_H

#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>

namespace CGAL::PowerRTF {

/// A search structure for the nearest point of a triangle mesh. Queries are read-only.
class Facet_tree {
public:
  /// `points` and `triangles`: the mesh (#V by 3, #F by 3), in coordinates of size at most 1;
  /// `patches`: of the facets, or empty.
  Facet_tree(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles,
             const std::vector<int>& patches = {})
      : m_tree(static_cast<int>(triangles.size()))
  {
    std::vector<Vec3d> centers;
    centers.reserve(triangles.size());
    for (const Triangle& t : triangles)
      centers.push_back((points[t[0]] + points[t[1]] + points[t[2]]) * (1.0 / 3));
    m_places.resize(triangles.size());
    m_facets.resize(triangles.size());
    m_normals.resize(triangles.size());
    m_nodes.resize(m_tree.nodes());
    int place = 0;
    for (int f : internal::spatial_order(centers)) {
      m_places[f] = place++;
      if (!patches.empty()) m_patches.push_back(patches[f]);
    }
    refit(points, triangles);
  }

  /// The same facets, moved; queries are fast as long as most are near where they were.
  void refit(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles)
  {
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      const Triangle& t = triangles[f];
      const Vec3d &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
      m_facets[m_places[f]] = {a, b, c, static_cast<int>(f)};
      m_normals[m_places[f]] = normalized(cross(b - a, c - a));
    }
    std::vector<Box3<double>> boxes(m_tree.nodes());
    for (int level = 0; level < m_tree.levels; ++level)
      for (int k = 0; k < m_tree.nodes(level); ++k)
        fit_facets_node(m_tree, level, k, m_facets.data(), boxes.data(), m_nodes.data());
  }

  Facets_view<double> view() const
  {
    return {m_facets.data(), m_normals.data(), m_places.data(),
            m_nodes.data(),  m_tree,           m_patches.empty() ? nullptr : m_patches.data()};
  }

  /// The nearest point of the mesh to `p`; `hint`: a facet that is probably near, or -1.
  Surface_point<double> nearest(const Vec3d& p, int hint = -1) const
  {
    return nearest_facet(view(), p, Vec3d{0, 0, 0}, -2.0, hint);
  }

private:
  Packed_tree_layout m_tree;
  std::vector<Facets_view<double>::Facet> m_facets;
  std::vector<Vec3d> m_normals;
  std::vector<int> m_places, m_patches;
  std::vector<Child_boxes> m_nodes;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_FACET_TREE_H
