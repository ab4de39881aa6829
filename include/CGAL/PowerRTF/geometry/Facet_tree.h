// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface's facets in a packed tree.
#ifndef CGAL_POWER_RTF_GEOMETRY_FACET_TREE_H
#define CGAL_POWER_RTF_GEOMETRY_FACET_TREE_H

#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/internal/Single_lane.h>

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
    m_order = internal::spatial_order(centers);
    for (std::size_t place = 0; place < m_order.size(); ++place) {
      m_places[m_order[place]] = static_cast<int>(place);
      if (!patches.empty()) m_patches.push_back(patches[m_order[place]]);
    }
    refit(points, triangles);
  }

  /// The same facets, moved; queries are fast as long as most are near where they were.
  void refit(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles)
  {
    for (std::size_t place = 0; place < m_order.size(); ++place) {
      const Triangle& t = triangles[m_order[place]];
      const Vec3d &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
      m_facets[place] = {a, b, c, normalized(cross(b - a, c - a))};
    }
    m_nodes = child_boxes(m_tree, [&](int place) {
      const Facet_corners<double>& f = m_facets[place];
      Box3<double> box{f.a, f.a};
      box.add(f.b);
      box.add(f.c);
      return box;
    });
  }

  /// The facets alone.
  Surface_view<double> view() const
  {
    Surface_view<double> view;
    view.facets = m_facets.data();
    view.patches = m_patches.empty() ? nullptr : m_patches.data();
    view.facet_nodes = m_nodes.data();
    view.facet_tree = m_tree;
    return view;
  }

  /// The nodes of the tree.
  const std::vector<Child_boxes>& nodes() const { return m_nodes; }
  /// The facets in the order of the tree.
  const std::vector<int>& order() const { return m_order; }
  /// The place of facet `f` in the tree.
  int place(int f) const { return m_places[f]; }

  /// The nearest point of the mesh to `p` on the facets whose normals make less than Theta with
  /// `normal` (`cos_angle`: its cosine). `hint`: a facet that is probably near, of the patch to
  /// look at; or -1. When no facet agrees, `facet` is -1. Ties go to the facet first in the tree.
  Surface_point<double> nearest(const Vec3d& p, const Vec3d& normal, double cos_angle,
                                int hint) const
  {
    Surface_point<double> result = project_to_nearest_facet(
        view(), p, normal, cos_angle, hint >= 0 ? m_places[hint] : -1, Single_lane());
    if (result.facet >= 0) result.facet = m_order[result.facet];
    return result;
  }
  /// The same on all facets of the patch.
  Surface_point<double> nearest(const Vec3d& p, int hint = -1) const
  {
    return nearest(p, Vec3d{0, 0, 0}, -2.0, hint);
  }

private:
  Packed_tree_layout m_tree;
  std::vector<Facet_corners<double>> m_facets; // in the order of the tree, as what follows
  std::vector<int> m_order, m_patches;
  std::vector<Child_boxes> m_nodes;
  std::vector<int> m_places; // by facet
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_FACET_TREE_H
