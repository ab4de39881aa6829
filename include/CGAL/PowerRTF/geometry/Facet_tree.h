// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface's facets in a packed tree.
#ifndef CGAL_POWER_RTF_GEOMETRY_FACET_TREE_H
#define CGAL_POWER_RTF_GEOMETRY_FACET_TREE_H

#include <CGAL/PowerRTF/geometry/Arrange_facets.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/geometry/for_each_node.h>
#include <CGAL/PowerRTF/internal/Single_lane.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// A search structure for the nearest point of a triangle mesh. Queries are read-only.
class Facet_tree {
  struct Corners_of {
    const std::vector<Vec3d>& points;
    const std::vector<Triangle>& triangles;

    std::array<Vec3d, 3> operator()(int f) const
    {
      const Triangle& t = triangles[f];
      return {points[t[0]], points[t[1]], points[t[2]]};
    }
  };

public:
  /// `points` and `triangles`: the mesh (#V by 3, #F by 3), in coordinates of size at most 1;
  /// `patches`: of the facets, or empty. `concurrency`: of the construction.
  Facet_tree(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles,
             const std::vector<int>& patches = {},
             internal::Concurrency concurrency = Sequential_tag())
      : Facet_tree(triangles.size(), Corners_of{points, triangles}, patches, concurrency)
  {}

  /// Of a surface with its patches. `arrange`: what does the most of the construction elsewhere,
  /// where it does.
  Facet_tree(const Surface& surface, internal::Concurrency concurrency,
             const Arrange_facets& arrange)
      : Facet_tree(surface.triangles.size(), surface.facet_patches, concurrency)
  {
    const Corners_of corners{surface.points, surface.triangles};
    m_order.resize(arrange ? surface.triangles.size() : 0);
    if (arrange && arrange(surface, m_order.data(), m_nodes.data()))
      take_facets(corners, surface.facet_patches);
    else
      build(corners, surface.facet_patches);
  }

  /// Of `facets` triangles. `corners`: function facet -> its three points.
  template <class Corners>
  Facet_tree(std::size_t facets, const Corners& corners, const std::vector<int>& patches,
             internal::Concurrency concurrency)
      : Facet_tree(facets, patches, concurrency)
  {
    build(corners, patches);
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

  /// The same as one patch.
  Surface_view<double> all_patches() const
  {
    Surface_view<double> all = view();
    all.patches = nullptr;
    return all;
  }

  /// The nodes of the tree.
  const internal::Unset_vector<Child_boxes>& nodes() const { return m_nodes; }
  /// The facets in the order of the tree.
  const std::vector<int>& order() const { return m_order; }
  /// The place of each facet in the tree.
  const internal::Unset_vector<int>& places() const { return m_places; }
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
  /// The same on all facets of the patch of `hint`.
  Surface_point<double> nearest(const Vec3d& p, int hint = -1) const
  {
    return nearest(p, Vec3d{0, 0, 0}, -2.0, hint);
  }
  /// The same on all facets of all patches.
  Surface_point<double> nearest_anywhere(const Vec3d& p, int hint = -1) const
  {
    Surface_point<double> result = project_to_nearest_facet(
        all_patches(), p, Vec3d{0, 0, 0}, -2.0, hint >= 0 ? m_places[hint] : -1, Single_lane());
    result.facet = m_order[result.facet];
    return result;
  }

  /// The same, or any point that is no farther from `p` than `enough`.
  Surface_point<double> near_enough(const Vec3d& p, double enough, int hint) const
  {
    const Surface_view<double> all = all_patches();
    const Facet_query<double> query(all, p, Vec3d{0, 0, 0}, -2.0, -1);
    Surface_point<double> best;
    float bound = 3e38f;
    const auto test = [&](int place) {
      const Surface_point<double> x = query.onto(place);
      if (!is_nearer(x, place, best, best.facet)) return;
      best = x;
      const bool is_enough = enough > 0 && x.squared_distance <= enough * enough;
      bound = is_enough ? -1.f : bound_of(x.squared_distance);
    };
    test(m_places[hint]);
    if (bound > 0)
      visit_near(
          m_tree, m_nodes.data(), Point_query(p), [&] { return bound; }, test);
    best.facet = m_order[best.facet];
    return best;
  }

private:
  Facet_tree(std::size_t facets, const std::vector<int>& patches, internal::Concurrency concurrency)
      : m_concurrency(concurrency), m_tree(static_cast<int>(facets)), m_facets(facets),
        m_patches(patches.size()), m_nodes(m_tree.nodes()), m_places(facets)
  {}

  template <class Corners>
  void build(const Corners& corners, const std::vector<int>& patches)
  {
    internal::Unset_vector<Vec3d> centers(m_facets.size());
    internal::for_each_index(m_concurrency, m_tree.items, [&](int f) {
      const auto [a, b, c] = corners(f);
      centers[f] = internal::center_of(a, b, c);
    });
    m_order = internal::spatial_order(centers, m_concurrency);
    take_facets(corners, patches);
    const internal::Box_of_facet box_of{m_facets.data()};
    internal::Unset_vector<Box3<double>> boxes(m_tree.nodes());
    internal::for_each_node(m_concurrency, m_tree, [&](int level, int k) {
      fit_child_boxes(m_tree, level, k, box_of, boxes.data(), m_nodes.data());
    });
  }

  /// Takes the facets to their places in the order.
  template <class Corners>
  void take_facets(const Corners& corners, const std::vector<int>& patches)
  {
    internal::for_each_index(m_concurrency, m_tree.items, [&](int place) {
      m_places[m_order[place]] = place;
      if (!patches.empty()) m_patches[place] = patches[m_order[place]];
      const auto [a, b, c] = corners(m_order[place]);
      m_facets[place] = facet_corners(a, b, c);
    });
  }

  internal::Concurrency m_concurrency;
  Packed_tree_layout m_tree;
  internal::Unset_vector<Facet_corners<double>>
      m_facets; // in the order of the tree, as what follows
  std::vector<int> m_order, m_patches;
  internal::Unset_vector<Child_boxes> m_nodes;
  internal::Unset_vector<int> m_places; // by facet
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_FACET_TREE_H
