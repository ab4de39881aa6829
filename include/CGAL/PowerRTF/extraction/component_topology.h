// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Euler characteristic and border loops of each component, of a surface and of triangles that are
// given as the stars of their vertices; whether the two are the same.
#ifndef CGAL_POWER_RTF_EXTRACTION_COMPONENT_TOPOLOGY_H
#define CGAL_POWER_RTF_EXTRACTION_COMPONENT_TOPOLOGY_H

#include <CGAL/PowerRTF/extraction/Fan.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/optimization/component_trees.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Of an oriented 2-manifold.
struct Component_topology {
  std::vector<int> component; ///< of each facet, or of each vertex
  /// By component, six times: a sum over vertices and facets of whole numbers.
  std::vector<long> six_euler_characteristics;
  std::vector<long> border_loops; ///< by component

  int size() const { return static_cast<int>(border_loops.size()); }
};

/// The components of `n` items, numbered by their first ones. `for_each_linked(i, f)` calls `f(j)`
/// for the items that hang together with `i`.
/// \returns the component of each item, and their number
template <class ConcurrencyTag, class F>
std::pair<std::vector<int>, int> linked_components(int n, F&& for_each_linked)
{
  std::vector<int> label(n), number(n);
  for_each_index<ConcurrencyTag>(n, [&](int i) { label[i] = i; });
  for_each_index<ConcurrencyTag>(
      n, [&](int i) { for_each_linked(i, [&](int j) { join_trees(label.data(), i, j); }); });
  int components = 0;
  for (int i = 0; i < n; ++i)
    if (label[i] == i) number[i] = components++;
  std::vector<int> result(n);
  for_each_index<ConcurrencyTag>(n, [&](int i) { result[i] = number[root_of(label.data(), i)]; });
  return {std::move(result), components};
}

/// Adds `f(i)` to `sums[component(i)]` for i in [0, n); none for a negative component.
template <class ConcurrencyTag, class Component, class F>
void add_by_component(int n, Component&& component, F&& f, std::vector<long>& sums)
{
  constexpr int chunk = 1024;
  std::vector<std::vector<std::pair<int, long>>> parts((n + chunk - 1) / chunk);
  for_each_chunk<ConcurrencyTag>(n, chunk, [&](int begin, int end) {
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
std::vector<long> count_loops(std::vector<int> next, int components, Component&& component)
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

template <class ConcurrencyTag>
Component_topology surface_topology(const Surface& surface)
{
  const int facets = static_cast<int>(surface.triangles.size()),
            vertices = static_cast<int>(surface.points.size());
  const std::vector<int>& opposite = surface.adjacency.opposite;
  Component_topology result;
  auto components = linked_components<ConcurrencyTag>(facets, [&](int f, auto&& join) {
    for (int h = 3 * f; h < 3 * f + 3; ++h)
      if (opposite[h] >= 0 && opposite[h] < h) join(opposite[h] / 3);
  });
  result.component = std::move(components.first);
  result.six_euler_characteristics.assign(components.second, 0);
  std::vector<int> facet_at(vertices, -1), next(vertices, -1);
  for_each_index<ConcurrencyTag>(facets, [&](int f) {
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      const int v = halfedge_source(surface.triangles, h);
      atomic_store(&facet_at[v], f); // any of one component
      if (opposite[h] == Facet_adjacency::none) next[v] = halfedge_target(surface.triangles, h);
    }
  });
  const auto component_at = [&](int v) {
    return facet_at[v] < 0 ? -1 : result.component[facet_at[v]];
  };
  // V - E + F with E = (3 F + B) / 2, B the edges of the border.
  add_by_component<ConcurrencyTag>(
      vertices, component_at, [&](int v) { return next[v] < 0 ? 6 : 3; },
      result.six_euler_characteristics);
  add_by_component<ConcurrencyTag>(
      facets, [&](int f) { return result.component[f]; }, [](int) { return -3; },
      result.six_euler_characteristics);
  result.border_loops = count_loops(std::move(next), components.second, component_at);
  return result;
}

/// `star(v)`: the triangles at vertex v in their order around it, as `sort_around()` makes it.
template <class ConcurrencyTag, class Star_at>
Component_topology fan_topology(int vertices, const Star_at& star)
{
  Component_topology result;
  std::vector<int> next(vertices, -1);
  auto components = linked_components<ConcurrencyTag>(vertices, [&](int v, auto&& join) {
    const Fan s = star(v);
    for (const Fan_corner& c : s)
      for (const int w : c)
        if (w < v) join(w);
    if (!is_closed(s)) next[v] = s.front()[0];
  });
  result.component = std::move(components.first);
  result.six_euler_characteristics.assign(components.second, 0);
  const auto component_at = [&](int v) { return result.component[v]; };
  add_by_component<ConcurrencyTag>(
      vertices, component_at,
      [&](int v) { return (next[v] < 0 ? 6 : 3) - static_cast<long>(star(v).size()); },
      result.six_euler_characteristics);
  result.border_loops = count_loops(std::move(next), components.second, component_at);
  return result;
}

/// Whether each component of `surface` has one of `stars` on it with the same Euler characteristic
/// and as many border loops, and none besides. `facets`: where the vertices lie.
inline bool are_homeomorphic(const Component_topology& surface, const Component_topology& stars,
                             const std::vector<int>& facets)
{
  if (surface.size() != stars.size()) return false;
  std::vector<int> partner(stars.size(), -1), partner_of_surface(stars.size(), -1);
  for (std::size_t v = 0; v < stars.component.size(); ++v) {
    const int own = stars.component[v], its = surface.component[facets[v]];
    if (partner[own] < 0 && partner_of_surface[its] < 0) {
      partner[own] = its;
      partner_of_surface[its] = own;
    }
    if (partner[own] != its || partner_of_surface[its] != own) return false;
  }
  for (int c = 0; c < stars.size(); ++c)
    if (partner[c] < 0 ||
        stars.six_euler_characteristics[c] != surface.six_euler_characteristics[partner[c]] ||
        stars.border_loops[c] != surface.border_loops[partner[c]])
      return false;
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_COMPONENT_TOPOLOGY_H
