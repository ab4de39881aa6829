// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The topology of triangles that are an oriented 2-manifold, as nearly all results are: what is at
// a vertex tells all of it, so no list of edges is needed.
#ifndef CGAL_POWER_RTF_QUALITY_ORIENTED_TOPOLOGY_H
#define CGAL_POWER_RTF_QUALITY_ORIENTED_TOPOLOGY_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/vertex_corners.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/label_trees.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The facets around a vertex, by their edges that leave it.
class Vertex_fan {
public:
  static constexpr int most_facets = 64; ///< more are left to others

  /// `corners`: all `n` > 0 at `v`.
  Vertex_fan(const std::vector<Triangle>& triangles, int v, const int* corners, int n) : m_size(n)
  {
    if (n > most_facets) return;
    int before[most_facets]; // the vertices where edges come from
    for (int k = 0; k < n; ++k) {
      m_next[k] = halfedge_target(triangles, corners[k]);
      before[k] = halfedge_source(triangles, previous_halfedge(corners[k]));
      if (m_next[k] == v) return; // a collapsed facet
    }
    m_is_single = is_chain(before);
  }

  /// Whether the facets make one disk or, at a border, one fan, and agree in their orientations.
  bool is_single() const { return m_is_single; }
  /// The vertex to which the edge number k leads.
  int next(int k) const { return m_next[k]; }
  /// The edge that is on the border, or -1.
  int border() const { return m_border; }

private:
  bool is_chain(const int* before)
  {
    int after[most_facets];         // of each facet the next one
    bool has_before[most_facets]{}; // another facet
    int links = 0;
    for (int k = 0; k < m_size; ++k) {
      after[k] = -1;
      for (int l = 0; l < m_size; ++l) {
        if (m_next[l] != before[k]) continue;
        if (after[k] >= 0 || has_before[l]) return false; // an edge is there twice
        after[k] = l;
        has_before[l] = true;
        ++links;
      }
    }
    if (links < m_size - 1) return false;
    if (links < m_size)
      for (m_border = 0; has_before[m_border];) ++m_border;
    const int first = m_border < 0 ? 0 : m_border;
    int count = 1;
    for (int k = after[first]; k >= 0 && k != first; k = after[k]) ++count;
    return count == m_size;
  }

  int m_size, m_border = -1;
  bool m_is_single = false;
  int m_next[most_facets];
};

/// What is counted of an oriented 2-manifold with so many faces.
/// \param is_used function vertex -> whether it has a face
/// \param component label trees of the vertices, joined along all edges
/// \param next_on_border by vertex; -1: it is not on a border
template <class Is_used>
Topology_statistics manifold_statistics(Concurrency concurrency, std::size_t faces,
                                        const Is_used& is_used, const Unset_vector<int>& component,
                                        const Unset_vector<int>& next_on_border)
{
  const int vertices = static_cast<int>(component.size());
  const auto count = [&](const auto& is_counted) {
    return reduce(
        concurrency, vertices, std::size_t(0),
        [&](std::size_t& sum, int v) { sum += is_counted(v); },
        [](std::size_t& sum, std::size_t part) { sum += part; });
  };
  Topology_statistics result;
  result.faces = faces;
  result.vertices = count(is_used);
  result.components = count([&](int v) { return is_used(v) && component[v] == v; });
  result.border_edges = count([&](int v) { return next_on_border[v] >= 0; });
  result.edges = (3 * faces + result.border_edges) / 2;
  result.euler_characteristic = static_cast<long>(result.vertices) -
                                static_cast<long>(result.edges) + static_cast<long>(faces);
  if (result.border_edges == 0) return result;
  Unset_vector<int> loop(vertices); // label trees
  for_each_index(concurrency, vertices, [&](int v) { loop[v] = v; });
  for_each_index(concurrency, vertices, [&](int v) {
    if (next_on_border[v] >= 0) join_trees(loop.data(), v, next_on_border[v]);
  });
  result.border_loops = count([&](int v) { return next_on_border[v] >= 0 && loop[v] == v; });
  return result;
}

/// The topology of triangles with vertices in [0, vertices) if they are an oriented 2-manifold
/// without a vertex of very many facets.
inline std::optional<Topology_statistics> oriented_topology(const std::vector<Triangle>& triangles,
                                                            int vertices, Concurrency concurrency)
{
  const Buckets<int> corners = vertex_corners(triangles, vertices, concurrency);
  Unset_vector<int> component(vertices), next_on_border(vertices);
  for_each_index(concurrency, vertices, [&](int v) { component[v] = v; });
  const auto degree = [&](int v) { return corners.first[v + 1] - corners.first[v]; };
  const auto has_defect = [&](int v) {
    next_on_border[v] = -1;
    const int n = degree(v);
    if (n == 0) return false;
    const Vertex_fan fan(triangles, v, &corners.entries[corners.first[v]], n);
    if (!fan.is_single()) return true;
    for (int k = 0; k < n; ++k) // each edge once
      if (fan.next(k) < v || k == fan.border()) join_trees(component.data(), v, fan.next(k));
    if (fan.border() >= 0) next_on_border[v] = fan.next(fan.border());
    return false;
  };
  const int defects = reduce(
      concurrency, vertices, 0, [&](int& sum, int v) { sum += has_defect(v); },
      [](int& sum, int part) { sum += part; });
  if (defects > 0) return std::nullopt;
  return manifold_statistics(
      concurrency, triangles.size(), [&](int v) { return degree(v) > 0; }, component,
      next_on_border);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_QUALITY_ORIENTED_TOPOLOGY_H
