// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances of points from the facets of a tree, where a backend works, in double precision: they
// judge results.
#ifndef CGAL_POWER_RTF_ENGINES_FACET_DISTANCES_H
#define CGAL_POWER_RTF_ENGINES_FACET_DISTANCES_H

#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/internal/Single_lane.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// What stays of a facet's nearest point: the squared distance.
struct Facet_distance_rule {
  Surface_view<double> facets;
  const Vec3d* points;
  double* squared_distances;

  template <class Lanes>
  CGAL_POWER_RTF_HD void operator()(int i, Lanes lanes) const
  {
    constexpr int any_facet = 0; // to start with
    const Surface_point<double> nearest =
        project_to_nearest_facet(facets, points[i], Vec3d{0, 0, 0}, -2.0, any_facet, lanes);
    if (lanes.leads()) squared_distances[i] = nearest.squared_distance;
  }
};

template <class Backend>
struct Facet_distance_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Facet_corners<double>> facets;
  Buffer<Child_boxes> nodes;
  Buffer<Vec3d> points;
  Buffer<double> squared_distances;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, const Packed_tree_layout& tree, std::size_t n)
  {
    f(&Facet_distance_arrays::facets, std::size_t(tree.items));
    f(&Facet_distance_arrays::nodes, std::size_t(tree.nodes()));
    f(&Facet_distance_arrays::points, n);
    f(&Facet_distance_arrays::squared_distances, n);
  }
};

/// As `Find_distances`: `false` where the memory does not suffice. \pre there is a facet
template <class Backend>
bool facet_distances(Backend& backend, const Surface_view<double>& facets, int n,
                     const Vec3d* points, double* squared_distances)
{
  using Arrays = Facet_distance_arrays<Backend>;
  const Packed_tree_layout& tree = facets.facet_tree;
  if (!backend.has_room(bytes_of_listed<Arrays>(tree, std::size_t(n)))) return false;
  Arrays arrays;
  allocate_listed(backend, arrays, tree, std::size_t(n));
  backend.upload(arrays.facets.data(), facets.facets, arrays.facets.size());
  backend.upload(arrays.nodes.data(), facets.facet_nodes, arrays.nodes.size());
  backend.upload(arrays.points.data(), points, arrays.points.size());
  Surface_view<double> there;
  there.facet_tree = tree;
  there.facets = arrays.facets.data();
  there.facet_nodes = arrays.nodes.data();
  backend.for_each_by_lanes(
      n, Facet_distance_rule{there, arrays.points.data(), arrays.squared_distances.data()});
  backend.download(squared_distances, arrays.squared_distances.data(), std::size_t(n));
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_FACET_DISTANCES_H
