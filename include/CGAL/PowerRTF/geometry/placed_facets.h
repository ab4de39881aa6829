// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The facets of a mesh in the order of a tree, where a backend works: those of `Facet_tree`, in
// double precision.
#ifndef CGAL_POWER_RTF_GEOMETRY_PLACED_FACETS_H
#define CGAL_POWER_RTF_GEOMETRY_PLACED_FACETS_H

#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/geometry/curve_order.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

template <class Real>
struct Place_facets {
  const Vec3d* points;
  const int* corners; ///< by place
  Facet_corners<Real>* facets;

  CGAL_POWER_RTF_HD void operator()(int place) const
  {
    const int* const v = corners + 3 * std::size_t(place);
    const Facet_corners<double> f = facet_corners(points[v[0]], points[v[1]], points[v[2]]);
    facets[place] = {to_real<Real>(f.a), to_real<Real>(f.b), to_real<Real>(f.c),
                     to_real<Real>(f.normal)};
  }
};

template <class Backend>
struct Mesh_tree_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> corners, order; ///< by place, as the facets
  Buffer<Facet_corners<double>> facets;
  Buffer<Child_boxes> nodes;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, const Packed_tree_layout& tree)
  {
    f(&Mesh_tree_arrays::corners, 3 * std::size_t(tree.items));
    f(&Mesh_tree_arrays::order, std::size_t(tree.items));
    f(&Mesh_tree_arrays::facets, std::size_t(tree.items));
    f(&Mesh_tree_arrays::nodes, std::size_t(tree.nodes()));
  }

  struct Construction {
    Buffer<Box3<double>> boxes;

    template <class F>
    static void for_each_array(F&& f, const Packed_tree_layout& tree)
    {
      f(&Construction::boxes, std::size_t(tree.nodes()));
    }
  };

  /// With what `placed_mesh()` takes besides.
  static std::size_t bytes(const Packed_tree_layout& tree)
  {
    return bytes_of_listed<Mesh_tree_arrays>(tree) + bytes_of_listed<Construction>(tree) +
           order_bytes<Backend>(tree.items);
  }
};

/// The facets of a mesh that is where the backend works, and their tree, which this makes.
template <class Backend>
Surface_view<double> placed_mesh(Backend& backend, const Mesh_arrays& mesh,
                                 Mesh_tree_arrays<Backend>& result)
{
  const Packed_tree_layout tree(mesh.faces);
  typename Mesh_tree_arrays<Backend>::Construction a;
  allocate_listed(backend, result, tree);
  allocate_listed(backend, a, tree);
  order_along_curve(backend, mesh.faces, Face_centers{mesh.points, mesh.corners},
                    result.order.data());
  backend.for_each(mesh.faces,
                   Order_corners{mesh.corners, result.order.data(), result.corners.data()});
  backend.for_each(mesh.faces,
                   Place_facets<double>{mesh.points, result.corners.data(), result.facets.data()});
  fit_tree(backend, tree, Box_of_facet{result.facets.data()}, a.boxes.data(), result.nodes.data());
  Surface_view<double> view;
  view.facets = result.facets.data();
  view.facet_vertices = result.corners.data();
  view.facet_nodes = result.nodes.data();
  view.facet_tree = tree;
  return view;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_PLACED_FACETS_H
