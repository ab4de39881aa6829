// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nearest of points that are in spatial order, by a packed tree of boxes.
#ifndef CGAL_POWER_RTF_GEOMETRY_POINT_TREE_H
#define CGAL_POWER_RTF_GEOMETRY_POINT_TREE_H

#include <CGAL/PowerRTF/geometry/nearest_facet.h>

#include <vector>

namespace CGAL::PowerRTF {

/// The box of a point of an array.
struct Box_of_point {
  const Vec3d* points;
  CGAL_POWER_RTF_HD Box3<double> operator()(int i) const { return {points[i], points[i]}; }
};

/// Non-owning.
struct Point_tree_view {
  const Vec3d* points = nullptr;
  Packed_tree_layout tree;
  const Child_boxes* nodes = nullptr;

  /// Writes the `K` nearest points to `p`, at most `radius` away, of those that `counts(i)`
  /// accepts, by increasing distance, equal distances by place. Returns their number.
  template <int K, class Counts>
  CGAL_POWER_RTF_HD int nearest(const Vec3d& p, double radius, int* found, Counts counts) const
  {
    double distances[K];
    Nearest_items<double> nearest{K, distances, found};
    visit_near(
        tree, nodes, p,
        [&]() { return bound_of(nearest.is_full() ? nearest.farthest() : radius * radius); },
        [&](int i) {
          const double d = squared_length(points[i] - p);
          if (nearest.takes(d, i) && counts(i)) nearest.insert(d, i);
        });
    return nearest.count;
  }

  /// Whether `is_it(i)` for a point no farther than `radius` from `p`.
  template <class Is_it>
  CGAL_POWER_RTF_HD bool any_near(const Vec3d& p, double radius, Is_it is_it) const
  {
    bool found = false;
    visit_near(
        tree, nodes, p, [&]() { return found ? -1.f : bound_of(radius * radius); },
        [&](int i) {
          found = found || (squared_length(points[i] - p) <= radius * radius && is_it(i));
        });
    return found;
  }
};

/// Owns what is behind a `Point_tree_view`.
class Point_tree {
public:
  /// Keeps a reference to `points`, of coordinates of size at most 1.
  explicit Point_tree(const std::vector<Vec3d>& points)
      : m_points(points), m_tree(static_cast<int>(points.size())),
        m_nodes(child_boxes(m_tree, Box_of_point{points.data()}))
  {}

  Point_tree_view view() const { return {m_points.data(), m_tree, m_nodes.data()}; }

private:
  const std::vector<Vec3d>& m_points;
  Packed_tree_layout m_tree;
  std::vector<Child_boxes> m_nodes;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_POINT_TREE_H
