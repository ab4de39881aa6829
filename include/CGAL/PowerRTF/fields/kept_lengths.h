// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edge lengths near edges of the border that the result has as they are: triangles there are good
// only if the others have about the same lengths.
#ifndef CGAL_POWER_RTF_FIELDS_KEPT_LENGTHS_H
#define CGAL_POWER_RTF_FIELDS_KEPT_LENGTHS_H

#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/Edge_graph.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// By vertex: the length of the kept edge that it is on, at an end the mean of those there; 0: it
/// is on none.
inline std::vector<double> lengths_of_kept_edges(const Surface& surface)
{
  const Edge_graph graph(surface.kept_edges, surface.points.size());
  std::vector<char> is_end(surface.points.size(), 0);
  for (const int v : surface.kept_vertices) is_end[v] = 1;
  std::vector<double> result(surface.points.size(), 0);
  std::vector<int> inside; // vertices between the pieces of an edge
  for (const int v : surface.kept_vertices) {
    for (int e : graph.at(v)) {
      inside.clear();
      int u = graph.other_end(e, v);
      for (; !is_end[u]; u = graph.other_end(e, u)) {
        inside.push_back(u);
        e = graph.other_edge(e, u);
      }
      const double l = length(surface.points[u] - surface.points[v]);
      for (const int w : inside) result[w] = l;
      result[v] += l / graph.degree(v);
    }
  }
  return result;
}

/// Brings lengths near to those of the kept edges: from there they grow and shrink by no more than
/// the gradation.
class Kept_lengths {
public:
  /// `gradation`: 0: there is no limit.
  Kept_lengths(const Surface& surface, const Surface_edges& edges, double gradation,
               Concurrency concurrency)
      : m_edges(edges), m_gradation(gradation), m_concurrency(concurrency)
  {
    if (surface.kept_edges.empty()) return;
    m_own = m_least = lengths_of_kept_edges(surface);
    if (!(gradation > 0)) return;
    // What shrinks by no more than that grows by no more seen from above.
    const double above = 2 * *std::max_element(m_own.begin(), m_own.end());
    for (double& l : m_least) l = above - l;
    limit_growth(edges, gradation, m_least, concurrency);
    for (double& l : m_least) l = above - l;
  }

  /// `lengths`: by vertex. Their growth is limited everywhere.
  void apply(std::vector<double>& lengths) const
  {
    for (std::size_t v = 0; v < m_own.size(); ++v)
      lengths[v] = m_own[v] > 0 ? m_own[v] : (std::max)(lengths[v], m_least[v]);
    if (m_gradation > 0) limit_growth(m_edges, m_gradation, lengths, m_concurrency);
  }

private:
  const Surface_edges& m_edges;
  double m_gradation;
  Concurrency m_concurrency;
  std::vector<double> m_own, m_least; // by vertex: of the kept edges; not less than that
};

/// The edges of a surface that are not to be halved: kept ones, and those of facets that are low
/// over such an edge. These would become lower with each halving of their sides, but not shorter.
class Whole_edges {
public:
  explicit Whole_edges(const Surface& surface) : m_surface(surface), m_edges(surface.kept_edges) {}

  /// Whether the edge of halfedge `h` is one of them.
  bool contains(int h) const
  {
    return !m_edges.empty() && std::binary_search(m_edges.begin(), m_edges.end(), edge(h));
  }

  /// The facets all of whose edges are whole, but that are higher than `limit`, by facet.
  std::vector<int> high_facets(const std::vector<double>& limit) const
  {
    std::vector<int> result;
    for (int f = 0; f < static_cast<int>(limit.size()) && !m_edges.empty(); ++f)
      if (contains(3 * f) && contains(3 * f + 1) && contains(3 * f + 2) && !is_low(3 * f, limit) &&
          !is_low(3 * f + 1, limit) && !is_low(3 * f + 2, limit))
        result.push_back(f);
    return result;
  }

  /// Adds the edges of facets no higher over one of them than `limit`, by facet.
  void add_low_facets(const std::vector<double>& limit)
  {
    if (m_edges.empty()) return;
    std::vector<Edge> all = m_edges;
    for (int f = 0; f < static_cast<int>(limit.size()); ++f)
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        if (!contains(h) || !is_low(h, limit)) continue;
        for (int side = 3 * f; side < 3 * f + 3; ++side) all.push_back(edge(side));
      }
    sort_uniquely(all);
    m_edges.swap(all);
  }

private:
  /// Whether the facet of halfedge `h` is no higher over that than `limit`.
  bool is_low(int h, const std::vector<double>& limit) const
  {
    const auto [a, b] = edge(h);
    const double l = length(m_surface.points[b] - m_surface.points[a]);
    return 2 * m_surface.facet_areas[h / 3] <= limit[h / 3] * l;
  }

  Edge edge(int h) const
  {
    return sorted_edge(halfedge_source(m_surface.triangles, h),
                       halfedge_target(m_surface.triangles, h));
  }

  const Surface& m_surface;
  std::vector<Edge> m_edges; // sorted; none of them is halved
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_FIELDS_KEPT_LENGTHS_H
