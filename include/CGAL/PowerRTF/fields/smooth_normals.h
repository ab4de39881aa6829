// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertex normals at the scale of the samples. A cell stands for the surface over a width of h; with
// normals that turn faster than that its tangent plane wobbles as the sample moves, and the
// optimization stalls in bad places. (An addition to the paper, whose means over the nearest
// vertices do the same at the scale of the input's edges.)
#ifndef CGAL_POWER_RTF_FIELDS_SMOOTH_NORMALS_H
#define CGAL_POWER_RTF_FIELDS_SMOOTH_NORMALS_H

#include <CGAL/PowerRTF/fields/Diffuse_normals.h>
#include <CGAL/PowerRTF/fields/diffusion.h>
#include <CGAL/PowerRTF/fields/normal_diffusion.h>
#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// Smooths `surface.vertex_normals` by a diffusion of standard deviation `width` times the local
/// spacing h_v = sqrt(integral(rho) / (n rho_v)) of `n` samples. Edges longer than that are hardly
/// smoothed over, and where the edges are shorter than a quarter of it, less is smoothed.
/// `diffuse_there`: what does that instead, where it does.
inline void smooth_normals(Surface& surface, std::size_t n, double width,
                           internal::Concurrency concurrency = Sequential_tag(),
                           const Diffuse_normals& diffuse_there = {})
{
  if (!(width > 0) || surface.points.empty()) return;
  using Diffusion = internal::Normal_diffusion;
  std::vector<Vec3d>& normals = surface.vertex_normals;
  const double variance = diffusion_variance(surface, n, width, concurrency);
  if (diffuse_there && diffuse_there(surface, variance, normals.data())) return;
  const Surface_edges edges = surface_edges(surface, concurrency);
  const std::vector<double> times = diffusion_times(
      edges, [&](int v) { return variance / surface.vertex_density[v]; }, Diffusion::longest,
      concurrency);
  const std::vector<Vec3d> original = normals;
  diffuse(edges, times, Diffusion::steps, normals, concurrency,
          internal::Keep_direction{original.data()});
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_SMOOTH_NORMALS_H
