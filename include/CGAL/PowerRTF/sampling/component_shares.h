// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many samples each component of the surface gets.
#ifndef CGAL_POWER_RTF_SAMPLING_COMPONENT_SHARES_H
#define CGAL_POWER_RTF_SAMPLING_COMPONENT_SHARES_H

#include <CGAL/PowerRTF/features/narrow_patches.h>
#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/geometry/component_topology.h>
#include <CGAL/PowerRTF/sampling/Component_share.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

/// Shares `n` samples among components in proportion to their masses, by the method of the largest
/// remainder; no component gets fewer than its least number if `n` allows (none without mass gets
/// any).
inline std::vector<std::size_t> allocate_samples(const std::vector<double>& masses,
                                                 const std::vector<std::size_t>& least,
                                                 std::size_t n)
{
  const std::size_t components = masses.size();
  std::vector<std::size_t> samples(components, 0);
  std::vector<char> is_fixed(components, 0);
  for (std::size_t c = 0; c < components; ++c) is_fixed[c] = !(masses[c] > 0);
  std::size_t free_samples = n;
  double free_mass = std::accumulate(masses.begin(), masses.end(), 0.);
  if (n >= std::accumulate(least.begin(), least.end(), std::size_t(0))) {
    for (bool changed = true; changed;) { // each fixed component takes samples from the others
      changed = false;
      const double per_mass = static_cast<double>(free_samples) / free_mass;
      for (std::size_t c = 0; c < components; ++c) {
        if (is_fixed[c] || masses[c] * per_mass > static_cast<double>(least[c]) - 1e-6) continue;
        is_fixed[c] = 1;
        samples[c] = least[c];
        free_samples -= least[c];
        free_mass -= masses[c];
        changed = true;
      }
    }
  }

  // Remainders are compared up to 1e-6, so that rounding does not decide between equal components.
  std::vector<std::pair<long, std::size_t>> remainders;
  std::size_t left = free_samples;
  for (std::size_t c = 0; c < components; ++c) {
    if (is_fixed[c]) continue;
    const double quota = masses[c] / free_mass * static_cast<double>(free_samples);
    samples[c] = (std::min)(left, static_cast<std::size_t>(quota + 1e-7));
    left -= samples[c];
    const double remainder = quota - static_cast<double>(samples[c]);
    remainders.emplace_back(-std::lround(remainder * 1e6 / 3), c);
  }
  std::sort(remainders.begin(), remainders.end());
  for (std::size_t k = 0; left > 0; k = (k + 1) % remainders.size(), --left)
    ++samples[remainders[k].second];
  return samples;
}

/// Whether components are strips with no room for more than one row of triangles between the
/// samples of `features` on both their sides. \param topology of the surface
inline std::vector<char> narrow_components(const Surface& surface, const Feature_samples& features,
                                           const Topology& topology)
{
  const Samples& sites = features.sites;
  std::vector<Patch_shape> shapes(topology.size());
  std::vector<int> counts(shapes.size(), 0);
  std::vector<char> result(shapes.size(), 0);
  if (sites.size() == 0) return result;
  for (std::size_t f = 0; f < topology.component.size(); ++f)
    shapes[topology.component[f]].area += surface.facet_areas[f];
  for (std::size_t s = 0; s < sites.size(); ++s) {
    if (features.next[s] < 0) continue;
    shapes[sites.patches[s]].perimeter += length(sites.points[features.next[s]] - sites.points[s]);
    ++counts[sites.patches[s]];
  }
  for (std::size_t c = 0; c < shapes.size(); ++c) {
    shapes[c].loops = static_cast<int>(topology.components[c].border_loops);
    const double width = shapes[c].strip()[0];
    result[c] = counts[c] > 0 && width * counts[c] < shapes[c].perimeter;
  }
  return result;
}

/// Leaves no negative rooms for samples, and none for less than one sample in narrow components,
/// where that would make flat triangles; unless there were too few others for all samples.
inline void empty_small_rooms(const std::vector<char>& is_narrow, std::vector<double>& rooms)
{
  constexpr double most_growth = 1.2;
  std::vector<double> large = rooms;
  for (std::size_t c = 0; c < rooms.size(); ++c) {
    rooms[c] = (std::max)(0., rooms[c]);
    large[c] = is_narrow[c] && rooms[c] < 1 ? 0 : rooms[c];
  }
  const auto sum = [](const std::vector<double>& all) {
    return std::accumulate(all.begin(), all.end(), 0.);
  };
  if (sum(rooms) <= most_growth * sum(large)) rooms.swap(large);
}

/// The facets sorted by component, with running sums of what the candidates are proportional to.
struct Facet_distribution {
  std::vector<int> facets;        ///< #F, component by component
  std::vector<double> sums;       ///< #F + 1
  std::vector<std::size_t> first; ///< #components + 1: where a component begins in `facets`

  double mass(std::size_t c) const { return sums[first[c + 1]] - sums[first[c]]; }
};

/// \param facet_mass function facet -> mass
template <class Facet_mass>
Facet_distribution facet_distribution(const std::vector<int>& component, int components,
                                      const Facet_mass& facet_mass)
{
  Facet_distribution d;
  d.first.assign(components + 1, 0);
  for (const int c : component) ++d.first[c + 1];
  std::partial_sum(d.first.begin(), d.first.end(), d.first.begin());
  d.facets.resize(component.size());
  std::vector<std::size_t> end(d.first.begin(), d.first.end() - 1);
  for (std::size_t f = 0; f < component.size(); ++f)
    d.facets[end[component[f]]++] = static_cast<int>(f);
  d.sums.assign(component.size() + 1, 0);
  for (std::size_t k = 0; k < component.size(); ++k)
    d.sums[k + 1] = d.sums[k] + facet_mass(d.facets[k]);
  return d;
}

/// The integral of the density over facet `f`.
inline double density_mass(const Surface& surface, int f)
{
  const Triangle& t = surface.triangles[f];
  const auto& rho = surface.vertex_density;
  return surface.facet_areas[f] * (rho[t[0]] + rho[t[1]] + rho[t[2]]) / 3;
}

} // namespace internal

/// Shares `n` samples, those of `features` among them, so that all components have triangles of the
/// same mean mass; each gets as many as its topology needs if `n` allows.
/// \param topology of the surface
inline std::vector<Component_share> component_shares(const Surface& surface, std::size_t n,
                                                     const Feature_samples& features,
                                                     const internal::Topology& topology,
                                                     internal::Concurrency concurrency)
{
  const std::vector<int>& component = topology.component;
  const int components = topology.size();
  const double mass = density_integral(surface, concurrency);
  std::vector<double> masses(components, 0);
  if (components == 1)
    masses[0] = mass;
  else
    for (std::size_t f = 0; f < component.size(); ++f)
      masses[component[f]] += internal::density_mass(surface, static_cast<int>(f));
  const double cell_mass = mass / equivalent_cells(surface, n, features);
  std::vector<double> sites(components, 0), inside = sites, rooms; // for samples inside
  for (std::size_t s = 0; s < features.sites.size(); ++s)
    ++(features.next[s] < 0 ? inside : sites)[features.sites.patches[s]];
  std::vector<std::size_t> least;
  for (int c = 0; c < components; ++c) {
    const Component_topology& shape = topology.components[c];
    rooms.push_back(masses[c] / cell_mass - inside[c]);
    if (sites[c] > 0) // as equivalent_cells() has it
      rooms.back() += static_cast<double>(shape.euler_characteristic) - sites[c] / 2;
    const auto fixed = static_cast<std::size_t>(inside[c]);
    least.push_back(
        sites[c] > 0 ? 0 : shape.least_samples() - (std::min)(shape.least_samples(), fixed));
  }
  internal::empty_small_rooms(internal::narrow_components(surface, features, topology), rooms);
  if (!(*std::max_element(rooms.begin(), rooms.end()) > 0)) rooms = masses;
  const std::vector<std::size_t> samples =
      internal::allocate_samples(rooms, least, n - features.size());
  std::vector<Component_share> shares;
  for (std::size_t c = 0; c < masses.size(); ++c)
    shares.push_back(
        {samples[c], masses[c],
         features.size() > 0 ? cell_mass : masses[c] / static_cast<double>(samples[c])});
  return shares;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_COMPONENT_SHARES_H
