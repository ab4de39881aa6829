// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The topology of triangles that are given as the stars of their vertices; whether it is that of a
// surface.
#ifndef CGAL_POWER_RTF_EXTRACTION_FAN_TOPOLOGY_H
#define CGAL_POWER_RTF_EXTRACTION_FAN_TOPOLOGY_H

#include <CGAL/PowerRTF/extraction/Fan.h>
#include <CGAL/PowerRTF/geometry/component_topology.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Of `vertices` vertices. `star(v)`: the triangles at v in their order around it, as
/// `sort_around()` makes it.
template <class Star_at>
Topology fan_topology(int vertices, const Star_at& star, Concurrency concurrency)
{
  Unset_vector<int> next_on_border(vertices), shares(vertices); // of six times the characteristics
  auto [component, components] =
      connected_components(concurrency, vertices, [&](int v, auto&& join) {
        const Fan s = star(v);
        for (const Fan_corner& c : s)
          if (c[0] < v) join(c[0]);
        if (!is_closed(s) && s.back()[1] < v) join(s.back()[1]);
        next_on_border[v] = is_closed(s) ? -1 : s.front()[0];
        shares[v] = six_times_vertex_share(!is_closed(s)) + // and a third of each facet
                    six_times_facet_share / 3 * static_cast<int>(s.size());
      });
  std::vector<long> characteristics(components, 0); // six times
  const auto component_at = [&, &of = component](int v) { return of[v]; };
  add_by_component(
      concurrency, vertices, component_at, [&](int v) { return shares[v]; }, characteristics);
  std::vector<Component_topology> topologies = component_topologies(
      characteristics, count_loops(std::move(next_on_border), components, component_at));
  return {std::move(component), std::move(topologies)};
}

/// Whether each component of `surface` has one of `stars` on it with the same Euler characteristic
/// and as many border loops, and none besides. `facets`: where the vertices lie.
inline bool are_homeomorphic(const Topology& surface, const Topology& stars,
                             const std::vector<int>& facets, Concurrency concurrency)
{
  if (surface.size() != stars.size()) return false;
  std::vector<int> partner(stars.size(), -1); // that a vertex has found
  const int astray = reduce(
      concurrency, static_cast<int>(stars.component.size()), 0,
      [&](int& sum, int v) {
        int* const own = &partner[stars.component[v]];
        const int its = surface.component[facets[v]];
        int found = atomic_load(own);
        if (found < 0) found = atomic_exchange_if(own, -1, its);
        sum += found >= 0 && found != its;
      },
      [](int& sum, int part) { sum += part; });
  if (astray > 0) return false;
  std::vector<char> is_taken(surface.size(), 0);
  for (int c = 0; c < stars.size(); ++c) {
    if (partner[c] < 0 || std::exchange(is_taken[partner[c]], 1)) return false;
    if (!(stars.components[c] == surface.components[partner[c]])) return false;
  }
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_FAN_TOPOLOGY_H
