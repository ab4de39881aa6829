// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_EDGE_GRAPH_H
#define CGAL_POWER_RTF_GEOMETRY_EDGE_GRAPH_H

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A graph of some edges of a surface, by vertex.
class Edge_graph {
public:
  Edge_graph() = default;
  Edge_graph(std::vector<Edge> edges, std::size_t vertices)
      : m_edges(std::move(edges)), m_at(vertices)
  {
    for (int e = 0; e < size(); ++e)
      for (const int v : m_edges[e]) m_at[v].push_back(e);
  }

  int size() const { return static_cast<int>(m_edges.size()); }
  const Edge& operator[](int e) const { return m_edges[e]; }
  /// The edges at `v`, by increasing index.
  const std::vector<int>& at(int v) const { return m_at[v]; }
  int degree(int v) const { return static_cast<int>(m_at[v].size()); }
  int other_end(int e, int v) const { return m_edges[e][m_edges[e][0] == v]; }
  /// The edge at `v` beside `e`, where there are two.
  int other_edge(int e, int v) const { return m_at[v][m_at[v][0] == e]; }
  /// Takes `e` from the lists of its ends.
  void remove(int e)
  {
    for (const int v : m_edges[e]) m_at[v].erase(std::find(m_at[v].begin(), m_at[v].end(), e));
  }

private:
  std::vector<Edge> m_edges;
  std::vector<std::vector<int>> m_at; // by vertex
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_EDGE_GRAPH_H
