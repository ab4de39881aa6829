// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The two-sided distance between an engine's surface and a mesh, where a backend works, in double
// precision: it judges results. Trees, samples and sums are those of `surface_distance()`; on a GPU
// numbers differ by rounding, which may also take a sample to the facet next to its own.
#ifndef CGAL_POWER_RTF_ENGINES_SURFACE_DISTANCES_H
#define CGAL_POWER_RTF_ENGINES_SURFACE_DISTANCES_H

#include <CGAL/PowerRTF/geometry/Area_samples.h>
#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface_facets.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/geometry/placed_facets.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/scan.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// Of the corners of placed facets.
struct Listed_vertices {
  const int* corners;
  CGAL_POWER_RTF_HD int operator()(int corner) const { return corners[corner]; }
};

struct Flag_first_corners {
  First_corners<Listed_vertices> corners;
  unsigned char* is_first;

  CGAL_POWER_RTF_HD void operator()(int corner) const { is_first[corner] = corners.has(corner); }
};

/// The samples, then the vertices.
struct Place_points {
  Area_samples samples;
  const Vec3d* vertices;
  const int* corners;
  const int* first_corners;
  Vec3d* points;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    points[i] = i < samples.n ? samples(i) : vertices[corners[first_corners[i - samples.n]]];
  }
};

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

/// For a backend's `reduce_twice()`: sums over the samples and the largest of all; then the first
/// that is as large.
struct Distance_totals_rule {
  using First = Totals<2, 1>;
  using Second = Totals<0, 1>;

  const double* squared_distances;
  const Vec3d* points;
  int samples;
  Sampled_distances* result;

  CGAL_POWER_RTF_HD void add_first(int i, First& t) const
  {
    const double squared = squared_distances[i];
    t.raise(0, squared);
    if (i >= samples) return;
    t.add(0, std::sqrt(squared));
    t.add(1, squared);
  }
  CGAL_POWER_RTF_HD Sampled_distances middle(const First& t) const
  {
    return {t.sum(0), t.sum(1), t.maximum(0), {0, 0, 0}};
  }
  CGAL_POWER_RTF_HD void add_second(int i, const Sampled_distances& d, Second& t) const
  {
    if (squared_distances[i] == d.max_squared) t.raise(0, -i);
  }
  CGAL_POWER_RTF_HD void finish(Sampled_distances& d, const Second& t) const
  {
    if (d.max_squared > 0) d.farthest = points[static_cast<int>(-t.maximum(0))];
    *result = d;
  }
};

/// What the points of one surface take.
template <class Backend>
struct Sampled_distance_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<double> areas, sums, squared_distances;
  Buffer<int> first, first_corners;
  Buffer<unsigned char> is_first;
  Buffer<Vec3d> points;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices, std::size_t faces, std::size_t samples)
  {
    using A = Sampled_distance_arrays;
    f(&A::areas, faces + 1);
    f(&A::sums, scan_sums(static_cast<int>(faces) + 1));
    f(&A::first, vertices);
    f(&A::first_corners, 3 * faces);
    f(&A::is_first, 3 * faces);
    f(&A::points, samples + vertices);
    f(&A::squared_distances, samples + vertices);
  }
};

/// Places samples of `from` into `a.points`, then its `vertices` as far as they are used.
/// \returns the number of all
template <class Backend>
int place_points(Backend& backend, const Surface_view<double>& from, int vertices,
                 const Vec3d* points, int samples, Sampled_distance_arrays<Backend>& a)
{
  const int facets = from.facet_tree.items, corners = 3 * facets;
  allocate_listed(backend, a, std::size_t(vertices), std::size_t(facets), std::size_t(samples));
  backend.for_each(facets + 1, Facet_areas{from.facets, facets, a.areas.data()});
  exclusive_scan(backend, facets + 1, a.areas.data(), a.sums.data());
  const First_corners<Listed_vertices> first{{from.facet_vertices}, a.first.data()};
  backend.fill(a.first.data(), corners, std::size_t(vertices));
  backend.for_each(corners, first);
  backend.for_each(corners, Flag_first_corners{first, a.is_first.data()});
  const int n = samples + backend.select(corners, a.is_first.data(), a.first_corners.data());
  backend.for_each(n, Place_points{{from.facets, a.areas.data(), facets, samples},
                                   points,
                                   from.facet_vertices,
                                   a.first_corners.data(),
                                   a.points.data()});
  return n;
}

/// Those of the first n of `a.points` to a surface; `samples`: how many of them come first.
template <class Backend>
void find_sampled_distances(Backend& backend, Sampled_distance_arrays<Backend>& a, int n,
                            int samples, const Surface_view<double>& to, Sampled_distances* result)
{
  backend.for_each_by_lanes(n,
                            Facet_distance_rule{to, a.points.data(), a.squared_distances.data()});
  backend.reduce_twice(
      n, Distance_totals_rule{a.squared_distances.data(), a.points.data(), samples, result});
}

/// As `Resident_mesh::find_distances()`, of a mesh that is where the backend works: `false` where
/// the memory does not suffice. `surface`, `there`: the surface there, and its facets by their
/// places in a tree.
template <class Backend>
bool surface_distances(Backend& backend, const Surface_facets& surface,
                       const Surface_view<double>& there, const Mesh_arrays& mesh, int samples,
                       Two_sided_distances& result)
{
  using Points = Sampled_distance_arrays<Backend>;
  using Tree = Mesh_tree_arrays<Backend>;
  const auto points_bytes = [&](int vertices, int facets) {
    return bytes_of_listed<Points>(std::size_t(vertices), std::size_t(facets),
                                   std::size_t(samples));
  };
  const Packed_tree_layout layout(mesh.faces);
  if (!backend.has_room(Tree::bytes(layout) + points_bytes(surface.vertices, surface.facets) +
                        points_bytes(mesh.vertices, mesh.faces)))
    return false;
  Tree tree;
  typename Backend::template Buffer<Two_sided_distances> found;
  found.allocate(backend, 1);
  Surface_view<double> a = there;
  a.patches = nullptr;
  const Surface_view<double> b = placed_mesh(backend, mesh, tree);
  Points from_surface, from_mesh;
  const int n_surface =
                place_points(backend, a, surface.vertices, surface.points, samples, from_surface),
            n_mesh = place_points(backend, b, mesh.vertices, mesh.points, samples, from_mesh);
  find_sampled_distances(backend, from_surface, n_surface, samples, b, &found.data()->from_surface);
  find_sampled_distances(backend, from_mesh, n_mesh, samples, a, &found.data()->from_mesh);
  backend.download(&result, found.data(), 1);
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_SURFACE_DISTANCES_H
