// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for sample_surface.h.
#ifndef CGAL_POWER_RTF_SAMPLING_SAMPLE_SURFACE_IMPL_H
#define CGAL_POWER_RTF_SAMPLING_SAMPLE_SURFACE_IMPL_H

#include <CGAL/PowerRTF/geometry/Surface_arrays.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/make_surface_in_tree.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/option_table.h>
#include <CGAL/PowerRTF/sampling/Lattice_field.h>
#include <CGAL/PowerRTF/sampling/Lattice_plan.h>
#include <CGAL/PowerRTF/sampling/Lattice_sampler.h>
#include <CGAL/PowerRTF/sampling/initial_sampling.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>
#include <CGAL/PowerRTF/sampling/unroll_surface.h>

#include <memory>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF {

template <class ConcurrencyTag>
Samples sample_surface(const Surface& surface, const Remeshing_options& options,
                       const Feature_samples& features, const Facet_tree* tree,
                       std::size_t* off_lattice, const Make_lattice_field& make,
                       const Find_facets& find, const Place_candidates& place)
{
  validate(options);
  internal::Progress_part part(0.02);
  using Backend = Host_backend<ConcurrencyTag>;
  Backend backend;
  const auto topology = internal::known_topology(surface, backend.concurrency());
  const std::vector<int>& component = topology->component;
  const std::vector<Component_share> shares = component_shares(
      surface, options.number_of_samples, features, *topology, backend.concurrency());
  part.next(0.99);
  Samples samples;
  if (off_lattice) *off_lattice = 0;
  std::optional<Facet_tree> own_tree;
  const auto facets = [&]() -> const Facet_tree& {
    return tree ? *tree
                : own_tree.emplace(surface.points, surface.triangles, surface.facet_patches);
  };
  if (options.sampling == Sampling::lattice) {
    const Facet_tree& places = facets();
    Lattice_sampler<Backend> sampler(backend, surface, places, features, component, shares,
                                     options.random_seed);
    std::optional<Surface_arrays<double, Backend>> arrays;
    const Make_lattice_field own_make = [&](const Lattice_plan& plan) {
      arrays.emplace(backend, internal::make_surface_in_tree(surface, places));
      return std::make_unique<Lattice_field<Backend>>(backend, arrays->view(), plan);
    };
    samples = sampler.run(make ? make : own_make, find, place);
    if (off_lattice) *off_lattice = sampler.off_lattice();
  } else if (options.sampling == Sampling::stratified) {
    samples =
        stratified_samples(backend, surface, facets(), component, shares, options.random_seed);
  } else {
    samples = internal::draw_samples(surface, options, features, component, shares,
                                     backend.concurrency());
  }
  if (topology->size() > 1)
    for (const int f : samples.facets) samples.patches.push_back(component[f]);
  samples.weights.assign(samples.size(), 0);
  return samples;
}

template <class ConcurrencyTag>
Lattice_fields lattice_fields(const Surface& surface, const Remeshing_options& options,
                              const Feature_samples& features, const Facet_tree& tree)
{
  validate(options);
  if (options.sampling != Sampling::lattice)
    throw Invalid_input_error("the samples begin as a lattice only where sampling is lattice");
  using Backend = Host_backend<ConcurrencyTag>;
  Backend backend;
  const auto topology = internal::known_topology(surface, backend.concurrency());
  const std::vector<int>& component = topology->component;
  const std::vector<Component_share> shares = component_shares(
      surface, options.number_of_samples, features, *topology, backend.concurrency());
  const Surface_arrays<double, Backend> arrays(backend,
                                               internal::make_surface_in_tree(surface, tree));
  return Lattice_sampler<Backend>(backend, surface, tree, features, component, shares,
                                  options.random_seed)
      .fields(arrays.view());
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_SAMPLE_SURFACE_IMPL_H
