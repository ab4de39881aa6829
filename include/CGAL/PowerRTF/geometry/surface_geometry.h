// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals and areas of a surface. Vertex normals are weighted by the facets' angles (Thuermer and
// Wuethrich 1998), so they do not depend on how the surface is cut into triangles.
#ifndef CGAL_POWER_RTF_GEOMETRY_SURFACE_GEOMETRY_H
#define CGAL_POWER_RTF_GEOMETRY_SURFACE_GEOMETRY_H

#include <CGAL/PowerRTF/geometry/degenerate_facets.h>
#include <CGAL/PowerRTF/geometry/facet_shape.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

/// Gives vertices whose facets' normals cancel (the rim of a folded sheet) the normal of their
/// largest facet.
inline void mend_vertex_normals(Surface& surface, Concurrency concurrency)
{
  const int vertices = static_cast<int>(surface.points.size());
  const auto is_short = [&](int v) { return squared_length(surface.vertex_normals[v]) < 0.5; };
  if (!select(concurrency, vertices, is_short).empty()) {
    std::vector<double> largest(vertices, 0);
    for (std::size_t f = 0; f < surface.triangles.size(); ++f)
      for (const int v : surface.triangles[f])
        if (surface.facet_areas[f] > largest[v] && is_short(v)) {
          largest[v] = surface.facet_areas[f];
          surface.vertex_normals[v] = 0.5 * surface.facet_normals[f]; // 0.5: still to be replaced
        }
  }
  for_each_index(concurrency, vertices, [&](int v) {
    Vec3d& n = surface.vertex_normals[v];
    n = normalized(n);
    if (squared_length(n) == 0) n = {0, 0, 1}; // all its facets are degenerate
  });
}

/// Where a half goes on smoothly as its mirror image, its normals are along the plane.
inline void level_mirror_normals(Surface& surface)
{
  constexpr double smooth = 0.34; // sine of 20 degrees: twice that is a crease by default
  const Mirror_plane& mirror = *surface.mirror;
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    Vec3d& n = surface.vertex_normals[v];
    if (mirror.has(surface.points[v]) &&
        std::abs(Mirror_plane::coordinate(n, mirror.axis)) < smooth)
      n = normalized(mirror.along(n));
  }
}

} // namespace internal

/// Sets `facet_normals`, `facet_areas`, `area` and `vertex_normals` from points and triangles.
/// Facets without a direction of their own (\ref is_degenerate) count in no vertex normal and get
/// the mean normal of their vertices. All normals are of length 1. What a GPU has of the surface is
/// forgotten.
inline void compute_geometry(Surface& surface, internal::Concurrency concurrency = Sequential_tag())
{
  const int facets = static_cast<int>(surface.triangles.size());
  const int vertices = static_cast<int>(surface.points.size());
  surface.resident = {};
  const auto resize = [&](auto& items, int n) {
    internal::resize_in_parallel(concurrency, items, n);
  };
  internal::call_at_once(
      concurrency, [&] { resize(surface.facet_normals, facets); },
      [&] { resize(surface.facet_areas, facets); },
      [&] { resize(surface.vertex_normals, vertices); });

  internal::Unset_vector<internal::Facet_angles> angles(facets);
  surface.area = internal::reduce(
      concurrency, facets, 0.,
      [&](double& area, int f) {
        const Triangle& t = surface.triangles[f];
        const internal::Facet_shape shape =
            internal::facet_shape(surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]);
        area += surface.facet_areas[f] = shape.area;
        angles[f] = shape.angles;
        if (angles[f].are_known()) surface.facet_normals[f] = shape.normal;
      },
      [](double& area, double part) { area += part; });

  const internal::Buckets<int>& corners = surface.adjacency.corners;
  const std::vector<int> cancelled = internal::select(concurrency, vertices, [&](int v) {
    const int* const entries = corners.entries.data();
    Vec3d& normal = surface.vertex_normals[v];
    normal = internal::vertex_normal(entries + corners.first[v], entries + corners.first[v + 1],
                                     angles.data(), surface.facet_normals.data());
    return squared_length(normal) == 0;
  });
  if (!cancelled.empty()) internal::mend_vertex_normals(surface, concurrency);
  if (surface.mirror) internal::level_mirror_normals(surface);
  internal::for_each_index(concurrency, facets, [&](int f) {
    if (angles[f].are_known()) return;
    const Triangle& t = surface.triangles[f];
    const auto& n = surface.vertex_normals;
    const Vec3d mean = normalized(n[t[0]] + n[t[1]] + n[t[2]]);
    surface.facet_normals[f] = squared_length(mean) > 0 ? mean : n[t[0]];
  });
}

/// The barycentric combination of the vertices' normals of facet `f`, of length 1.
inline Vec3d interpolated_normal(const Surface& surface, int f,
                                 const std::array<double, 3>& weights)
{
  const Triangle& t = surface.triangles[f];
  const auto& n = surface.vertex_normals;
  const Vec3d mean = weights[0] * n[t[0]] + weights[1] * n[t[1]] + weights[2] * n[t[2]];
  return squared_length(mean) > 1e-6 ? normalized(mean) : surface.facet_normals[f];
}

/// The barycentric combination of the vertices' densities of facet `f`.
inline double interpolated_density(const Surface& surface, int f,
                                   const std::array<double, 3>& weights)
{
  const Triangle& t = surface.triangles[f];
  const auto& rho = surface.vertex_density;
  return weights[0] * rho[t[0]] + weights[1] * rho[t[1]] + weights[2] * rho[t[2]];
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SURFACE_GEOMETRY_H
