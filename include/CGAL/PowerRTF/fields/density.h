// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The density rho that steers how close the samples lie: uniform, from curvature or the user's own
// (Section 4.3, "Initial Sampling"; gradation is an addition).
#ifndef CGAL_POWER_RTF_FIELDS_DENSITY_H
#define CGAL_POWER_RTF_FIELDS_DENSITY_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/fields/Compute_density.h>
#include <CGAL/PowerRTF/fields/Vertex_clusters.h>
#include <CGAL/PowerRTF/fields/curvature.h>
#include <CGAL/PowerRTF/fields/density_steps.h>
#include <CGAL/PowerRTF/fields/diffusion.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/cut_surface.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/option_table.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

/// See `Normalize_density`.
inline void normalize_density(std::vector<double>& density,
                              Concurrency concurrency = Sequential_tag())
{
  const double largest = *std::max_element(density.begin(), density.end());
  for_each_index(concurrency, static_cast<int>(density.size()),
                 Normalize_density{largest, density.data()});
}

/// The values at the vertices of a surface.
/// \param values one per vertex of the *input* (see `Surface::input_vertices`); those of vertices
///   that the surface does not use are ignored
/// \param what they are, for messages
/// \throws Invalid_input_error a value is missing, not positive or not finite
inline std::vector<double> surface_values(const Surface& surface, const std::vector<double>& values,
                                          const std::string& what)
{
  std::vector<double> result(surface.points.size());
  for (std::size_t v = 0; v < result.size(); ++v) {
    const std::size_t input = surface.input_vertices[v];
    if (input >= values.size())
      throw Invalid_input_error("vertex " + std::to_string(input) + " has no " + what);
    result[v] = values[input];
    if (!(result[v] > 0) || !std::isfinite(result[v]))
      throw Invalid_input_error("the " + what + " of vertex " + std::to_string(input) +
                                " is not a positive, finite number");
  }
  return result;
}

/// Clusters of vertices much nearer to each other than samples ever are; none, if there are few
/// such vertices.
inline std::optional<Vertex_clusters> near_vertices(const Surface& surface,
                                                    const Surface_edges& edges, std::size_t n,
                                                    Concurrency concurrency)
{
  const double least =
      spacing_constant(surface, n, concurrency) /
      std::sqrt(*std::max_element(surface.vertex_density.begin(), surface.vertex_density.end()));
  Vertex_clusters clusters =
      vertex_clusters(surface.points, edges, Count_near::distance * least, concurrency);
  if (2 * clusters.centers.size() > surface.points.size()) return std::nullopt;
  return clusters;
}

/// Diffuses the densities' logarithms over `width` times the local spacing of `n` samples.
inline void smooth_density(Surface& surface, const Surface_edges& edges,
                           const std::optional<Vertex_clusters>& clusters, std::size_t n,
                           double width, Concurrency concurrency)
{
  using Times = Density_diffusion;
  std::vector<double>& rho = surface.vertex_density;
  const double variance = diffusion_variance(surface, n, width, concurrency);
  const auto smooth = [&](const Surface_edges& graph, std::vector<double>& density) {
    const int size = static_cast<int>(density.size());
    const std::vector<double> times = diffusion_times(
        graph, [&](int v) { return variance / density[v]; }, Times::longest, concurrency);
    for_each_index(concurrency, size, Take_logarithm{density.data()});
    diffuse(graph, times, Times::steps, density, concurrency);
    for_each_index(concurrency, size, Take_exponential{density.data()});
  };
  if (!clusters) return smooth(edges, rho);
  std::vector<double> coarse;
  coarse.reserve(clusters->centers.size());
  for (const int v : clusters->centers) coarse.push_back(rho[v]);
  smooth(clusters->edges, coarse);
  for_each_index(concurrency, static_cast<int>(rho.size()),
                 [&](int v) { rho[v] = coarse[clusters->cluster_of[v]]; });
  // Over about half the distance of two centers, so that no steps between clusters are left.
  const double deviation = 0.7 * clusters->longest;
  const std::vector<double> times = diffusion_times(
      edges, [&](int) { return deviation * deviation; }, Times::longest, concurrency);
  diffuse(edges, times, 3, rho, concurrency);
}

} // namespace internal

/// \ingroup PkgPowerRTFSurface
/// Sets `surface.vertex_density` as `options` asks: 1, or \f$\kappa^p\f$ with \f$p\f$ =
/// `density_power`, its growth limited by `gradation`, smoothed over `density_smoothing` times the
/// spacing. Only ratios of densities matter to any later stage.
/// \param compute_there what computes the density that follows the curvature instead, where it does
/// \throws Invalid_input_error an option has a value that is not allowed
inline void set_density(Surface& surface, const Remeshing_options& options,
                        internal::Concurrency concurrency = Sequential_tag(),
                        const Compute_density& compute_there = {})
{
  validate(options);
  surface.vertex_density.assign(surface.points.size(), 1);
  if (options.density == Density::uniform) return;
  if (compute_there && compute_there(surface, options, surface.vertex_density)) return;
  const Surface_edges edges = surface_edges(surface, concurrency);
  if (surface.creases.empty()) {
    surface.vertex_density = normalized_curvature(surface, edges, concurrency);
  } else { // a crease is no curvature: both its sides may be flat
    const Cut_surface cut = cut_along_creases(surface);
    const std::vector<double> curvature =
        normalized_curvature(cut.surface, surface_edges(cut.surface, concurrency), concurrency);
    std::fill(surface.vertex_density.begin(), surface.vertex_density.end(), 0);
    for (std::size_t v = 0; v < curvature.size(); ++v) {
      double& rho = surface.vertex_density[cut.originals[v]];
      rho = (std::max)(rho, curvature[v]);
    }
  }
  std::vector<double>& density = surface.vertex_density;
  internal::for_each_index(concurrency, static_cast<int>(density.size()),
                           internal::Raise_to_power{options.density_power, density.data()});
  internal::normalize_density(density, concurrency);
  const std::size_t n = options.number_of_samples;
  const auto clusters = internal::near_vertices(surface, edges, n, concurrency);
  if (options.gradation > 0)
    limit_gradation(surface, edges, clusters, options.gradation, n, concurrency);
  if (options.density_smoothing > 0)
    internal::smooth_density(surface, edges, clusters, n, options.density_smoothing, concurrency);
}

/// \ingroup PkgPowerRTFSurface
/// Sets `surface.vertex_density` from the user's own densities, with their growth limited by
/// `options.gradation`.
/// \param densities one per vertex of the *input* (see `Surface::input_vertices`); those of
///   vertices that the surface does not use are ignored
/// \throws Invalid_input_error a density is missing, not positive or not finite, or an option has a
///   value that is not allowed
inline void set_density(Surface& surface, const Remeshing_options& options,
                        const std::vector<double>& densities,
                        internal::Concurrency concurrency = Sequential_tag())
{
  validate(options);
  surface.vertex_density = internal::surface_values(surface, densities, "density");
  internal::normalize_density(surface.vertex_density, concurrency);
  if (options.gradation > 0) {
    const Surface_edges edges = surface_edges(surface, concurrency);
    const std::size_t n = options.number_of_samples;
    limit_gradation(surface, edges, internal::near_vertices(surface, edges, n, concurrency),
                    options.gradation, n, concurrency);
  }
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_DENSITY_H
