// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nearest of points that are in spatial order, by a packed tree of boxes.
#ifndef CGAL_POWER_RTF_GEOMETRY_POINT_TREE_H
#define CGAL_POWER_RTF_GEOMETRY_POINT_TREE_H

#include <CGAL/PowerRTF/geometry/nearest_facet.h>

namespace CGAL::PowerRTF {

/// The box of a point of an array.
template <class Real>
struct Box_of_point {
  const Vec3<Real>* points;
  CGAL_POWER_RTF_HD Box3<double> operator()(int i) const
  {
    const Vec3d p{points[i].x, points[i].y, points[i].z};
    return {p, p};
  }
};

/// Some of the points.
template <class Real>
struct Near_points {
  static constexpr int capacity = 128;
  Real x[capacity], y[capacity], z[capacity];
  int items[capacity];
  int count = 0;
};

/// Non-owning.
template <class Real>
struct Point_tree_view {
  const Vec3<Real>* points = nullptr;
  Packed_tree_layout tree;
  const Child_boxes* nodes = nullptr;

  /// Of the tree, each with the points from `tree.children_begin(leaf)` on.
  CGAL_POWER_RTF_HD int leaves() const { return tree.levels > 0 ? tree.nodes(0) : 0; }

  /// Writes the `K` nearest points to `p`, at most `radius` away, of those that `counts(i)`
  /// accepts, by increasing distance, equal distances by place. Returns their number.
  template <int K, class Counts>
  CGAL_POWER_RTF_HD int nearest(const Vec3<Real>& p, Real radius, int* found, Counts counts) const
  {
    Real distances[K];
    Nearest_items<Real> nearest{K, distances, found};
    visit_near(
        tree, nodes, Point_query(p),
        [&]() { return bound_of(nearest.is_full() ? nearest.farthest() : radius * radius); },
        [&](int i) {
          const Real d = squared_length(points[i] - p);
          if (nearest.takes(d, i) && counts(i)) nearest.insert(d, i);
        });
    return nearest.count;
  }

  /// Finds all points no farther than `radius` from the box of the points [`begin`, `end`).
  /// \returns `false` if they are too many
  CGAL_POWER_RTF_HD bool find_near(int begin, int end, Real radius, Near_points<Real>& near) const
  {
    const Box_of_point<Real> box_of{points};
    Box3<double> box = box_of(begin);
    for (int i = begin + 1; i < end; ++i) box.add(box_of(i));
    const float bound = bound_of(radius * radius);
    near.count = 0;
    visit_near(
        tree, nodes, Box_query(box),
        [&]() { return near.count <= Near_points<Real>::capacity ? bound : -1.f; },
        [&](int i) {
          if (near.count < Near_points<Real>::capacity) near.items[near.count] = i;
          ++near.count;
        });
    if (near.count > Near_points<Real>::capacity) return false;
    for (int k = 0; k < near.count; ++k) {
      const Vec3<Real> p = points[near.items[k]];
      near.x[k] = p.x;
      near.y[k] = p.y;
      near.z[k] = p.z;
    }
    return true;
  }

  /// `nearest()` among the points of `near`.
  template <int K, class Counts>
  CGAL_POWER_RTF_HD int nearest_of(const Near_points<Real>& near, const Vec3<Real>& p, Real radius,
                                   int* found, Counts counts) const
  {
    Real squared[Near_points<Real>::capacity], distances[K];
    for (int k = 0; k < near.count; ++k) {
      const Real x = near.x[k] - p.x, y = near.y[k] - p.y, z = near.z[k] - p.z;
      squared[k] = x * x + y * y + z * z;
    }
    int inside[Near_points<Real>::capacity], number = 0;
    for (int k = 0; k < near.count; ++k) { // without branches, which would be guessed wrong
      inside[number] = k;
      number += squared[k] <= radius * radius;
    }
    Nearest_items<Real> nearest{K, distances, found};
    for (int m = 0; m < number; ++m) {
      const int k = inside[m], i = near.items[k];
      if (nearest.takes(squared[k], i) && counts(i)) nearest.insert(squared[k], i);
    }
    return nearest.count;
  }

  /// Whether `is_it(i)` for a point no farther than `radius` from `p`.
  template <class Is_it>
  CGAL_POWER_RTF_HD bool any_near(const Vec3<Real>& p, Real radius, Is_it is_it) const
  {
    bool found = false;
    visit_near(
        tree, nodes, Point_query(p), [&]() { return found ? -1.f : bound_of(radius * radius); },
        [&](int i) {
          found = found || (squared_length(points[i] - p) <= radius * radius && is_it(i));
        });
    return found;
  }
};

/// Owns what is behind a `Point_tree_view`, but for the points.
template <class Backend, class Real>
class Point_tree {
public:
  /// Of `n` points with coordinates of size at most 1, where the backend sees them.
  Point_tree(Backend& backend, const Vec3<Real>* points, int n) : m_points(points), m_tree(n)
  {
    typename Backend::template Buffer<Box3<double>> boxes;
    boxes.allocate(backend, m_tree.nodes());
    m_nodes.allocate(backend, m_tree.nodes());
    fit_tree(backend, m_tree, Box_of_point<Real>{m_points}, boxes.data(), m_nodes.data());
  }

  Point_tree_view<Real> view() const { return {m_points, m_tree, m_nodes.data()}; }

private:
  const Vec3<Real>* m_points;
  Packed_tree_layout m_tree;
  typename Backend::template Buffer<Child_boxes> m_nodes;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_POINT_TREE_H
