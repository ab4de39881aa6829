// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tree of a surface's facets, made where a backend works.
#ifndef CGAL_POWER_RTF_ENGINES_ARRANGE_FACETS_H
#define CGAL_POWER_RTF_ENGINES_ARRANGE_FACETS_H

#include <CGAL/PowerRTF/geometry/Arrange_facets.h>
#include <CGAL/PowerRTF/geometry/Surface_facets.h>
#include <CGAL/PowerRTF/geometry/curve_order.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>

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

  Buffer<int> order;
  Buffer<Box3<double>> boxes;
  Buffer<Child_boxes> nodes;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t facets)
  {
    using A = Facet_arrangement;
    const std::size_t nodes = Packed_tree_layout(static_cast<int>(facets)).nodes();
    f(&A::order, facets);
    f(&A::boxes, nodes);
    f(&A::nodes, nodes);
  }
};

} // namespace internal

/// As `Arrange_facets`: `false` where the memory does not suffice.
template <class Backend>
bool arrange_facets(Backend& backend, const Surface& surface, int* order, Child_boxes* nodes)
{
  using Arrays = internal::Facet_arrangement<Backend>;
  const std::size_t n = surface.triangles.size();
  const int facets = static_cast<int>(n);
  const Resident_surface* const resident = surface.resident.value.get();
  if (!backend.has_room(internal::bytes_of_listed<Arrays>(n) + internal::order_bytes<Backend>(n) +
                        internal::bytes_of_facets(backend, surface, resident)))
    return false;
  Arrays a;
  internal::Facet_buffers<Backend> buffers;
  internal::allocate_listed(backend, a, n);
  const Surface_facets there = internal::facets_there(backend, surface, resident, buffers);
  const Vec3d* const p = there.points;
  const int* const v = there.corners;
  internal::order_along_curve(backend, facets, internal::Face_centers{p, v}, a.order.data());
  fit_tree(backend, Packed_tree_layout(facets),
           internal::Box_of_ordered_facet{p, v, a.order.data()}, a.boxes.data(), a.nodes.data());
  backend.download(order, a.order.data(), a.order.size());
  backend.download(nodes, a.nodes.data(), a.nodes.size());
  return true;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_ARRANGE_FACETS_H
