// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The facets of a mesh in the order of a tree, where a backend works: those of `Facet_tree`, in
// double precision.
#ifndef CGAL_POWER_RTF_GEOMETRY_PLACED_FACETS_H
#define CGAL_POWER_RTF_GEOMETRY_PLACED_FACETS_H

#include <CGAL/PowerRTF/geometry/Find_distances.h>
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
struct Facet_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Vec3d> points;
  Buffer<Facet_corners<double>> facets;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, const Mesh_arrays& mesh)
  {
    f(&Facet_arrays::points, std::size_t(mesh.vertices));
    f(&Facet_arrays::facets, std::size_t(mesh.faces));
  }
};

/// The facets of a mesh of which a tree is there. `corners`: by place.
template <class Backend>
Surface_view<double> placed_facets(Backend& backend, Facet_arrays<Backend>& arrays,
                                   const Packed_tree_layout& tree, const int* corners,
                                   const Child_boxes* nodes)
{
  backend.for_each(tree.items,
                   Place_facets<double>{arrays.points.data(), corners, arrays.facets.data()});
  Surface_view<double> view;
  view.facets = arrays.facets.data();
  view.facet_vertices = corners;
  view.facet_nodes = nodes;
  view.facet_tree = tree;
  return view;
}

template <class Backend>
struct Mesh_tree_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> corners, order; ///< by place
  Buffer<Child_boxes> nodes;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, const Packed_tree_layout& tree)
  {
    f(&Mesh_tree_arrays::corners, 3 * std::size_t(tree.items));
    f(&Mesh_tree_arrays::order, std::size_t(tree.items));
    f(&Mesh_tree_arrays::nodes, std::size_t(tree.nodes()));
  }

  struct Construction {
    Buffer<int> corners;
    Buffer<Box3<double>> boxes;

    template <class F>
    static void for_each_array(F&& f, const Packed_tree_layout& tree)
    {
      f(&Construction::corners, 3 * std::size_t(tree.items));
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

/// The facets of a mesh and its tree, which this makes.
template <class Backend>
Surface_view<double> placed_mesh(Backend& backend, const Mesh_arrays& mesh,
                                 Facet_arrays<Backend>& arrays, Mesh_tree_arrays<Backend>& result)
{
  const Packed_tree_layout tree(mesh.faces);
  typename Mesh_tree_arrays<Backend>::Construction a;
  allocate_listed(backend, a, tree);
  const int* const corners = uploaded(backend, a.corners, mesh.corners);
  order_along_curve(backend, mesh.faces, Face_centers{arrays.points.data(), corners},
                    result.order.data());
  backend.for_each(mesh.faces, Order_corners{corners, result.order.data(), result.corners.data()});
  const Surface_view<double> view =
      placed_facets(backend, arrays, tree, result.corners.data(), result.nodes.data());
  fit_tree(backend, tree, Box_of_facet{view.facets}, a.boxes.data(), result.nodes.data());
  return view;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_PLACED_FACETS_H
