// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stars of a mesh, made where a backend works and has the mesh: those of `flat_stars()`.
#ifndef CGAL_POWER_RTF_ENGINES_STARS_OF_MESH_H
#define CGAL_POWER_RTF_ENGINES_STARS_OF_MESH_H

#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/halfedge_numbers.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/scan.h>
#include <CGAL/PowerRTF/smoothing/Star_arrays.h>
#include <CGAL/PowerRTF/smoothing/Star_view.h>

#include <cstddef>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// The edges to the neighbors of vertices that may move.
struct Spokes_of_mesh {
  const int* corners;
  const int *opposite, *last_corner; ///< as of `Triangle_links`
  const unsigned char* kinds;

  /// Calls `f(neighbor)` for those of a vertex, all the way around.
  template <class F>
  CGAL_POWER_RTF_HD void for_each(int v, const F& f) const
  {
    if (!(kinds[v] & is_movable_kind)) return;
    int h = last_corner[v];
    do {
      f(corners[previous_halfedge(h)]);
      h = next_halfedge(opposite[h]);
    } while (h != last_corner[v]);
  }
};

/// For all vertices, and the end.
struct Count_spokes_of_mesh {
  Spokes_of_mesh spokes;
  int vertices;
  int* counts;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    int count = 0;
    if (v < vertices) spokes.for_each(v, [&](int) { ++count; });
    counts[v] = count;
  }
};

struct Write_spokes_of_mesh {
  Spokes_of_mesh spokes;
  const int* first;
  int* neighbors;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    int at = first[v];
    spokes.for_each(v, [&](int neighbor) { neighbors[at++] = neighbor; });
  }
};

struct Copy_points {
  const Vec3d* from;
  Vec3d* to;
  CGAL_POWER_RTF_HD void operator()(int v) const { to[v] = from[v]; }
};

template <class Backend>
struct Spoke_counts {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> first, sums;
  Buffer<unsigned char> kinds;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices)
  {
    f(&Spoke_counts::first, vertices + 1);
    f(&Spoke_counts::sums, scan_sums(static_cast<int>(vertices + 1)));
    f(&Spoke_counts::kinds, vertices);
  }
};

/// `mesh`, `opposite`, `last_corner`: where the backend works. `vertices`: the host's. \returns
/// `false` where the memory does not suffice
template <class Backend>
bool make_stars(Backend& backend, const Mesh_arrays& mesh, const int* opposite,
                const int* last_corner, const Vertex_places& vertices, Star_arrays<Backend>& stars)
{
  const int n = mesh.vertices;
  // No vertex has more spokes than corners.
  if (!backend.has_room(bytes_of_listed<Spoke_counts<Backend>>(std::size_t(n)) +
                        Star_arrays<Backend>::bytes(std::size_t(n), 3 * std::size_t(mesh.faces))))
    return false;
  Spoke_counts<Backend> counts;
  allocate_listed(backend, counts, std::size_t(n));
  const Spokes_of_mesh spokes{mesh.corners, opposite, last_corner,
                              uploaded(backend, counts.kinds, vertices.kinds)};
  backend.for_each(n + 1, Count_spokes_of_mesh{spokes, n, counts.first.data()});
  exclusive_scan(backend, n + 1, counts.first.data(), counts.sums.data());
  int size;
  backend.download(&size, counts.first.data() + n, 1);
  allocate_listed(backend, stars, std::size_t(n), std::size_t(size));
  std::swap(stars.first, counts.first);
  std::swap(stars.kinds, counts.kinds); // which `spokes` looks at
  backend.for_each(n, Write_spokes_of_mesh{spokes, stars.first.data(), stars.neighbors.data()});
  backend.for_each(n, Copy_points{mesh.points, stars.points.data()});
  uploaded(backend, stars.normals, vertices.normals);
  uploaded(backend, stars.facets, vertices.facets);
  backend.fill(stars.heights.data(), 0., std::size_t(n));
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_STARS_OF_MESH_H
