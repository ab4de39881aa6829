// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points and facets of a surface as plain arrays, on the host or where a backend works. On a
// GPU they stay from where the surface is made to the last look at a mesh: they go up once.
#ifndef CGAL_POWER_RTF_GEOMETRY_SURFACE_FACETS_H
#define CGAL_POWER_RTF_GEOMETRY_SURFACE_FACETS_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>

namespace CGAL::PowerRTF {

/// Non-owning.
struct Surface_facets {
  int vertices = 0, facets = 0;
  const Vec3d* points = nullptr;       ///< of the vertices
  const int* corners = nullptr;        ///< three vertices per facet
  const int* opposite = nullptr;       ///< as in `Facet_adjacency`
  const int* first_corner = nullptr;   ///< of each vertex, and the end
  const int* vertex_corners = nullptr; ///< `Facet_adjacency::corners`
  const Vec3d* facet_normals = nullptr;
  const double* facet_areas = nullptr;

  Surface_facets() = default;
  Surface_facets(const Surface& surface)
      : vertices(static_cast<int>(surface.points.size())),
        facets(static_cast<int>(surface.triangles.size())), points(surface.points.data()),
        corners(surface.triangles.data()->data()), opposite(surface.adjacency.opposite.data()),
        first_corner(surface.adjacency.corners.first.data()),
        vertex_corners(surface.adjacency.corners.entries.data()),
        facet_normals(surface.facet_normals.data()), facet_areas(surface.facet_areas.data())
  {}
};

/// The same where a GPU has them. Several threads may read them at once.
struct Resident_surface {
  Surface_facets facets;
  int device = 0;
  std::size_t bytes = 0; ///< of the device's memory

  virtual ~Resident_surface() = default;
};

namespace internal {

/// The arrays behind `Surface_facets` where a backend works.
template <class Backend>
struct Facet_buffers {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Vec3d> points, facet_normals;
  Buffer<int> corners, opposite, first_corner, vertex_corners;
  Buffer<double> facet_areas;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices, std::size_t facets)
  {
    using B = Facet_buffers;
    f(&B::points, vertices);
    f(&B::first_corner, vertices + 1);
    for (auto array : {&B::corners, &B::opposite, &B::vertex_corners}) f(array, 3 * facets);
    f(&B::facet_normals, facets);
    f(&B::facet_areas, facets);
  }

  Surface_facets view() const
  {
    Surface_facets there;
    there.vertices = static_cast<int>(points.size());
    there.facets = static_cast<int>(facet_areas.size());
    there.points = points.data();
    there.corners = corners.data();
    there.opposite = opposite.data();
    there.first_corner = first_corner.data();
    there.vertex_corners = vertex_corners.data();
    there.facet_normals = facet_normals.data();
    there.facet_areas = facet_areas.data();
    return there;
  }

  /// `facets`: the host's.
  Surface_facets upload(Backend& backend, const Surface_facets& facets)
  {
    allocate_listed(backend, *this, std::size_t(facets.vertices), std::size_t(facets.facets));
    uploaded(backend, points, facets.points);
    uploaded(backend, corners, facets.corners);
    uploaded(backend, opposite, facets.opposite);
    uploaded(backend, first_corner, facets.first_corner);
    uploaded(backend, vertex_corners, facets.vertex_corners);
    uploaded(backend, facet_normals, facets.facet_normals);
    uploaded(backend, facet_areas, facets.facet_areas);
    return view();
  }
};

/// Whether a backend has the facets of a surface, without uploading them.
template <class Backend>
bool are_facets_there(const Backend& backend, const Resident_surface* resident)
{
  if constexpr (Backend::is_host)
    return true;
  else
    return resident && backend.has(*resident);
}

/// What `facets_there()` takes.
template <class Backend>
std::size_t bytes_of_facets(const Backend& backend, const Surface_facets& facets,
                            const Resident_surface* resident)
{
  return are_facets_there(backend, resident)
             ? 0
             : bytes_of_listed<Facet_buffers<Backend>>(std::size_t(facets.vertices),
                                                       std::size_t(facets.facets));
}

/// The facets of a surface where a backend works. `facets`: the host's; `resident`: where a GPU has
/// them, or null; `own`: gets them where this backend has them not.
template <class Backend>
Surface_facets facets_there(Backend& backend, const Surface_facets& facets,
                            const Resident_surface* resident, Facet_buffers<Backend>& own)
{
  if constexpr (Backend::is_host)
    return facets;
  else
    return are_facets_there(backend, resident) ? resident->facets : own.upload(backend, facets);
}

} // namespace internal
} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SURFACE_FACETS_H
