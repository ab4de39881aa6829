// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for sample_surface.h.
#ifndef CGAL_POWER_RTF_SAMPLING_SAMPLE_SURFACE_IMPL_H
#define CGAL_POWER_RTF_SAMPLING_SAMPLE_SURFACE_IMPL_H

#include <CGAL/PowerRTF/features/topology_minimum.h>
#include <CGAL/PowerRTF/option_table.h>
#include <CGAL/PowerRTF/sampling/initial_sampling.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

CGAL_POWER_RTF_INLINE Samples sample_surface(const Surface& surface,
                                             const Remeshing_options& options,
                                             const Feature_samples& features)
{
  validate(options);
  const std::size_t n = options.number_of_samples - features.size();

  const auto& rho = surface.vertex_density;
  const auto density_mass = [&](int f) {
    const Triangle& t = surface.triangles[f];
    return surface.facet_areas[f] * (rho[t[0]] + rho[t[1]] + rho[t[2]]) / 3;
  };
  const auto [component, components] = facet_components(surface.adjacency);
  const internal::Facet_distribution by_density =
      internal::facet_distribution(component, components, density_mass);
  internal::Facet_distribution by_area;
  if (options.sampling == Sampling::random)
    by_area = internal::facet_distribution(component, components,
                                           [&](int f) { return surface.facet_areas[f]; });

  std::vector<double> masses;
  for (int c = 0; c < components; ++c) masses.push_back(by_density.mass(c));
  std::vector<double> free_masses = masses; // without the parts of the samples on the boundaries
  std::vector<std::size_t> least;
  for (const Component_topology& c : component_topologies(surface))
    least.push_back(c.least_samples());
  const double cell_mass =
      density_integral(surface) / equivalent_cells(options.number_of_samples, features);
  for (std::size_t s = 0; s < features.sites.size(); ++s) {
    const int c = features.sites.patches[s];
    least[c] = 0;
    free_masses[c] = (std::max)(0., free_masses[c] - features.shares[s] * cell_mass);
  }
  if (!(*std::max_element(free_masses.begin(), free_masses.end()) > 0)) free_masses = masses;
  const std::vector<std::size_t> allocation = internal::allocate_samples(free_masses, least, n);

  Random_source random(options.random_seed);
  Samples samples;
  for (int c = 0; c < components; ++c) {
    if (allocation[c] == 0) continue;
    const auto count = static_cast<std::size_t>(
        std::ceil(static_cast<double>(allocation[c]) * options.oversampling));
    const bool eliminate = options.sampling == Sampling::elimination;
    const Samples candidates =
        eliminate ? internal::stratified_candidates(surface, by_density, c, count, random)
                  : internal::random_candidates(surface, by_area, c, count, random);
    const std::vector<int> chosen =
        eliminate
            ? internal::draw_by_elimination(
                  candidates, features, c,
                  features.size() > 0 ? cell_mass : masses[c] / static_cast<double>(allocation[c]),
                  allocation[c], options.normal_angle)
            : internal::draw_by_density(candidates, allocation[c], random);
    for (const int i : chosen) {
      samples.points.push_back(candidates.points[i]);
      samples.facets.push_back(candidates.facets[i]);
      if (components > 1) samples.patches.push_back(c);
      samples.normals.push_back(candidates.normals[i]);
      samples.density.push_back(candidates.density[i]);
    }
  }
  samples.weights.assign(samples.size(), 0);
  return samples;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_SAMPLE_SURFACE_IMPL_H
