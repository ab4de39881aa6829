// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SAMPLING_PLAN_LATTICE_H
#define CGAL_POWER_RTF_SAMPLING_PLAN_LATTICE_H

#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/Tangent_frame.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/sampling/Lattice_plan.h>
#include <CGAL/PowerRTF/sampling/unroll_surface.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL::PowerRTF {

/// Every `stride`-th of the sites on creases and borders. The lattice's rows follow these where
/// they do not turn.
/// \param before of each site the one before it along its patch's boundary; -1: none
/// \param component of each facet
inline Lattice_sites lattice_sites(const Feature_samples& features, const std::vector<int>& before,
                                   std::size_t stride, const Surface_cube& cube,
                                   const std::vector<int>& component,
                                   const std::vector<Component_share>& shares,
                                   internal::Concurrency concurrency)
{
  constexpr double straight = 0.8; // cosine
  const Samples& sites = features.sites;
  Lattice_sites result;
  result.resize((sites.size() + stride - 1) / stride);
  internal::for_each_index(concurrency, static_cast<int>(result.size()), [&](int k) {
    const int at = static_cast<int>(k * stride), c = component[sites.facets[at]];
    result.points[k] = to_real<float>(cube.to_inside(sites.points[at]));
    result.normals[k] = to_real<float>(sites.normals[at]);
    result.components[k] = c;
    result.spacing[k] = node_spacing(cube, shares[c], sites.density[at]);
    const auto way = [&](int from, int to) {
      return from < 0 || to < 0 ? Vec3d{0, 0, 0}
                                : normalized(sites.points[to] - sites.points[from]);
    };
    const Vec3d in = way(before[at], at), out = way(at, features.next[at]);
    if (!(dot(in, out) > straight)) return;
    const Tangent_frame<double> frame(sites.normals[at]);
    const Vec3d along = in + out;
    result.is_directed[k] = 1;
    result.directions[k] = unit(sixth_power(
        unit({static_cast<float>(dot(along, frame.u)), static_cast<float>(dot(along, frame.v))})));
  });
  return result;
}

/// `cube`: around the surface; `tree`: of its facets; `component`: of each facet.
inline Lattice_plan lattice_plan(const Surface& surface, const Surface_cube& cube,
                                 const Facet_tree& tree, const Feature_samples& features,
                                 const std::vector<int>& component,
                                 const std::vector<Component_share>& shares, std::uint64_t seed,
                                 internal::Concurrency concurrency)
{
  std::size_t samples = 0;
  for (const Component_share& share : shares) samples += share.samples;
  const double most = nodes_per_lattice_point * static_cast<double>(samples);
  if (most + static_cast<double>(features.sites.size()) >= Lattice_edge::none)
    throw Invalid_input_error(std::to_string(samples) +
                              " samples are more than a lattice can have: use another `sampling`");
  Lattice_plan plan{unroll_surface(surface, tree, component, shares, concurrency),
                    cube,
                    shares,
                    lattice_levels(samples),
                    {},
                    has_uniform_density(surface),
                    seed};
  std::vector<int> before(features.sites.size(), -1);
  for (std::size_t s = 0; s < before.size(); ++s)
    if (features.next[s] >= 0) before[features.next[s]] = static_cast<int>(s);
  for (std::size_t level = 0; level < plan.free.size(); ++level) // twice as far apart each
    plan.sites.push_back(lattice_sites(features, before, std::size_t(1) << level, cube, component,
                                       shares, concurrency));
  return plan;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_PLAN_LATTICE_H
