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
#include <utility>
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
inline std::vector<Component_topology>
component_topologies(const Surface& surface, const std::vector<int>& component, int components,
                     internal::Concurrency concurrency = Sequential_tag())
{
  const auto& triangles = surface.triangles;
  const std::vector<int>& opposite = surface.adjacency.opposite;
  const int halfedges = static_cast<int>(opposite.size());
  const int vertices = static_cast<int>(surface.points.size());
  std::vector<int> leaving(vertices, -1), next_on_border(vertices, -1); // any halfedge that does
  internal::for_each_index(concurrency, halfedges, [&](int h) {
    const int v = halfedge_source(triangles, h);
    atomic_store(&leaving[v], h);
    if (opposite[h] == Facet_adjacency::none) next_on_border[v] = halfedge_target(triangles, h);
  });
  std::vector<int> characteristic(components, 0);
  // Adds up `f(i)`, by `component_of(i)`.
  const auto add_up = [&](int n, const auto& component_of, const auto& f) {
    internal::for_each_chunk(concurrency, n, 4096, [&](int begin, int end) {
      int c = 0, sum = 0;
      for (int i = begin; i < end; ++i) {
        if (component_of(i) != c) atomic_add(&characteristic[c], std::exchange(sum, 0));
        c = component_of(i);
        sum += f(i);
      }
      atomic_add(&characteristic[c], sum);
    });
  };
  const auto of_vertex = [&](int v) { return leaving[v] < 0 ? 0 : component[leaving[v] / 3]; };
  add_up(
      halfedges, [&](int h) { return component[h / 3]; },
      [&](int h) { return (h % 3 == 0) - (opposite[h] < h); }); // facets less edges
  add_up(vertices, of_vertex, [&](int v) { return leaving[v] >= 0; });

  std::vector<Component_topology> result(components);
  for (int f = static_cast<int>(triangles.size()) - 1; f >= 0; --f)
    result[component[f]].vertex = triangles[f][0];
  for (int c = 0; c < components; ++c) result[c].euler_characteristic = characteristic[c];
  for (const int start :
       internal::select(concurrency, vertices, [&](int v) { return next_on_border[v] >= 0; })) {
    if (next_on_border[start] < 0) continue; // seen
    ++result[of_vertex(start)].border_loops;
    for (int v = start; next_on_border[v] >= 0;) v = std::exchange(next_on_border[v], -1);
  }
  return result;
}

/// \throws Invalid_input_error if `n` vertices cannot have the topology of `surface`; it names the
///   component that needs most
inline void require_enough_samples(const Surface& surface, std::size_t n,
                                   internal::Concurrency concurrency = Sequential_tag())
{
  const auto [component, count] = facet_components(surface.adjacency, concurrency);
  const std::vector<Component_topology> components =
      component_topologies(surface, component, count, concurrency);
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
