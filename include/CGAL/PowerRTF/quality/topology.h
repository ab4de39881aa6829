// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Combinatorics of a triangle soup: counts, Euler characteristic, borders, defects. Works for any
// soup, manifold or not.
#ifndef CGAL_POWER_RTF_QUALITY_TOPOLOGY_H
#define CGAL_POWER_RTF_QUALITY_TOPOLOGY_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/engines/oriented_topology.h>
#include <CGAL/PowerRTF/geometry/component_topology.h>
#include <CGAL/PowerRTF/geometry/degenerate_facets.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/vertex_corners.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/label_trees.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// Triangles with three vertices each, and the halfedges across their edges.
class Soup_edges {
public:
  enum : int { border = Facet_adjacency::none, non_manifold = -2 };

  Soup_edges(const std::vector<Triangle>& triangles, const Facet_adjacency& adjacency)
      : m_triangles(triangles), m_opposite(adjacency.opposite.data())
  {
    if (adjacency.non_manifold_edges > 0) mark_non_manifold(adjacency.opposite);
  }

  int opposite(int h) const { return m_opposite[h]; }

  /// Turns around `v` from facet to facet, starting in the facet of `h` and leaving it through its
  /// other edge at `v`; returns the edge where the turn ends: a border or non-manifold edge, or `h`
  /// after a full turn. Counts the facets. Needs no orientation.
  int turn(int v, int h, int& facets) const
  {
    for (int e = h;;) {
      ++facets;
      e = halfedge_target(m_triangles, e) == v ? next_halfedge(e) : previous_halfedge(e);
      if (m_opposite[e] < 0) return e;
      e = m_opposite[e];
      if (e == h) return h;
    }
  }

private:
  void mark_non_manifold(const std::vector<int>& opposite)
  {
    m_marked = opposite;
    m_opposite = m_marked.data();
    std::vector<std::pair<Edge, int>> single; // at edges of one facet, or of more than two
    for (int h = 0; h < static_cast<int>(opposite.size()); ++h)
      if (opposite[h] == Facet_adjacency::none)
        single.emplace_back(
            sorted_edge(halfedge_source(m_triangles, h), halfedge_target(m_triangles, h)), h);
    std::sort(single.begin(), single.end());
    for (std::size_t k = 1; k < single.size(); ++k)
      if (single[k].first == single[k - 1].first)
        m_marked[single[k].second] = m_marked[single[k - 1].second] = non_manifold;
  }

  const std::vector<Triangle>& m_triangles;
  std::vector<int> m_marked;
  const int* m_opposite;
};

/// Of a soup with non-manifold edges: its sheets and where they meet.
inline void set_network_topology(const std::vector<Triangle>& triangles,
                                 const Facet_adjacency& adjacency, Topology_statistics& result)
{
  // The sheets' vertices are fans of corners, joined across edges of two facets.
  const int halfedges = static_cast<int>(3 * triangles.size());
  std::vector<int> fan(halfedges);
  std::iota(fan.begin(), fan.end(), 0);
  std::vector<std::pair<Edge, int>> open; // edges of one facet, or of more than two
  long edges = 0;
  for (int h = 0; h < halfedges; ++h) {
    const int o = adjacency.opposite[h];
    edges += o < h; // once for each facet where there is no opposite
    const int a = halfedge_source(triangles, h), b = halfedge_target(triangles, h);
    if (o == Facet_adjacency::none) open.emplace_back(sorted_edge(a, b), h);
    if (o < h) continue;
    const bool is_turned = halfedge_source(triangles, o) != a;
    join_trees(fan.data(), h, is_turned ? next_halfedge(o) : o);
    join_trees(fan.data(), next_halfedge(h), is_turned ? o : next_halfedge(o));
  }
  long fans = 0;
  for (int c = 0; c < halfedges; ++c) fans += fan[c] == c;
  result.sheets = facet_components(adjacency).second;
  result.sheets_characteristic = fans - edges + static_cast<long>(triangles.size());

  std::sort(open.begin(), open.end());
  std::map<std::pair<int, std::size_t>, int> at; // vertex, number of facets -> an edge there
  std::vector<int> part;                         // of non-manifold edges
  for (auto first = open.begin(); first != open.end();) {
    const auto last =
        std::find_if(first, open.end(), [&](const auto& x) { return x.first != first->first; });
    const std::size_t facets = last - first;
    if (facets > 2) {
      const int e = static_cast<int>(part.size());
      part.push_back(e);
      for (const int v : first->first) {
        const auto [found, is_new] = at.insert({{v, facets}, e});
        if (!is_new) join_trees(part.data(), found->second, e);
      }
    }
    first = last;
  }
  for (std::size_t e = 0; e < part.size(); ++e) result.junctions += part[e] == static_cast<int>(e);
}

/// That of any triangles with three vertices each, which are in [0, size).
inline Topology_statistics soup_topology(const std::vector<Triangle>& triangles, int size,
                                         Concurrency concurrency)
{
  Topology_statistics result;
  result.faces = triangles.size();
  const Facet_adjacency adjacency = facet_adjacency(triangles, size, concurrency);
  const Soup_edges edges(triangles, adjacency);
  result.border_edges = adjacency.border_edges;
  result.non_manifold_edges = adjacency.non_manifold_edges;
  result.edges = result.border_edges + result.non_manifold_edges;
  result.oriented = !adjacency.same_direction && result.non_manifold_edges == 0;

  const int halfedges = static_cast<int>(adjacency.opposite.size());
  std::vector<int> component(size), loop(result.border_edges > 0 ? halfedges : 0); // label trees
  std::vector<int> corner(size, -1), degree(size), bad(size); // a halfedge from each vertex
  std::iota(component.begin(), component.end(), 0);
  std::iota(loop.begin(), loop.end(), 0);
  for_each_index(concurrency, halfedges, [&](int h) {
    const int a = halfedge_source(triangles, h), b = halfedge_target(triangles, h);
    atomic_store(&corner[a], h);
    atomic_add(&degree[a], 1);
    join_trees(component.data(), a, b);
    if (edges.opposite(h) == Soup_edges::non_manifold)
      for (const int v : {a, b}) atomic_store(&bad[v], 1);
    if (edges.opposite(h) != Soup_edges::border) return;
    for (const int v : {a, b}) {
      int facets = 0;
      const int next = edges.turn(v, h, facets);
      if (edges.opposite(next) == Soup_edges::border) join_trees(loop.data(), h, next);
    }
  });
  const auto is_bad = [&](int v) {
    if (bad[v]) return true;
    // one way from the first facet; the other way too when that ended at a border
    int facets = 0, rest = 0;
    const int stop = edges.turn(v, corner[v], facets);
    if (stop != corner[v] && edges.opposite(corner[v]) >= 0)
      edges.turn(v, edges.opposite(corner[v]), rest);
    return facets + rest != degree[v];
  };
  const auto count = [&](int n, const auto& is_counted) {
    return reduce(
        concurrency, n, std::size_t(0), [&](std::size_t& sum, int i) { sum += is_counted(i); },
        [](std::size_t& sum, std::size_t part) { sum += part; });
  };
  result.edges += count(halfedges, [&](int h) { return edges.opposite(h) > h; });
  result.border_loops = count(
      halfedges, [&](int h) { return edges.opposite(h) == Soup_edges::border && loop[h] == h; });
  const auto is_used = [&](int v) { return corner[v] >= 0; };
  result.vertices = count(size, is_used);
  result.components = count(size, [&](int v) { return is_used(v) && component[v] == v; });
  result.non_manifold_vertices = count(size, [&](int v) { return is_used(v) && is_bad(v); });
  result.euler_characteristic = static_cast<long>(result.vertices) -
                                static_cast<long>(result.edges) + static_cast<long>(result.faces);
  if (result.non_manifold_edges > 0) set_network_topology(triangles, adjacency, result);
  return result;
}

/// As `Resident_mesh::topology()`, on the host.
inline std::optional<Topology_statistics> oriented_topology(const std::vector<Triangle>& triangles,
                                                            int vertices, Concurrency concurrency,
                                                            Triangle_links* links = nullptr)
{
  return with_host_backend(concurrency, [&](auto backend) {
    return oriented_topology(backend, vertices, static_cast<int>(triangles.size()),
                             triangles.empty() ? nullptr : triangles.data()->data(), links);
  });
}

} // namespace internal

/// Topology of the soup `triangles` (#F vertex indices >= 0). `vertices` counts the used ones. A
/// vertex is non-manifold when its facets do not form one fan or one disk. A facet with a repeated
/// vertex is counted in `faces` and otherwise ignored. `there`: where an engine has them, or null.
inline Topology_statistics topology(const std::vector<Triangle>& triangles,
                                    internal::Concurrency concurrency = Sequential_tag(),
                                    Resident_mesh* there = nullptr)
{
  if (there)
    if (const auto found = there->topology(nullptr)) return *found;
  const int size = vertex_range(triangles, concurrency);
  if (const auto found = internal::oriented_topology(triangles, size, concurrency)) return *found;
  const auto is_collapsed = [&](int f) { return internal::is_collapsed(triangles[f]); };
  if (internal::select(concurrency, static_cast<int>(triangles.size()), is_collapsed).empty())
    return internal::soup_topology(triangles, size, concurrency);
  std::vector<Triangle> others = triangles;
  const auto collapsed = static_cast<long>(internal::drop_collapsed(others));
  Topology_statistics result = topology(others, concurrency);
  result.faces += collapsed;
  result.euler_characteristic += collapsed;
  return result;
}

namespace internal {

/// That of a surface, which is a 2-manifold: only components and borders are left to be counted.
inline Topology_statistics manifold_topology(const Surface& surface,
                                             Concurrency concurrency = Sequential_tag())
{
  if (surface.is_closed_up()) // its borders may have no direction
    return PowerRTF::topology(surface.triangles, concurrency);
  const auto topology = known_topology(surface, concurrency);
  Topology_statistics result;
  result.vertices = surface.points.size();
  result.faces = surface.triangles.size();
  result.components = topology->components.size();
  result.border_edges = surface.adjacency.border_edges;
  result.edges = (3 * result.faces + result.border_edges) / 2;
  for (const Component_topology& c : topology->components) {
    result.border_loops += c.border_loops;
    result.euler_characteristic += c.euler_characteristic;
  }
  return result;
}

} // namespace internal
} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_QUALITY_TOPOLOGY_H
