// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Limits how fast the spacing of the samples grows over the surface (mesh gradation control,
// Borouchaki, Hecht and Frey 1998).
#ifndef CGAL_POWER_RTF_FIELDS_GRADATION_H
#define CGAL_POWER_RTF_FIELDS_GRADATION_H

#include <CGAL/PowerRTF/geometry/surface_edges.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// The integral of the vertex density over the surface (linear on every facet).
inline double density_integral(const Surface& surface)
{
  double sum = 0;
  const auto& rho = surface.vertex_density;
  for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
    const Triangle& t = surface.triangles[f];
    sum += surface.facet_areas[f] * (rho[t[0]] + rho[t[1]] + rho[t[2]]) / 3;
  }
  return sum;
}

/// C of `h = C rho^(-1/2)`, the spacing of `n` samples in hexagonal arrangement where the density
/// is rho.
inline double spacing_constant(const Surface& surface, std::size_t n)
{
  return std::sqrt(2 / std::sqrt(3.) * density_integral(surface) / static_cast<double>(n));
}

/// Lowers `h` to the largest function below it with `h_v <= h_u + gradation |uv|` on every edge
/// (Dijkstra's algorithm from all vertices at once).
inline void limit_growth(const Surface_edges& edges, double gradation, std::vector<double>& h)
{
  using Entry = std::pair<double, int>; // spacing, vertex
  std::vector<Entry> start;             // only vertices that bound a neighbor
  for (std::size_t v = 0; v < h.size(); ++v)
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
      if (h[v] + gradation * edges.length[e] < h[edges.neighbor[e]]) {
        start.emplace_back(h[v], static_cast<int>(v));
        break;
      }
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue({}, std::move(start));
  while (!queue.empty()) {
    const auto [spacing, v] = queue.top();
    queue.pop();
    if (spacing > h[v]) continue;
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e) {
      const double bound = spacing + gradation * edges.length[e];
      const int u = edges.neighbor[e];
      if (bound >= h[u]) continue;
      h[u] = bound;
      queue.emplace(bound, u);
    }
  }
}

/// Raises `surface.vertex_density` where needed so that the spacing of `n` samples grows by at most
/// `gradation` per unit of length. Raising the density makes all spacings larger, so the limit is
/// applied 4 times.
inline void limit_gradation(Surface& surface, const Surface_edges& edges, double gradation,
                            std::size_t n)
{
  constexpr int passes = 4;
  std::vector<double> h(surface.points.size());
  for (int pass = 0; pass < passes; ++pass) {
    const double C = spacing_constant(surface, n);
    for (std::size_t v = 0; v < h.size(); ++v) h[v] = C / std::sqrt(surface.vertex_density[v]);
    limit_growth(edges, gradation, h);
    for (std::size_t v = 0; v < h.size(); ++v) surface.vertex_density[v] = C * C / (h[v] * h[v]);
  }
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_GRADATION_H
