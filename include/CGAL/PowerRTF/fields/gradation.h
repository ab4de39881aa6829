// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Limits how fast the spacing of the samples grows over the surface (mesh gradation control,
// Borouchaki, Hecht and Frey 1998).
#ifndef CGAL_POWER_RTF_FIELDS_GRADATION_H
#define CGAL_POWER_RTF_FIELDS_GRADATION_H

#include <CGAL/PowerRTF/fields/Vertex_clusters.h>
#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF {

/// Whether the density is the same at all vertices.
inline bool has_uniform_density(const Surface& surface)
{
  const std::vector<double>& rho = surface.vertex_density;
  return std::all_of(rho.begin(), rho.end(), [&rho](double r) { return r == rho.front(); });
}

/// The integral of the vertex density over the surface (linear on every facet).
inline double density_integral(const Surface& surface,
                               internal::Concurrency concurrency = Sequential_tag())
{
  const auto& rho = surface.vertex_density;
  return internal::reduce(
      concurrency, static_cast<int>(surface.triangles.size()), 0.,
      [&](double& sum, int f) {
        const Triangle& t = surface.triangles[f];
        sum += surface.facet_areas[f] * (rho[t[0]] + rho[t[1]] + rho[t[2]]) / 3;
      },
      [](double& sum, double part) { sum += part; });
}

/// C of `h = C rho^(-1/2)`, the spacing of `n` samples in hexagonal arrangement where the density
/// is rho.
inline double spacing_constant(const Surface& surface, std::size_t n,
                               internal::Concurrency concurrency = Sequential_tag())
{
  return std::sqrt(2 / std::sqrt(3.) * density_integral(surface, concurrency) /
                   static_cast<double>(n));
}

/// Lowers `h`, all above 0, to the largest function below it with `h_v <= h_u + gradation |uv|` on
/// every edge. In whatever order neighbors lower each other, the end is the same; small values
/// first, a band of them at a time, takes few steps. (Meyer and Sanders, "Delta-stepping: a
/// parallelizable shortest path algorithm", 2003.)
inline void limit_growth(const Surface_edges& edges, double gradation, std::vector<double>& h,
                         internal::Concurrency concurrency = Sequential_tag())
{
  constexpr double edges_per_band = 16;
  constexpr int chunk = 256;
  const auto bound = [&](int v, int e) { return atomic_load(&h[v]) + gradation * edges.length[e]; };
  std::vector<int> waiting = internal::select(concurrency, static_cast<int>(h.size()), [&](int v) {
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
      if (bound(v, e) < h[edges.neighbor[e]]) return true;
    return false;
  });
  if (waiting.empty()) return;
  const double sum = internal::reduce(
      concurrency, static_cast<int>(edges.length.size()), 0.,
      [&](double& part, int e) { part += edges.length[e]; },
      [](double& all, double part) { all += part; });
  const double band = edges_per_band * gradation * sum / static_cast<double>(edges.length.size());
  std::vector<int> last_round(h.size(), -1), active; // the round in which a vertex was lowered
  for (int round = 0; !waiting.empty(); ++round) {
    const int size = static_cast<int>(waiting.size());
    const double limit =
        band + internal::reduce(
                   concurrency, size, h[waiting[0]],
                   [&](double& least, int k) { least = (std::min)(least, h[waiting[k]]); },
                   [](double& least, double part) { least = (std::min)(least, part); });
    const auto is_near = [&](int v) { return h[v] <= limit; };
    const auto where = [&](bool near) {
      std::vector<int> some =
          internal::select(concurrency, size, [&](int k) { return is_near(waiting[k]) == near; });
      for (int& k : some) k = waiting[k];
      return some;
    };
    active = where(true);
    waiting = where(false);
    for (; !active.empty(); ++round) {
      const int size = static_cast<int>(active.size());
      std::vector<std::vector<int>> lowered((size + chunk - 1) / chunk);
      internal::for_each_chunk(concurrency, size, chunk, [&](int begin, int end) {
        for (int i = begin; i < end; ++i)
          for (int e = edges.first[active[i]]; e < edges.first[active[i] + 1]; ++e) {
            const int u = edges.neighbor[e];
            if (atomic_min(&h[u], bound(active[i], e)) &&
                atomic_exchange(&last_round[u], round) != round)
              lowered[begin / chunk].push_back(u);
          }
      });
      active.clear();
      for (const auto& part : lowered)
        for (const int v : part) (is_near(v) ? active : waiting).push_back(v);
    }
  }
}

/// What `limit_growth()` makes of `h`, but for a little, by way of `clusters`.
inline void estimate_limited_growth(const Surface& surface, const Vertex_clusters& clusters,
                                    double gradation, std::vector<double>& h,
                                    internal::Concurrency concurrency = Sequential_tag())
{
  const int vertices = static_cast<int>(h.size());
  const auto distance = [&](int v) {
    return length(surface.points[v] - surface.points[clusters.centers[clusters.cluster_of[v]]]);
  };
  std::vector<double> coarse(clusters.centers.size(), std::numeric_limits<double>::infinity());
  internal::for_each_index(concurrency, vertices, [&](int v) {
    atomic_min(&coarse[clusters.cluster_of[v]], h[v] + gradation * distance(v));
  });
  limit_growth(clusters.edges, gradation, coarse, concurrency);
  internal::for_each_index(concurrency, vertices, [&](int v) {
    h[v] = (std::min)(h[v], coarse[clusters.cluster_of[v]] + gradation * distance(v));
  });
}

/// Raises `surface.vertex_density` where needed so that the spacing of `n` samples grows by at most
/// `gradation` per unit of length. Raising the density makes all spacings larger, so the limit is
/// applied until that is less than 2 %, at most 4 times, with `clusters` to an estimate but for the
/// last time.
inline void limit_gradation(Surface& surface, const Surface_edges& edges,
                            const std::optional<Vertex_clusters>& clusters, double gradation,
                            std::size_t n, internal::Concurrency concurrency = Sequential_tag())
{
  constexpr int passes = 4;
  constexpr double least_growth = 1.02;
  const int vertices = static_cast<int>(surface.points.size());
  std::vector<double>& rho = surface.vertex_density;
  std::vector<double> unit(vertices), h(vertices); // spacing by C
  internal::for_each_index(concurrency, vertices, [&](int v) { unit[v] = 1 / std::sqrt(rho[v]); });
  double C = spacing_constant(surface, n, concurrency);
  const auto limit = [&](bool to_estimate) {
    internal::for_each_index(concurrency, vertices, [&](int v) { h[v] = C * unit[v]; });
    to_estimate ? estimate_limited_growth(surface, *clusters, gradation, h, concurrency)
                : limit_growth(edges, gradation, h, concurrency);
    internal::for_each_index(concurrency, vertices, [&](int v) { rho[v] = C * C / (h[v] * h[v]); });
    C = spacing_constant(surface, n, concurrency);
  };
  double before = 0;
  for (int pass = 0; pass < passes && C > least_growth * before; ++pass) {
    const internal::Progress_part part(double(pass + 1) / passes);
    before = C;
    limit(clusters.has_value());
  }
  if (clusters) limit(false);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_GRADATION_H
