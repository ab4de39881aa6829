// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the large flat faces of a mechanical part go over into round ones, without a crease:
// triangles across such a line would tilt a strip of the flat face.
#ifndef CGAL_POWER_RTF_FEATURES_FLAT_BOUNDARIES_H
#define CGAL_POWER_RTF_FEATURES_FLAT_BOUNDARIES_H

#include <CGAL/PowerRTF/features/flat_patches.h>
#include <CGAL/PowerRTF/geometry/Edge_graph.h>
#include <CGAL/PowerRTF/geometry/point_grid.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// Removes whole chains of edges that would make bad triangles beside other features.
class Chain_pruner {
public:
  /// \param features edges that stay; `candidates`: edges that may go
  Chain_pruner(const Surface& surface, const std::vector<Edge>& features,
               const std::vector<Edge>& candidates)
      : m_surface(surface), m_first(int(features.size()))
  {
    std::vector<Edge> edges = features;
    edges.insert(edges.end(), candidates.begin(), candidates.end());
    m_is_removed.assign(edges.size(), 0);
    m_graph = Edge_graph(std::move(edges), surface.points.size());
  }

  /// Chains that make an angle of less than 45 degrees with another feature.
  void remove_sharp()
  {
    constexpr double cos_sharp = 0.7071;
    const auto direction = [&](int e, int v) {
      return normalized(m_surface.points[m_graph.other_end(e, v)] - m_surface.points[v]);
    };
    for (int e = m_first; e < m_graph.size(); ++e)
      for (const int v : m_graph[e])
        for (const int other : m_graph.at(v))
          if (other != e && dot(direction(e, v), direction(other, v)) > cos_sharp) remove(e);
  }

  /// Chains that come nearer than `distance` to a feature without meeting it there.
  void remove_near(double distance)
  {
    std::vector<Vec3d> points; // along all edges
    std::vector<int> edges;    // of the points
    for (int e = 0; e < m_graph.size(); ++e) {
      const Vec3d &a = m_surface.points[m_graph[e][0]], &b = m_surface.points[m_graph[e][1]];
      const int pieces = 1 + int(4 * length(b - a) / distance);
      for (int k = 0; k < pieces; ++k) {
        points.push_back(a + (b - a) * ((k + 0.5) / pieces));
        edges.push_back(e);
      }
    }
    std::vector<int> all(points.size());
    std::iota(all.begin(), all.end(), 0);
    const Point_grid grid(points, all, distance);
    std::vector<int> near; // of the last edge
    for (std::size_t k = 0, last = points.size(); k < points.size(); ++k) {
      const int e = edges[k];
      if (e < m_first || m_is_removed[e]) continue;
      if (last == points.size() || edges[last] != e) near = edges_within(e, 3 * distance);
      last = k;
      grid.for_each_near(points[k], distance, [&](int j, double) {
        if (!m_is_removed[edges[j]] && !std::binary_search(near.begin(), near.end(), edges[j]))
          remove(e);
      });
    }
  }

  /// The candidates that are left.
  std::vector<Edge> rest() const
  {
    std::vector<Edge> rest;
    for (int e = m_first; e < m_graph.size(); ++e)
      if (!m_is_removed[e]) rest.push_back(m_graph[e]);
    return rest;
  }

private:
  /// The edge and all that its chain has.
  void remove(int e)
  {
    std::vector<int> chain;
    const auto add = [&](int f) {
      if (f < m_first || m_is_removed[f]) return;
      m_is_removed[f] = 1;
      chain.push_back(f);
    };
    add(e);
    for (std::size_t k = 0; k < chain.size(); ++k)
      for (const int v : m_graph[chain[k]])
        if (m_graph.degree(v) == 2)
          for (const int f : m_graph.at(v)) add(f);
  }

  /// The edges that begin at most `reach` away from the ends of `e` along features; sorted.
  std::vector<int> edges_within(int e, double reach) const
  {
    std::vector<int> found{e};
    std::vector<std::pair<int, double>> ends{{m_graph[e][0], 0}, {m_graph[e][1], 0}};
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const auto [v, passed] = ends[k];
      for (const int f : m_graph.at(v)) {
        if (std::find(found.begin(), found.end(), f) != found.end()) continue;
        found.push_back(f);
        const int u = m_graph.other_end(f, v);
        const double l = passed + length(m_surface.points[u] - m_surface.points[v]);
        if (l < reach) ends.emplace_back(u, l);
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  const Surface& m_surface;
  int m_first;        // of the candidates
  Edge_graph m_graph; // of the features, then the candidates
  std::vector<char> m_is_removed;
};

} // namespace internal

/// The edges between a flat patch that is wider than `3 h` and facets of narrower ones that are
/// turned by a degree or more; but no chain of them that would make bad triangles beside another
/// feature. \param creases edges, smaller vertex first, sorted; these are not among the result
/// \returns edges, smaller vertex first, sorted
inline std::vector<Edge> flat_patch_boundaries(const Surface& surface,
                                               const std::vector<Edge>& creases, double h)
{
  constexpr double cos_turned = 0.99985, wide = 3, nearest = 0.7;
  const auto& triangles = surface.triangles;
  const std::vector<int>& opposite = surface.adjacency.opposite;
  const Flat_patches patches(surface);
  std::vector<Edge> features = creases, edges;
  for (int e = 0; e < int(opposite.size()); ++e) {
    const int o = opposite[e];
    const Edge edge = sorted_edge(halfedge_source(triangles, e), halfedge_target(triangles, e));
    if (o == Facet_adjacency::none) {
      features.push_back(edge);
      continue;
    }
    if (patches.width(e / 3) > wide * h && !(patches.width(o / 3) > wide * h) &&
        dot(surface.facet_normals[e / 3], surface.facet_normals[o / 3]) < cos_turned &&
        !std::binary_search(creases.begin(), creases.end(), edge))
      edges.push_back(edge);
  }
  std::sort(edges.begin(), edges.end());
  if (edges.empty()) return edges;
  internal::Chain_pruner pruner(surface, features, edges);
  pruner.remove_sharp();
  pruner.remove_near(nearest * h);
  return pruner.rest();
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_FLAT_BOUNDARIES_H
