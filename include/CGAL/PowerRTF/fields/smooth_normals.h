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
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL::PowerRTF {

/// Smooths `surface.vertex_normals` by a diffusion of standard deviation `width` times the local
/// spacing h_v = sqrt(integral(rho) / (n rho_v)) of `n` samples. Edges longer than that are hardly
/// smoothed over. At most 64 passes are made: very fine input is smoothed less.
inline void smooth_normals(Surface& surface, std::size_t n, double width,
                           internal::Concurrency concurrency = Sequential_tag())
{
  if (!(width > 0)) return;
  constexpr int max_passes = 64;
  const Surface_edges edges = surface_edges(surface, concurrency);
  const int size = static_cast<int>(surface.points.size());
  const std::vector<double> wanted =
      diffusion_times(surface, edges, n, width, concurrency); // sums of blends
  const double largest = wanted.empty() ? 0 : *std::max_element(wanted.begin(), wanted.end());
  constexpr double largest_blend = 0.5; // more than that oscillates
  const int passes =
      static_cast<int>(std::min<double>(max_passes, std::ceil(largest / largest_blend)));
  std::vector<Vec3d> smooth(size);
  for (int pass = 0; pass < passes; ++pass) {
    internal::for_each_index(concurrency, size, [&](int v) {
      const double blend = std::min(largest_blend, wanted[v] / passes);
      Vec3d sum{0, 0, 0};
      for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
        sum += surface.vertex_normals[edges.neighbor[e]];
      const int degree = edges.first[v + 1] - edges.first[v];
      const Vec3d mean = (1 - blend) * surface.vertex_normals[v] + (blend / degree) * sum;
      smooth[v] = squared_length(mean) > 0 ? normalized(mean) : surface.vertex_normals[v];
    });
    surface.vertex_normals.swap(smooth);
  }
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_SMOOTH_NORMALS_H
