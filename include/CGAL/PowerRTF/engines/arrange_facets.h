// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tree of a surface's facets, made where a backend works.
#ifndef CGAL_POWER_RTF_ENGINES_ARRANGE_FACETS_H
#define CGAL_POWER_RTF_ENGINES_ARRANGE_FACETS_H

#include <CGAL/PowerRTF/engines/curve_order.h>
#include <CGAL/PowerRTF/geometry/Arrange_facets.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

struct Set_center {
  const Vec3d* points;
  const int* vertices;
  Vec3d* centers;

  CGAL_POWER_RTF_HD void operator()(int f) const
  {
    const int* const v = vertices + 3 * std::size_t(f);
    centers[f] = center_of(points[v[0]], points[v[1]], points[v[2]]);
  }
};

/// As `Box_of_facet`, of facets that are not yet in their places.
struct Box_of_ordered_facet {
  const Vec3d* points;
  const int *vertices, *order;

  CGAL_POWER_RTF_HD Box3<double> operator()(int place) const
  {
    const int* const v = vertices + 3 * std::size_t(order[place]);
    Box3<double> box{points[v[0]], points[v[0]]};
    box.add(points[v[1]]);
    box.add(points[v[2]]);
    return box;
  }
};

/// Fits the boxes of a node at some level.
struct Fit_node {
  Packed_tree_layout tree;
  int level;
  Box_of_ordered_facet box_of;
  Box3<double>* boxes;
  Child_boxes* nodes;

  CGAL_POWER_RTF_HD void operator()(int k) const
  {
    fit_child_boxes(tree, level, k, box_of, boxes, nodes);
  }
};

template <class Backend>
struct Facet_arrangement {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Vec3d> points, centers;
  Buffer<int> vertices, order;
  Buffer<std::uint64_t> keys;
  Buffer<double> maxima;
  Buffer<Box3<double>> boxes;
  Buffer<Child_boxes> nodes;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices, std::size_t facets)
  {
    using A = Facet_arrangement;
    const std::size_t nodes = Packed_tree_layout(static_cast<int>(facets)).nodes();
    f(&A::points, vertices);
    f(&A::centers, facets);
    f(&A::vertices, 3 * facets);
    f(&A::order, facets);
    f(&A::keys, facets);
    f(&A::maxima, std::size_t(6));
    f(&A::boxes, nodes);
    f(&A::nodes, nodes);
  }
};

} // namespace internal

/// As `Arrange_facets`: `false` where the memory does not suffice.
template <class Backend>
bool arrange_facets(Backend& backend, const std::vector<Vec3d>& points,
                    const std::vector<Triangle>& triangles, int* order, Child_boxes* nodes)
{
  using Arrays = internal::Facet_arrangement<Backend>;
  const int facets = static_cast<int>(triangles.size());
  if (!backend.has_room(internal::bytes_of_listed<Arrays>(points.size(), triangles.size()) +
                        backend.sort_bytes(facets)))
    return false;
  Arrays a;
  internal::allocate_listed(backend, a, points.size(), triangles.size());
  const Vec3d* const p = internal::uploaded(backend, a.points, points.data());
  const int* const v = internal::uploaded(backend, a.vertices, triangles.data()->data());
  backend.for_each(facets, internal::Set_center{p, v, a.centers.data()});
  internal::order_along_curve(backend, facets, a.centers.data(), a.maxima.data(), a.keys.data(),
                              a.order.data());
  const Packed_tree_layout tree(facets);
  for (int level = 0; level < tree.levels; ++level)
    backend.for_each(
        tree.nodes(level),
        internal::Fit_node{tree, level, {p, v, a.order.data()}, a.boxes.data(), a.nodes.data()});
  backend.download(order, a.order.data(), a.order.size());
  backend.download(nodes, a.nodes.data(), a.nodes.size());
  return true;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_ARRANGE_FACETS_H
