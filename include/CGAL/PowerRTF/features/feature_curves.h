// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The creases and borders of a surface as curves between corners.
#ifndef CGAL_POWER_RTF_FEATURES_FEATURE_CURVES_H
#define CGAL_POWER_RTF_FEATURES_FEATURE_CURVES_H

#include <CGAL/PowerRTF/features/creases.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// A chain of feature edges.
struct Feature_curve {
  /// From corner to corner; first = last for a closed one; a single one where sheets touch,
  /// or that is kept, off all creases.
  std::vector<int> vertices;
  bool has_corners = true; ///< no: closed, and none of its vertices is a corner
  int parallels = 1;       ///< curves between the same two corners, itself included
  bool is_kept = false;    ///< a kept edge: the result has it as it is, without samples inside
  bool is_mirror = false;  ///< where the surface goes on as its mirror image
};

namespace internal {

/// Creases and border edges, smaller vertex first, sorted.
inline std::vector<Edge> feature_edges(const Surface& surface)
{
  std::vector<Edge> edges = border_edges(surface.triangles, surface.adjacency);
  edges.insert(edges.end(), surface.creases.begin(), surface.creases.end());
  sort_uniquely(edges);
  return edges;
}

/// The point at arc distance `reach` from `v` along edge `e`, or the first corner before it; and
/// how far that is.
inline std::pair<Vec3d, double>
point_ahead(const Edge_graph& graph, const std::vector<Vec3d>& points, int v, int e, double reach)
{
  double left = reach;
  for (int steps = 0; steps < graph.size(); ++steps) {
    const int u = graph.other_end(e, v);
    const Vec3d a = points[v], b = points[u];
    const double l = length(b - a);
    if (l >= left) return {a + (b - a) * (left / l), reach};
    left -= l;
    if (graph.degree(u) != 2) return {b, reach - left};
    v = u;
    e = graph.other_edge(e, u);
  }
  return {points[v], reach - left};
}

class Feature_tracer {
public:
  /// \param scale over which turns are measured
  Feature_tracer(const Surface& surface, double scale)
      : m_surface(surface), m_scale(scale), m_graph(feature_edges(surface), surface.points.size()),
        m_is_corner(surface.points.size(), 0)
  {
    for (int v = 0; v < static_cast<int>(surface.points.size()); ++v)
      m_is_corner[v] = m_graph.degree(v) != 0 && m_graph.degree(v) != 2;
    for (const int v : surface.contacts) m_is_corner[v] = 1;
    for (const int v : surface.kept_vertices) m_is_corner[v] = 1;
    if (!surface.seams.empty()) mark_ends_of_sheets();
    if (surface.mirror) mark_ends_at_mirror();
    if (scale > 0) mark_turns();
  }

  std::vector<Feature_curve> curves()
  {
    std::vector<Feature_curve> curves;
    std::vector<char> seen(m_graph.size(), 0);
    const auto trace = [&](int v, int e) {
      Feature_curve curve;
      curve.vertices.push_back(v);
      while (!seen[e]) {
        seen[e] = 1;
        v = m_graph.other_end(e, v);
        curve.vertices.push_back(v);
        if (m_is_corner[v]) break;
        e = m_graph.other_edge(e, v);
      }
      curve.is_kept = std::binary_search(m_surface.kept_edges.begin(), m_surface.kept_edges.end(),
                                         sorted_edge(curve.vertices[0], curve.vertices[1]));
      curve.is_mirror = is_at_mirror(curve.vertices[0]) && is_at_mirror(curve.vertices[1]);
      curves.push_back(std::move(curve));
    };
    for (int v = 0; v < static_cast<int>(m_surface.points.size()); ++v)
      if (m_is_corner[v])
        for (const int e : m_graph.at(v))
          if (!seen[e]) trace(v, e);
    for (int e = 0; e < m_graph.size(); ++e) {
      if (seen[e]) continue;
      trace(m_graph[e][0], e);
      curves.back().has_corners = false;
    }
    for (const std::vector<int>* alone : {&m_surface.contacts, &m_surface.kept_vertices})
      for (const int v : *alone)
        if (m_graph.degree(v) == 0) curves.push_back({{v}});
    count_parallels(curves);
    return curves;
  }

private:
  bool is_at_mirror(int v) const { return m_surface.is_at_mirror(m_surface.points[v]); }

  /// Vertices where another border goes on from that on the plane of the mirror.
  void mark_ends_at_mirror()
  {
    for (int v = 0; v < static_cast<int>(m_surface.points.size()); ++v)
      if (is_at_mirror(v) && m_graph.degree(v) == 2)
        for (const int e : m_graph.at(v))
          if (!is_at_mirror(m_graph.other_end(e, v))) m_is_corner[v] = 1;
  }

  /// Vertices of two feature edges where a sheet of a network has only one of them, or other edges
  /// on both its sides: sheets meet there that do not go on along the curve.
  void mark_ends_of_sheets()
  {
    const auto& triangles = m_surface.triangles;
    const auto edge = [&](int h) {
      return sorted_edge(halfedge_source(triangles, h), halfedge_target(triangles, h));
    };
    const auto is_cut = [&](int h) {
      return m_surface.adjacency.opposite[h] == Facet_adjacency::none ||
             std::binary_search(m_surface.creases.begin(), m_surface.creases.end(), edge(h));
    };
    const auto opposite = [&](int h) {
      return is_cut(h) ? Facet_adjacency::none : m_surface.adjacency.opposite[h];
    };
    for_each_fan(3 * triangles.size(), opposite, [&](const std::vector<int>& fan) {
      const int v = halfedge_source(triangles, fan[0]);
      if (m_graph.degree(v) != 2) return;
      std::vector<Edge> ends;
      for (const int h : fan)
        for (const int side : {h, previous_halfedge(h)})
          if (is_cut(side)) ends.push_back(edge(side));
      sort_uniquely(ends);
      if (ends.size() == 1) m_is_corner[v] = 1;
    });
  }

  Vec3d ahead(int v, int e) const
  {
    return point_ahead(m_graph, m_surface.points, v, e, m_scale).first;
  }

  /// Vertices where a curve turns by more than 50 degrees, more than any other within the scale.
  void mark_turns()
  {
    constexpr double cos_turn = 0.6427876;     // 50 degrees
    std::vector<std::pair<double, int>> turns; // sharpest first; ties by index
    for (int v = 0; v < static_cast<int>(m_surface.points.size()); ++v) {
      if (m_graph.degree(v) != 2) continue;
      const Vec3d p = m_surface.points[v];
      const Vec3d in = normalized(p - ahead(v, m_graph.at(v)[0]));
      const Vec3d out = normalized(ahead(v, m_graph.at(v)[1]) - p);
      if (dot(in, out) < cos_turn) turns.emplace_back(dot(in, out), v);
    }
    std::sort(turns.begin(), turns.end());
    std::vector<char> is_near(m_surface.points.size(), 0); // a sharper turn
    for (const auto& [turn, corner] : turns) {
      if (is_near[corner]) continue;
      m_is_corner[corner] = 1;
      for (int side = 0; side < 2; ++side) {
        double passed = 0;
        for (int v = corner, e = m_graph.at(v)[side];;) {
          const int u = m_graph.other_end(e, v);
          passed += length(m_surface.points[u] - m_surface.points[v]);
          if (passed > m_scale || m_graph.degree(u) != 2 || u == corner) break;
          is_near[u] = 1;
          v = u;
          e = m_graph.other_edge(e, u);
        }
      }
    }
  }

  static void count_parallels(std::vector<Feature_curve>& curves)
  {
    std::vector<std::pair<Edge, std::size_t>> ends;
    for (std::size_t c = 0; c < curves.size(); ++c)
      if (curves[c].has_corners)
        ends.emplace_back(sorted_edge(curves[c].vertices.front(), curves[c].vertices.back()), c);
    std::sort(ends.begin(), ends.end());
    for (auto first = ends.begin(); first != ends.end();) {
      const auto last =
          std::find_if(first, ends.end(), [&](const auto& e) { return e.first != first->first; });
      for (auto e = first; e != last; ++e)
        curves[e->second].parallels = static_cast<int>(last - first);
      first = last;
    }
  }

  const Surface& m_surface;
  double m_scale;
  Edge_graph m_graph;
  std::vector<char> m_is_corner;
};

} // namespace internal

/// The curves of creases and borders. Corners are the vertices where not exactly two feature edges
/// meet, those that are kept, and those where a curve turns by more than 50 degrees over `scale` to
/// both sides (0: none).
inline std::vector<Feature_curve> feature_curves(const Surface& surface, double scale)
{
  if (surface.creases.empty() && surface.adjacency.border_edges == 0 && surface.contacts.empty() &&
      surface.kept_vertices.empty())
    return {};
  return internal::Feature_tracer(surface, scale).curves();
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_FEATURE_CURVES_H
