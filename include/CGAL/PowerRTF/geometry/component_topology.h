// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Euler characteristic and border loops of each component of a surface, and how many samples they
// need at least: an edge joins two vertices once, so few vertices allow only few edges (Heawood
// 1890, with borders).
#ifndef CGAL_POWER_RTF_GEOMETRY_COMPONENT_TOPOLOGY_H
#define CGAL_POWER_RTF_GEOMETRY_COMPONENT_TOPOLOGY_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// No triangulation of a surface with that Euler characteristic and that many border loops has
/// fewer vertices. 4 for a sphere, 7 for a torus, 3 for a disk, 6 for an annulus.
inline std::size_t least_vertices(long euler_characteristic, long border_loops)
{
  // 3 F + B = 2 E for F facets, E edges and B border edges. Hence E = 3 (V - chi) - B, at most
  // V (V - 1) / 2; every loop has at least 3 border edges, all together at most V.
  long v = (std::max)(border_loops > 0 ? 3L : 4L, 3 * border_loops);
  while (v * (v - 1) / 2 < 3 * (v - euler_characteristic) - (border_loops > 0 ? v : 0)) ++v;
  return static_cast<std::size_t>(v);
}

/// What one component is, up to homeomorphism.
struct Component_topology {
  long euler_characteristic = 0;
  long border_loops = 0;

  std::size_t least_samples() const { return least_vertices(euler_characteristic, border_loops); }

  friend bool operator==(const Component_topology& a, const Component_topology& b)
  {
    return a.euler_characteristic == b.euler_characteristic && a.border_loops == b.border_loops;
  }
};

namespace internal {

/// Adds `f(i)` to `sums[component(i)]` for i in [0, n); none for a negative component.
template <class Component, class F>
void add_by_component(Concurrency concurrency, int n, Component&& component, F&& f,
                      std::vector<long>& sums)
{
  constexpr int chunk = 1024;
  std::vector<std::vector<std::pair<int, long>>> parts((n + chunk - 1) / chunk);
  for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
    auto& part = parts[begin / chunk];
    for (int i = begin; i < end; ++i) {
      const int c = component(i);
      if (c < 0) continue;
      if (part.empty() || part.back().first != c) part.emplace_back(c, 0);
      part.back().second += f(i);
    }
  });
  for (const auto& part : parts)
    for (const auto& [c, sum] : part) sums[c] += sum;
}

/// The loops of a border by component. `next`: of each vertex on it the following one; -1: none.
template <class Component>
std::vector<long> count_loops(Unset_vector<int> next, int components, Component&& component)
{
  std::vector<long> loops(components, 0);
  for (int v = 0; v < static_cast<int>(next.size()); ++v) {
    if (next[v] < 0) continue;
    ++loops[component(v)];
    for (int w = v; w >= 0; w = std::exchange(next[w], -1))
      ;
  }
  return loops;
}

/// Of V - E + F, six times what is a vertex's without its facets, and a facet's with its corners:
/// E = (3 F + B) / 2, where B edges, as many as vertices, are on the border.
inline int six_times_vertex_share(bool is_on_border) { return is_on_border ? 3 : 6; }
constexpr int six_times_facet_share = -3;

/// By component, from six times their Euler characteristics.
inline std::vector<Component_topology>
component_topologies(const std::vector<long>& characteristics,
                     const std::vector<long>& border_loops)
{
  std::vector<Component_topology> result;
  for (std::size_t c = 0; c < border_loops.size(); ++c)
    result.push_back({characteristics[c] / 6, border_loops[c]});
  return result;
}

} // namespace internal

/// Of each component, numbered as by `facet_components()`. Vertices without facets do not count.
inline std::vector<Component_topology>
component_topologies(const Surface& surface, const std::vector<int>& component, int components,
                     internal::Concurrency concurrency = Sequential_tag())
{
  const int facets = static_cast<int>(surface.triangles.size()),
            vertices = static_cast<int>(surface.points.size());
  const bool has_border = surface.adjacency.border_edges > 0;
  auto facet_at = internal::filled(concurrency, vertices, -1);
  auto next_on_border = internal::filled(concurrency, has_border ? vertices : 0, -1);
  internal::for_each_index(concurrency, facets, [&](int f) {
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      const int v = halfedge_source(surface.triangles, h);
      atomic_store(&facet_at[v], f); // any of one component
      if (surface.adjacency.opposite[h] == Facet_adjacency::none)
        next_on_border[v] = halfedge_target(surface.triangles, h);
    }
  });
  const auto component_at = [&](int v) { return facet_at[v] < 0 ? -1 : component[facet_at[v]]; };
  std::vector<long> characteristics(components, 0); // six times
  internal::add_by_component(
      concurrency, vertices, component_at,
      [&](int v) { return internal::six_times_vertex_share(has_border && next_on_border[v] >= 0); },
      characteristics);
  internal::add_by_component(
      concurrency, facets, [&](int f) { return component[f]; },
      [](int) { return internal::six_times_facet_share; }, characteristics);
  return internal::component_topologies(
      characteristics, internal::count_loops(std::move(next_on_border), components, component_at));
}

namespace internal {

/// The components of an oriented 2-manifold.
struct Topology {
  std::vector<int> component; ///< of each facet, or of each vertex
  std::vector<Component_topology> components;

  int size() const { return static_cast<int>(components.size()); }
};

/// `surface.topology`, or, where there is none, what it would be.
inline std::shared_ptr<const Topology> known_topology(const Surface& surface,
                                                      Concurrency concurrency)
{
  if (surface.topology.value) return surface.topology.value;
  auto [component, components] = facet_components(surface.adjacency, concurrency);
  std::vector<Component_topology> topologies =
      component_topologies(surface, component, components, concurrency);
  return std::make_shared<const Topology>(Topology{std::move(component), std::move(topologies)});
}

} // namespace internal

/// \throws Invalid_input_error if `n` vertices cannot have the topology of `surface`; it names the
///   component that needs most
inline void require_enough_samples(const Surface& surface, std::size_t n,
                                   internal::Concurrency concurrency = Sequential_tag())
{
  const auto topology = internal::known_topology(surface, concurrency);
  const std::vector<int>& component = topology->component;
  const std::vector<Component_topology>& components = topology->components;
  std::size_t sum = 0;
  for (const Component_topology& c : components) sum += c.least_samples();
  if (n >= sum) return;
  const auto most = std::max_element(components.begin(), components.end(),
                                     [](const Component_topology& a, const Component_topology& b) {
                                       return a.least_samples() < b.least_samples();
                                     });
  const auto facet =
      std::find(component.begin(), component.end(), most - components.begin()) - component.begin();
  const long handles = (2 - most->euler_characteristic - most->border_loops) / 2;
  throw Invalid_input_error(
      std::to_string(n) + " samples are too few for the topology of the surface: at least " +
      std::to_string(sum) + " are needed" +
      (components.size() == 1
           ? std::string()
           : " for its " + std::to_string(components.size()) + " components, " +
                 std::to_string(most->least_samples()) + " of them for the one at vertex " +
                 std::to_string(surface.input_vertices[surface.triangles[facet][0]])) +
      " (of genus " + std::to_string(handles) + " with " + std::to_string(most->border_loops) +
      " border loops)");
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_COMPONENT_TOPOLOGY_H
