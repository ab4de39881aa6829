// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many samples the topology of a surface needs at least, component by component: an edge joins
// two vertices once, so few vertices allow only few edges (Heawood 1890, with borders).
#ifndef CGAL_POWER_RTF_FEATURES_TOPOLOGY_MINIMUM_H
#define CGAL_POWER_RTF_FEATURES_TOPOLOGY_MINIMUM_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace CGAL::PowerRTF {

/// No triangulation of a surface with that Euler characteristic and that many border loops has
/// fewer vertices. 4 for a sphere, 7 for a torus, 3 for a disk, 6 for an annulus.
inline std::size_t least_vertices(long euler_characteristic, std::size_t border_loops)
{
  // 3 F + B = 2 E for F facets, E edges and B border edges. Hence E = 3 (V - chi) - B, at most
  // V (V - 1) / 2; every loop has at least 3 border edges, all together at most V.
  long v = (std::max)(border_loops > 0 ? 3L : 4L, 3 * static_cast<long>(border_loops));
  while (v * (v - 1) / 2 < 3 * (v - euler_characteristic) - (border_loops > 0 ? v : 0)) ++v;
  return static_cast<std::size_t>(v);
}

/// What one component is, up to homeomorphism.
struct Component_topology {
  int vertex = -1; ///< one of its vertices
  long euler_characteristic = 0;
  std::size_t border_loops = 0;

  std::size_t least_samples() const { return least_vertices(euler_characteristic, border_loops); }
};

/// Of each component, numbered as by `facet_components()`.
inline std::vector<Component_topology> component_topologies(const Surface& surface)
{
  const auto& triangles = surface.triangles;
  const Facet_adjacency& adjacency = surface.adjacency;
  const std::size_t number_of_vertices = surface.points.size();
  const auto [component, components] = facet_components(adjacency);
  std::vector<Component_topology> result(components);
  std::vector<int> of_vertex(number_of_vertices, -1), next_on_border(number_of_vertices, -1);
  for (int h = 0; h < static_cast<int>(adjacency.opposite.size()); ++h) {
    const int v = halfedge_source(triangles, h), o = adjacency.opposite[h];
    Component_topology& c = result[component[h / 3]];
    c.euler_characteristic += h % 3 == 0; // facets less edges plus vertices
    c.euler_characteristic -= o < h;
    if (of_vertex[v] < 0) ++c.euler_characteristic;
    of_vertex[v] = component[h / 3];
    c.vertex = v;
    if (o == Facet_adjacency::none) next_on_border[v] = halfedge_target(triangles, h);
  }
  for (std::size_t start = 0; start < number_of_vertices; ++start) {
    if (next_on_border[start] < 0) continue;
    ++result[of_vertex[start]].border_loops;
    for (int v = static_cast<int>(start); next_on_border[v] >= 0;) {
      const int next = next_on_border[v];
      next_on_border[v] = -1;
      v = next;
    }
  }
  return result;
}

/// \throws Invalid_input_error if `n` vertices cannot have the topology of `surface`; it names the
///   component that needs most
inline void require_enough_samples(const Surface& surface, std::size_t n)
{
  const std::vector<Component_topology> components = component_topologies(surface);
  std::size_t sum = 0;
  for (const Component_topology& c : components) sum += c.least_samples();
  if (n >= sum) return;
  const auto most = std::max_element(components.begin(), components.end(),
                                     [](const Component_topology& a, const Component_topology& b) {
                                       return a.least_samples() < b.least_samples();
                                     });
  const long handles = (2 - most->euler_characteristic - static_cast<long>(most->border_loops)) / 2;
  throw Invalid_input_error(
      std::to_string(n) + " samples are too few for the topology of the surface: at least " +
      std::to_string(sum) + " are needed" +
      (components.size() == 1
           ? std::string()
           : " for its " + std::to_string(components.size()) + " components, " +
                 std::to_string(most->least_samples()) + " of them for the one at vertex " +
                 std::to_string(surface.input_vertices[most->vertex])) +
      " (of genus " + std::to_string(handles) + " with " + std::to_string(most->border_loops) +
      " border loops)");
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_TOPOLOGY_MINIMUM_H
