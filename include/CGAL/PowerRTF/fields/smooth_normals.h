// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex normals at the scale of the samples. A cell stands for the surface over a width of h; with
// normals that turn faster than that its tangent plane wobbles as the sample moves, and the
// optimization stalls in bad places. (An addition to the paper, whose means over the nearest
// vertices do the same at the scale of the input's edges.)
#ifndef CGAL_POWER_RTF_FIELDS_SMOOTH_NORMALS_H
#define CGAL_POWER_RTF_FIELDS_SMOOTH_NORMALS_H

#include <CGAL/PowerRTF/fields/diffusion.h>
#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// Smooths `surface.vertex_normals` by a diffusion of standard deviation `width` times the local
/// spacing h_v = sqrt(integral(rho) / (n rho_v)) of `n` samples. Edges longer than that are hardly
/// smoothed over, and where the edges are shorter than a quarter of it, less is smoothed.
inline void smooth_normals(Surface& surface, std::size_t n, double width,
                           internal::Concurrency concurrency = Sequential_tag())
{
  if (!(width > 0)) return;
  constexpr double longest = 32;
  constexpr int steps = 4;
  const Surface_edges edges = surface_edges(surface, concurrency);
  const double variance = diffusion_variance(surface, n, width, concurrency);
  const std::vector<double> times = diffusion_times(
      edges, [&](int v) { return variance / surface.vertex_density[v]; }, longest, concurrency);
  std::vector<Vec3d>& normals = surface.vertex_normals;
  internal::Unset_vector<Vec3d> before(normals.size());
  internal::for_each_index(concurrency, static_cast<int>(normals.size()),
                           [&](int v) { before[v] = normals[v]; });
  // Vectors that are not made unit ones again and again cancel, and point anywhere.
  diffuse(edges, times, steps, normals, concurrency, [&](int v, const Vec3d& mean) {
    return squared_length(mean) > 0 ? normalized(mean) : before[v];
  });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_SMOOTH_NORMALS_H
