// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_EDGE_GRAPH_H
#define CGAL_POWER_RTF_GEOMETRY_EDGE_GRAPH_H

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A graph of some edges of a surface, by vertex.
class Edge_graph {
public:
  Edge_graph() = default;
  Edge_graph(const std::vector<Edge>& edges, std::size_t vertices) : m_edges(vertices)
  {
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (const int v : edges[e]) m_edges[v].push_back(static_cast<int>(e));
  }
  /// The edges at `v`, by increasing index.
  const std::vector<int>& at(int v) const { return m_edges[v]; }
  int degree(int v) const { return static_cast<int>(m_edges[v].size()); }
  void remove(int e, const Edge& edge)
  {
    for (const int v : edge) m_edges[v].erase(std::find(m_edges[v].begin(), m_edges[v].end(), e));
  }

private:
  std::vector<std::vector<int>> m_edges;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_EDGE_GRAPH_H
