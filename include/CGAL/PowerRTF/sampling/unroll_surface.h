// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a surface is unrolled for stratified points.
#ifndef CGAL_POWER_RTF_SAMPLING_UNROLL_SURFACE_H
#define CGAL_POWER_RTF_SAMPLING_UNROLL_SURFACE_H

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/box_around.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/order_by_key.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/sampling/Surface_strata.h>
#include <CGAL/PowerRTF/sampling/component_shares.h>
#include <CGAL/PowerRTF/sampling/initial_sampling.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL::PowerRTF {

inline Surface_cube cube_around(const Surface& surface, internal::Concurrency concurrency)
{
  return cube_around(
      internal::box_around(concurrency, static_cast<int>(surface.points.size()), surface.points));
}

namespace internal {

/// The facets of components with samples: component by component, each in the order of the tree.
inline std::vector<int> unrolled_facets(const Facet_tree& tree, const std::vector<int>& component,
                                        const std::vector<Component_share>& shares,
                                        Concurrency concurrency)
{
  std::vector<int> facets = select(concurrency, static_cast<int>(component.size()), [&](int place) {
    return shares[component[tree.order()[place]]].samples > 0;
  });
  const int size = static_cast<int>(facets.size());
  for_each_index(concurrency, size, [&](int k) { facets[k] = tree.order()[facets[k]]; });
  if (shares.size() == 1) return facets;
  const std::vector<int> before = facets;
  order_by_key(
      concurrency, size, [&](int k) { return std::uint64_t(component[before[k]]) << 32; },
      facets.data());
  for_each_index(concurrency, size, [&](int k) { facets[k] = before[facets[k]]; });
  return facets;
}

inline int longest_edge(const Surface& surface, int f)
{
  const Triangle& t = surface.triangles[f];
  const auto& p = surface.points;
  int longest = 0;
  double length_2 = 0;
  constexpr double clearly = 1 + 1e-9; // rounding must not decide between equal edges
  for (int i = 0; i < 3; ++i) {
    const double l = squared_length(p[t[(i + 1) % 3]] - p[t[i]]);
    if (l > clearly * length_2) longest = i, length_2 = l;
  }
  return longest;
}

} // namespace internal

/// Unrolls a surface. The mass of a component, over all parts of it, is its number of samples,
/// spread like the density.
/// \param tree its places are the facets' numbers in the result
/// \param component of each facet
inline Surface_strata unroll_surface(const Surface& surface, const Facet_tree& tree,
                                     const std::vector<int>& component,
                                     const std::vector<Component_share>& shares,
                                     internal::Concurrency concurrency)
{
  const std::vector<int> facets = internal::unrolled_facets(tree, component, shares, concurrency);
  const int size = static_cast<int>(facets.size());
  Surface_strata strata;
  strata.bases.resize(size);
  strata.components.resize(size);
  strata.sums.resize(size + 1);
  strata.sums[size] = 0;
  internal::for_each_index(concurrency, size, [&](int k) {
    const int f = facets[k], c = component[f];
    strata.bases[k] = 3 * tree.place(f) + internal::longest_edge(surface, f);
    strata.components[k] = c;
    const double per_mass = static_cast<double>(shares[c].samples) / shares[c].mass;
    strata.sums[k] = per_mass * internal::density_mass(surface, f);
  });
  internal::exclusive_scan(concurrency, size + 1, strata.sums.data());
  return strata;
}

/// A random point in each of as many parts of equal mass as there are samples.
template <class Backend>
Samples stratified_samples(Backend& backend, const Surface& surface, const Facet_tree& tree,
                           const std::vector<int>& component,
                           const std::vector<Component_share>& shares, std::uint64_t seed)
{
  const Surface_strata strata =
      unroll_surface(surface, tree, component, shares, backend.concurrency());
  const Strata_view view = strata.view();
  const auto densities = [&](int place) {
    const Triangle& t = surface.triangles[tree.order()[place]];
    const auto& rho = surface.vertex_density;
    return Vec3d{rho[t[0]], rho[t[1]], rho[t[2]]};
  };
  const int n = static_cast<int>(std::lround(view.mass()));
  internal::Unset_vector<Facet_place> places(n);
  backend.for_each(n, [&](int i) {
    const auto [at, w] = view.point(i, n, seed, densities);
    places[i] = {tree.order()[view.facet(at)], {w.x, w.y, w.z}};
  });
  Samples samples;
  internal::add_samples(surface, places, samples, backend.concurrency());
  return samples;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_UNROLL_SURFACE_H
