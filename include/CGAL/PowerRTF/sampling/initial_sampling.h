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

/// A point of a surface.
struct Facet_place {
  int facet;
  std::array<double, 3> weights; ///< barycentric coordinates
};

namespace internal {

/// Appends the points at `places`.
template <class Places>
void add_samples(const Surface& surface, const Places& places, Samples& samples,
                 Concurrency concurrency = Sequential_tag())
{
  const std::size_t before = samples.size(), size = before + places.size();
  const auto resize = [&](auto& items) {
    before > 0 ? items.resize(size) : resize_in_parallel(concurrency, items, size);
  };
  call_at_once(
      concurrency, [&] { resize(samples.points); }, [&] { resize(samples.facets); },
      [&] { resize(samples.normals); }, [&] { resize(samples.density); });
  for_each_index(concurrency, static_cast<int>(places.size()), [&](int k) {
    const auto& [f, b] = places[k];
    const Triangle& t = surface.triangles[f];
    const auto& p = surface.points;
    samples.points[before + k] = b[0] * p[t[0]] + b[1] * p[t[1]] + b[2] * p[t[2]];
    samples.facets[before + k] = f;
    samples.normals[before + k] = interpolated_normal(surface, f, b);
    samples.density[before + k] = interpolated_density(surface, f, b);
  });
}

/// `count` independent points of component `c`, uniform by area.
inline std::vector<Facet_place> random_candidates(const Facet_distribution& d, std::size_t c,
                                                  std::size_t count, Random_source& random)
{
  std::vector<Facet_place> candidates;
  for (std::size_t k = 0; k < count; ++k) {
    const double sum = d.sums[d.first[c]] + random() * d.mass(c);
    const auto above =
        std::upper_bound(d.sums.begin() + d.first[c] + 1, d.sums.begin() + d.first[c + 1], sum);
    candidates.push_back({d.facets[above - d.sums.begin() - 1], random.barycentric({1, 1, 1})});
  }
  return candidates;
}

/// `count` points of component `c` distributed like the density: one in each of `count` parts of
/// equal mass of the sequence of its facets.
inline std::vector<Facet_place> stratified_candidates(const Surface& surface,
                                                      const Facet_distribution& d, std::size_t c,
                                                      std::size_t count, Random_source& random)
{
  std::vector<Facet_place> candidates;
  std::size_t k = d.first[c];
  for (std::size_t s = 0; s < count; ++s) {
    const double share = (static_cast<double>(s) + random()) / static_cast<double>(count);
    const double sum = d.sums[d.first[c]] + share * d.mass(c);
    while (k + 1 < d.first[c + 1] && d.sums[k + 1] <= sum) ++k;
    const Triangle& t = surface.triangles[d.facets[k]];
    const auto& rho = surface.vertex_density;
    candidates.push_back({d.facets[k], random.barycentric({rho[t[0]], rho[t[1]], rho[t[2]]})});
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
inline std::vector<int> draw_by_elimination(const Samples& candidates,
                                            const Feature_samples& features, int c,
                                            double cell_mass, std::size_t n, double normal_angle,
                                            Concurrency concurrency)
{
  const std::size_t count = candidates.size();
  if (count <= n) { // none is to go
    std::vector<int> all(count);
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
  // Discs of radius r in hexagonal arrangement take 2 sqrt(3) r^2 each.
  const double per_sample = cell_mass / (2 * std::sqrt(3.));
  Elimination_candidates all;
  const auto add = [&](const Samples& from, std::size_t i) {
    all.push_back({from.points[i], from.normals[i], std::sqrt(per_sample / from.density[i])});
  };
  for (std::size_t i = 0; i < count; ++i) add(candidates, i);
  for (std::size_t s = 0; s < features.sites.size(); ++s)
    if (features.sites.patches[s] == c) add(features.sites, s);
  constexpr double radians = 3.14159265358979323846 / 180;
  return eliminate_samples(all, std::cos(normal_angle * radians), n, all.size() - count,
                           concurrency);
}

/// By `Sampling::random` or `Sampling::elimination`, one component after another.
inline Samples draw_samples(const Surface& surface, const Remeshing_options& options,
                            const Feature_samples& features, const std::vector<int>& component,
                            const std::vector<Component_share>& shares, Concurrency concurrency)
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
    const std::vector<Facet_place> places =
        eliminate ? stratified_candidates(surface, distribution, c, count, random)
                  : random_candidates(distribution, c, count, random);
    Samples candidates;
    add_samples(surface, places, candidates, concurrency);
    const std::vector<int> chosen =
        eliminate ? draw_by_elimination(candidates, features, static_cast<int>(c),
                                        shares[c].cell_mass, n, options.normal_angle, concurrency)
                  : draw_by_density(candidates, n, random);
    std::vector<Facet_place> chosen_places;
    for (const int i : chosen) chosen_places.push_back(places[i]);
    add_samples(surface, chosen_places, samples, concurrency);
  }
  return samples;
}

} // namespace internal
} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_INITIAL_SAMPLING_H
