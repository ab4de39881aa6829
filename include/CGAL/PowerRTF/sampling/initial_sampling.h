// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first n samples (Section 4.3, "Initial Sampling"): the paper's random choice, or sample
// elimination from candidates that are distributed like the density.
#ifndef CGAL_POWER_RTF_SAMPLING_INITIAL_SAMPLING_H
#define CGAL_POWER_RTF_SAMPLING_INITIAL_SAMPLING_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/geometry/surface_geometry.h>
#include <CGAL/PowerRTF/sampling/component_shares.h>
#include <CGAL/PowerRTF/sampling/random_source.h>
#include <CGAL/PowerRTF/sampling/sample_elimination.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// Appends the point of facet `f` with the barycentric coordinates `b`.
inline void add_sample(const Surface& surface, int f, const std::array<double, 3>& b,
                       Samples& samples)
{
  const Triangle& t = surface.triangles[f];
  const auto& p = surface.points;
  samples.points.push_back(b[0] * p[t[0]] + b[1] * p[t[1]] + b[2] * p[t[2]]);
  samples.facets.push_back(f);
  samples.normals.push_back(interpolated_normal(surface, f, b));
  samples.density.push_back(interpolated_density(surface, f, b));
}

/// `count` independent points of component `c`, uniform by area.
inline Samples random_candidates(const Surface& surface, const Facet_distribution& d, std::size_t c,
                                 std::size_t count, Random_source& random)
{
  Samples candidates;
  for (std::size_t k = 0; k < count; ++k) {
    const double sum = d.sums[d.first[c]] + random() * d.mass(c);
    const auto above =
        std::upper_bound(d.sums.begin() + d.first[c] + 1, d.sums.begin() + d.first[c + 1], sum);
    add_sample(surface, d.facets[above - d.sums.begin() - 1], random.barycentric({1, 1, 1}),
               candidates);
  }
  return candidates;
}

/// `count` points of component `c` distributed like the density: one in each of `count` parts of
/// equal mass of the sequence of its facets.
inline Samples stratified_candidates(const Surface& surface, const Facet_distribution& d,
                                     std::size_t c, std::size_t count, Random_source& random)
{
  Samples candidates;
  std::size_t k = d.first[c];
  for (std::size_t s = 0; s < count; ++s) {
    const double share = (static_cast<double>(s) + random()) / static_cast<double>(count);
    const double sum = d.sums[d.first[c]] + share * d.mass(c);
    while (k + 1 < d.first[c + 1] && d.sums[k + 1] <= sum) ++k;
    const Triangle& t = surface.triangles[d.facets[k]];
    const auto& rho = surface.vertex_density;
    add_sample(surface, d.facets[k], random.barycentric({rho[t[0]], rho[t[1]], rho[t[2]]}),
               candidates);
  }
  return candidates;
}

/// `n` of the candidates, without replacement, each drawn with probability proportional to its
/// density among those left (Efraimidis and Spirakis 2006).
inline std::vector<int> draw_by_density(const Samples& candidates, std::size_t n,
                                        Random_source& random)
{
  std::vector<std::pair<double, int>> keys;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    keys.emplace_back(-std::log(1 - random()) / candidates.density[i], static_cast<int>(i));
  std::nth_element(keys.begin(), keys.begin() + n, keys.end());
  std::vector<int> chosen;
  for (std::size_t k = 0; k < n; ++k) chosen.push_back(keys[k].second);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// `n` of the candidates of component `c`, by sample elimination among themselves and the sites of
/// `features` on it. `cell_mass`: what each sample stands for.
inline std::vector<int> draw_by_elimination(Samples candidates, const Feature_samples& features,
                                            int c, double cell_mass, std::size_t n,
                                            double normal_angle)
{
  const std::size_t count = candidates.size();
  if (count <= n) { // none is to go
    std::vector<int> all(count);
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  const Samples& sites = features.sites;
  for (std::size_t s = 0; s < sites.size(); ++s) {
    if (sites.patches[s] != c) continue;
    candidates.points.push_back(sites.points[s]);
    candidates.normals.push_back(sites.normals[s]);
    candidates.density.push_back(sites.density[s]);
  }
  // Discs of radius r in hexagonal arrangement take 2 sqrt(3) r^2 each.
  const double per_sample = cell_mass / (2 * std::sqrt(3.));
  std::vector<double> radii;
  radii.reserve(candidates.size());
  for (const double rho : candidates.density) radii.push_back(std::sqrt(per_sample / rho));
  constexpr double radians = 3.14159265358979323846 / 180;
  return eliminate_samples(candidates.points, candidates.normals, radii,
                           std::cos(normal_angle * radians), n, candidates.size() - count);
}

/// By `Sampling::random` or `Sampling::elimination`, one component after another.
inline Samples draw_samples(const Surface& surface, const Remeshing_options& options,
                            const Feature_samples& features, const std::vector<int>& component,
                            const std::vector<Component_share>& shares)
{
  const bool eliminate = options.sampling == Sampling::elimination;
  const Facet_distribution distribution =
      facet_distribution(component, static_cast<int>(shares.size()), [&](int f) {
        return eliminate ? density_mass(surface, f) : surface.facet_areas[f];
      });
  Random_source random(options.random_seed);
  Samples samples;
  for (std::size_t c = 0; c < shares.size(); ++c) {
    const std::size_t n = shares[c].samples;
    if (n == 0) continue;
    const auto count =
        static_cast<std::size_t>(std::ceil(static_cast<double>(n) * options.oversampling));
    const Samples candidates = eliminate
                                   ? stratified_candidates(surface, distribution, c, count, random)
                                   : random_candidates(surface, distribution, c, count, random);
    const std::vector<int> chosen =
        eliminate ? draw_by_elimination(candidates, features, static_cast<int>(c),
                                        shares[c].cell_mass, n, options.normal_angle)
                  : draw_by_density(candidates, n, random);
    for (const int i : chosen) {
      samples.points.push_back(candidates.points[i]);
      samples.facets.push_back(candidates.facets[i]);
      samples.normals.push_back(candidates.normals[i]);
      samples.density.push_back(candidates.density[i]);
    }
  }
  return samples;
}

} // namespace internal
} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_INITIAL_SAMPLING_H
