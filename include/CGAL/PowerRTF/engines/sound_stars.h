// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which cells have sound triangles, found where a backend works: nearly all, so that few are left
// to be looked at closely.
#ifndef CGAL_POWER_RTF_ENGINES_SOUND_STARS_H
#define CGAL_POWER_RTF_ENGINES_SOUND_STARS_H

#include <CGAL/PowerRTF/cells/Find_sound_stars.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

struct Judge_star {
  Surface_facets surface;
  Cell_triangles triangles;
  unsigned char* is_sound;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    is_sound[i] = is_agreed(i) && triangles.are_distinct(i) && lies_well(i);
  }

private:
  CGAL_POWER_RTF_HD bool is_agreed(int i) const
  {
    for (int k = 0; k < triangles.size(i); ++k)
      if (triangles.from(i, k) >= triangles.cells || !triangles.is_agreed(i, k)) return false;
    return true;
  }

  CGAL_POWER_RTF_HD bool lies_well(int i) const
  {
    return triangles.lies_well(
        i,
        [&](const auto& f) {
          for (int k = 0; k < triangles.size(i); ++k) f(triangles.from(i, k), triangles.to(i, k));
        },
        [&](int w) { return triangles.are_neighbors(surface, i, w); });
  }
};

template <class Backend>
struct Sound_star_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> neighbors, facets;
  Buffer<std::size_t> first;
  Buffer<Vec3d> points, normals;
  Buffer<unsigned char> is_sound;

  /// See listed_arrays.h. `neighbors`: of all cells.
  template <class F>
  static void for_each_array(F&& f, std::size_t cells, std::size_t samples, std::size_t neighbors)
  {
    using A = Sound_star_arrays;
    f(&A::first, cells + 1);
    f(&A::neighbors, neighbors);
    for (auto array : {&A::points, &A::normals}) f(array, samples);
    f(&A::facets, samples);
    f(&A::is_sound, cells);
  }
};

/// As `Find_sound_stars`: `false` where the memory does not suffice.
template <class Backend>
bool find_sound_stars(Backend& backend, const Surface& surface, Cell_triangles triangles,
                      unsigned char* is_sound)
{
  using Arrays = Sound_star_arrays<Backend>;
  const std::size_t cells = triangles.cells, samples = triangles.samples,
                    neighbors = triangles.first[cells];
  const Resident_surface* const resident = surface.resident.value.get();
  if (!backend.has_room(bytes_of_listed<Arrays>(cells, samples, neighbors) +
                        bytes_of_facets(backend, surface, resident)))
    return false;
  Arrays a;
  Facet_buffers<Backend> of_surface;
  allocate_listed(backend, a, cells, samples, neighbors);
  triangles.first = uploaded(backend, a.first, triangles.first);
  triangles.neighbors = uploaded(backend, a.neighbors, triangles.neighbors);
  triangles.points = uploaded(backend, a.points, triangles.points);
  triangles.normals = uploaded(backend, a.normals, triangles.normals);
  triangles.facets = uploaded(backend, a.facets, triangles.facets);
  backend.for_each(static_cast<int>(cells),
                   Judge_star{facets_there(backend, surface, resident, of_surface), triangles,
                              a.is_sound.data()});
  backend.download(is_sound, a.is_sound.data(), cells);
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_SOUND_STARS_H
