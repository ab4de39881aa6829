// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface of triangles that need no repair, made where a backend works. It is what the host
// makes, but for the last bits of normals and of the area.
#ifndef CGAL_POWER_RTF_ENGINES_BUILD_SURFACE_H
#define CGAL_POWER_RTF_ENGINES_BUILD_SURFACE_H

#include <CGAL/PowerRTF/engines/oriented_topology.h>
#include <CGAL/PowerRTF/geometry/Build_surface.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/geometry/Surface_facets.h>
#include <CGAL/PowerRTF/geometry/Vertex_fan.h>
#include <CGAL/PowerRTF/geometry/component_topology.h>
#include <CGAL/PowerRTF/geometry/curve_order.h>
#include <CGAL/PowerRTF/geometry/facet_shape.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/mark_firsts.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

/// Takes a point to its place.
struct Place_point {
  const Vec3d* from;
  const int* order;
  Vec3d* points;
  int* places; ///< by point: the place

  CGAL_POWER_RTF_HD void operator()(int place) const
  {
    points[place] = from[order[place]];
    places[order[place]] = place;
  }
};

/// Renumbers a facet's vertices, the least of which is its key.
struct Renumber_facet {
  const int* places;
  int* vertices;
  std::uint64_t* keys;

  CGAL_POWER_RTF_HD void operator()(int f) const
  {
    int* const v = vertices + 3 * std::size_t(f);
    for (int k = 0; k < 3; ++k) v[k] = places[v[k]];
    const int least = v[0] < v[1] ? v[0] : v[1];
    keys[f] = std::uint64_t(least < v[2] ? least : v[2]);
  }
};

/// Counts what makes a facet need a closer look, and areas.
struct Shape_facet {
  const Vec3d* points;
  const int* vertices;
  double* areas;
  Vec3d* normals;
  Facet_angles* angles;

  CGAL_POWER_RTF_HD void operator()(int f, Totals<2, 0>& sums) const
  {
    const int* const v = vertices + 3 * std::size_t(f);
    const Facet_shape shape = facet_shape(points[v[0]], points[v[1]], points[v[2]]);
    areas[f] = shape.area;
    angles[f] = shape.angles;
    sums.add(0, shape.area);
    if (shape.angles.are_known())
      normals[f] = shape.normal;
    else
      sums.add(1, 1);
  }
};

/// Joins the facets at a vertex, whose normal it sets. Counts vertices that need a closer look, and
/// edges on the border. Two facets with the same vertices make the only disk of two.
struct Join_facets {
  const int* vertices;
  Corner_lists lists;
  const Facet_angles* angles;
  const Vec3d* facet_normals;
  int *component, *opposite; ///< `component`: label trees
  Vec3d* normals;

  CGAL_POWER_RTF_HD void operator()(int v, Totals<2, 0>& counts) const
  {
    const int n = lists.size(v);
    if (n == 0) return counts.add(0, 1);
    const int* const corners = lists[v];
    const Vertex_fan fan(vertices, v, corners, n);
    const bool is_on_border = fan.border() >= 0;
    if (!fan.is_single() || (n < 3 && !is_on_border)) return counts.add(0, 1);
    write_opposites(fan, corners, n, opposite);
    for (int k = 0; k < n; ++k) // each edge once, where there is no border
      if (fan.next(k) < v) join_trees(component, v, fan.next(k));
    normals[v] = vertex_normal(corners, corners + n, angles, facet_normals);
    counts.add(0, squared_length(normals[v]) == 0);
    counts.add(1, is_on_border);
  }
};

struct Count_components {
  const int* component;

  CGAL_POWER_RTF_HD void operator()(int v, Totals<1, 0>& count) const
  {
    count.add(0, component[v] == v);
  }
};

template <class Backend>
struct Surface_building {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Vec3d> given_points, vertex_normals;
  Buffer<int> given_vertices, vertex_order, facet_order, places;
  Buffer<int> component;
  Buffer<double> sums;
  Buffer<Facet_angles> angles;
  Buffer<std::uint64_t> keys;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices, std::size_t facets)
  {
    using A = Surface_building;
    for (auto array : {&A::given_points, &A::vertex_normals}) f(array, vertices);
    for (auto array : {&A::vertex_order, &A::places, &A::component}) f(array, vertices);
    f(&A::given_vertices, 3 * facets);
    f(&A::facet_order, facets);
    f(&A::angles, facets);
    f(&A::keys, 3 * facets);
    f(&A::sums, std::size_t(5));
  }
};

/// Sorts the points along the Hilbert curve and the facets by their least vertices.
template <class Backend>
void sort_spatially(Backend& backend, Surface_building<Backend>& a, Facet_buffers<Backend>& there)
{
  const int vertices = static_cast<int>(there.points.size()),
            facets = static_cast<int>(there.facet_areas.size());
  order_along_curve(backend, vertices, Points_themselves{a.given_points.data()},
                    a.vertex_order.data());
  backend.for_each(vertices, Place_point{a.given_points.data(), a.vertex_order.data(),
                                         there.points.data(), a.places.data()});
  backend.for_each(facets, Renumber_facet{a.places.data(), a.given_vertices.data(), a.keys.data()});
  backend.sort_order(facets, a.keys.data(), a.facet_order.data());
  backend.for_each(
      facets, Order_corners{a.given_vertices.data(), a.facet_order.data(), there.corners.data()});
}

/// The topology of a closed surface that hangs together.
inline std::shared_ptr<const Topology> one_component(int vertices, int facets)
{
  return std::make_shared<const Topology>(
      Topology{std::vector<int>(facets), {{vertices - facets / 2, 0}}});
}

/// Makes room for what is built; the density is 1.
inline void allocate_surface(Concurrency concurrency, int vertices, int facets, Surface& surface)
{
  const auto resize = [&](auto& items, std::size_t n) {
    resize_in_parallel(concurrency, items, n);
  };
  call_at_once(
      concurrency, [&] { resize(surface.facet_normals, facets); },
      [&] { resize(surface.points, vertices); }, [&] { resize(surface.vertex_normals, vertices); },
      [&] { resize(surface.triangles, facets); },
      [&] { resize(surface.adjacency.opposite, 3 * std::size_t(facets)); },
      [&] {
        resize(surface.facet_areas, facets);
        resize(surface.input_vertices, vertices);
        resize_in_parallel(concurrency, surface.vertex_density, vertices, 1.);
      });
  surface.adjacency.corners.first.resize(vertices + 1);
  surface.adjacency.corners.entries.resize(3 * std::size_t(facets));
}

} // namespace internal

/// As `Build_surface`. `there` gets the facets of the surface.
template <class Backend>
bool build_surface(Backend& backend, const std::vector<Vec3d>& points,
                   const std::vector<Triangle>& triangles, Surface& surface,
                   internal::Facet_buffers<Backend>& there)
{
  using namespace internal;
  const int vertices = static_cast<int>(points.size()), facets = static_cast<int>(triangles.size()),
            corners = 3 * facets;
  Surface_building<Backend> a;
  if (!backend.has_room(bytes_of_listed<Surface_building<Backend>>(vertices, facets) +
                        bytes_of_listed<Facet_buffers<Backend>>(vertices, facets) +
                        backend.sort_bytes(corners) + order_bytes<Backend>(points.size())))
    return false;
  allocate_listed(backend, a, std::size_t(vertices), std::size_t(facets));
  allocate_listed(backend, there, std::size_t(vertices), std::size_t(facets));
  const bool is_sorted = triangles.size() > facets_in_caches;
  backend.upload((is_sorted ? a.given_points : there.points).data(), points.data(), points.size());
  backend.upload((is_sorted ? a.given_vertices : there.corners).data(), triangles.data()->data(),
                 3 * triangles.size());
  if (is_sorted) sort_spatially(backend, a, there);

  double* const sums = a.sums.data();
  backend.template reduce<2, 0>(facets,
                                Shape_facet{there.points.data(), there.corners.data(),
                                            there.facet_areas.data(), there.facet_normals.data(),
                                            a.angles.data()},
                                Keep_totals{sums});
  backend.for_each(corners, Set_key{there.corners.data(), a.keys.data()});
  backend.sort_order(corners, a.keys.data(), there.vertex_corners.data());
  backend.for_each(corners + 1, Mark_firsts{there.corners.data(), there.vertex_corners.data(),
                                            corners, vertices, there.first_corner.data()});
  backend.for_each(vertices, Set_to_own_number{a.component.data()});
  const Corner_lists lists{there.first_corner.data(), nullptr, there.vertex_corners.data()};
  backend.template reduce<2, 0>(vertices,
                                Join_facets{there.corners.data(), lists, a.angles.data(),
                                            there.facet_normals.data(), a.component.data(),
                                            there.opposite.data(), a.vertex_normals.data()},
                                Keep_totals{sums + 2});
  backend.template reduce<1, 0>(vertices, Count_components{a.component.data()},
                                Keep_totals{sums + 4});
  Surface result; // its memory comes while the backend works
  allocate_surface(Backend::concurrency(), vertices, facets, result);
  double found[5]; // area, defects of facets and of vertices, border edges, components
  backend.download(found, sums, 5);
  if (found[1] > 0 || found[2] > 0) return false;
  result.area = found[0];
  result.adjacency.border_edges = static_cast<std::size_t>(found[3]);
  if (found[3] == 0 && found[4] == 1) result.topology.value = one_component(vertices, facets);
  const auto take = [&](auto* to, const auto& from) {
    backend.download(to, from.data(), from.size());
  };
  take(result.points.data(), there.points);
  take(result.triangles.data()->data(), there.corners);
  take(result.facet_normals.data(), there.facet_normals);
  take(result.facet_areas.data(), there.facet_areas);
  take(result.vertex_normals.data(), a.vertex_normals);
  take(result.adjacency.opposite.data(), there.opposite);
  take(result.adjacency.corners.first.data(), there.first_corner);
  take(result.adjacency.corners.entries.data(), there.vertex_corners);
  if (is_sorted)
    take(result.input_vertices.data(), a.vertex_order);
  else
    std::iota(result.input_vertices.begin(), result.input_vertices.end(), 0);
  surface = std::move(result);
  return true;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_BUILD_SURFACE_H
