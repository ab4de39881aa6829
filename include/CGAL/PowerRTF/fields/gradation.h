// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Limits how fast the spacing of the samples grows over the surface (mesh gradation control,
// Borouchaki, Hecht and Frey 1998).
#ifndef CGAL_POWER_RTF_FIELDS_GRADATION_H
#define CGAL_POWER_RTF_FIELDS_GRADATION_H

#include <CGAL/PowerRTF/fields/Vertex_clusters.h>
#include <CGAL/PowerRTF/fields/density_steps.h>
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
  return internal::sum(concurrency, static_cast<int>(surface.triangles.size()),
                       internal::Density_integral{surface.triangles.data()->data(),
                                                  surface.facet_areas.data(),
                                                  surface.vertex_density.data()});
}

/// C of `h = C rho^(-1/2)`, the spacing of `n` samples in hexagonal arrangement where the density
/// is rho.
inline double spacing_constant(double integral, std::size_t n)
{
  return std::sqrt(2 / std::sqrt(3.) * integral / static_cast<double>(n));
}
inline double spacing_constant(const Surface& surface, std::size_t n,
                               internal::Concurrency concurrency = Sequential_tag())
{
  return spacing_constant(density_integral(surface, concurrency), n);
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
  const internal::Growth_bound bound{edges.view(), gradation, h.data()};
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

/// `limit(C)` limits the growth of spacings with the constant C, which makes all of them larger,
/// and returns the constant then. So this is done until C grows by less than 2 %, at most 4 times.
/// \returns C
template <class Limit>
double limit_repeatedly(double C, const Limit& limit)
{
  constexpr int passes = 4;
  constexpr double least_growth = 1.02;
  double before = 0;
  for (int pass = 0; pass < passes && C > least_growth * before; ++pass) {
    const internal::Progress_part part(double(pass + 1) / passes);
    before = C;
    C = limit(C);
  }
  return C;
}

/// Raises `surface.vertex_density` where needed so that the spacing of `n` samples grows by at most
/// `gradation` per unit of length; see `limit_repeatedly()`. With `clusters`, to an estimate but
/// for the last time.
inline void limit_gradation(Surface& surface, const Surface_edges& edges,
                            const std::optional<Vertex_clusters>& clusters, double gradation,
                            std::size_t n, internal::Concurrency concurrency = Sequential_tag())
{
  const int vertices = static_cast<int>(surface.points.size());
  double* const rho = surface.vertex_density.data();
  std::vector<double> relative(vertices), h(vertices);
  internal::for_each_index(concurrency, vertices,
                           internal::Find_relative_spacing{rho, relative.data()});
  const auto limit = [&](double C, bool to_estimate) {
    internal::for_each_index(concurrency, vertices,
                             internal::Scale_spacing{C, relative.data(), h.data()});
    to_estimate ? estimate_limited_growth(surface, *clusters, gradation, h, concurrency)
                : limit_growth(edges, gradation, h, concurrency);
    internal::for_each_index(concurrency, vertices,
                             internal::Find_density_of_spacing{C, h.data(), rho});
    return spacing_constant(surface, n, concurrency);
  };
  const double last = limit_repeatedly(spacing_constant(surface, n, concurrency),
                                       [&](double C) { return limit(C, clusters.has_value()); });
  if (clusters) limit(last, false);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_GRADATION_H
