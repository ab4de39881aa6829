// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tree of a surface's facets, made where a backend works.
#ifndef CGAL_POWER_RTF_ENGINES_ARRANGE_FACETS_H
#define CGAL_POWER_RTF_ENGINES_ARRANGE_FACETS_H

#include <CGAL/PowerRTF/geometry/Arrange_facets.h>
#include <CGAL/PowerRTF/geometry/curve_order.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

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

template <class Backend>
struct Facet_arrangement {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Vec3d> points;
  Buffer<int> vertices, order;
  Buffer<Box3<double>> boxes;
  Buffer<Child_boxes> nodes;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices, std::size_t facets)
  {
    using A = Facet_arrangement;
    const std::size_t nodes = Packed_tree_layout(static_cast<int>(facets)).nodes();
    f(&A::points, vertices);
    f(&A::vertices, 3 * facets);
    f(&A::order, facets);
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
                        internal::order_bytes<Backend>(triangles.size())))
    return false;
  Arrays a;
  internal::allocate_listed(backend, a, points.size(), triangles.size());
  const Vec3d* const p = internal::uploaded(backend, a.points, points.data());
  const int* const v = internal::uploaded(backend, a.vertices, triangles.data()->data());
  internal::order_along_curve(backend, facets, internal::Face_centers{p, v}, a.order.data());
  fit_tree(backend, Packed_tree_layout(facets),
           internal::Box_of_ordered_facet{p, v, a.order.data()}, a.boxes.data(), a.nodes.data());
  backend.download(order, a.order.data(), a.order.size());
  backend.download(nodes, a.nodes.data(), a.nodes.size());
  return true;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_ARRANGE_FACETS_H
