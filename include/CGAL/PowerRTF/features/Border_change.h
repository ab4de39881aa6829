// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border between a region of a soup and the rest gets vertices as far apart as those that the
// region will have. They lie on the old edges; corners stay. Old vertices between them go where the
// faces on both sides can go on without them.
#ifndef CGAL_POWER_RTF_FEATURES_BORDER_CHANGE_H
#define CGAL_POWER_RTF_FEATURES_BORDER_CHANGE_H

#include <CGAL/PowerRTF/Surface_fields.h>
#include <CGAL/PowerRTF/features/Border_pieces.h>
#include <CGAL/PowerRTF/features/curve_samples.h>
#include <CGAL/PowerRTF/features/feature_curves.h>
#include <CGAL/PowerRTF/geometry/Edge_graph.h>
#include <CGAL/PowerRTF/input/Soup_region.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// What a soup is where a border has changed.
struct Changed_soup {
  Polygon_soup soup; ///< the points that it had, then new ones; triangles for changed polygons
  std::vector<int> polygons; ///< by polygon: the one of the old soup that it is, or a part of
  std::vector<char> is_new;  ///< by polygon: whether it is a part of one that has changed
  Surface_fields fields;     ///< of the soup
  std::vector<int> places;   ///< by point of the old soup: the first one at its place
};

class Border_change {
public:
  /// \param whole, fields the soup and what is said about places there
  /// \param region some of its polygons
  /// \param feature_angle degrees: a vertex of the border stays where an edge that is sharper, or
  ///   whatever else is kept, leads to it
  Border_change(const Polygon_soup& whole, const Surface_fields& fields, const Soup_region& region,
                double feature_angle)
      : m_whole(whole), m_fields(fields), m_places(places_of_points(whole)),
        m_cos_sharp(std::cos(feature_angle * std::acos(-1.) / 180)),
        m_pieces(whole, m_places, marks_of_border(region), marks_of_rest(region))
  {}

  /// The points of the border, each standing for all at its place.
  const std::vector<int>& vertices() const { return m_vertices; }
  /// By point of the soup: the one that stands for it.
  const std::vector<int>& places() const { return m_places; }

  /// \param lengths by vertex of the border: how far apart they shall be there, in the soup's unit
  /// \param is_single whether new points have coordinates of single precision
  Changed_soup run(const std::vector<double>& lengths, bool is_single)
  {
    Surface curve_surface;
    for (const int v : m_vertices) curve_surface.points.push_back(m_whole.points[v]);
    for (const auto& [a, b] : m_edges) curve_surface.creases.push_back({rank(a), rank(b)});
    const Edge_graph graph(curve_surface.creases, m_vertices.size());
    for (int v = 0; v < static_cast<int>(lengths.size()); ++v) {
      const double l = lengths[v] * detour(graph, curve_surface.points, v, lengths[v]);
      curve_surface.vertex_density.push_back(1 / (l * l));
    }
    mark_corners(curve_surface.kept_vertices);
    const double mean =
        std::accumulate(lengths.begin(), lengths.end(), 0.) / static_cast<double>(lengths.size());
    // Over a length, so that the teeth of a border along edges of a mesh are no corners.
    const std::vector<Feature_curve> curves = feature_curves(curve_surface, mean);
    const Curve_samples samples = Curve_sampler(curve_surface, curves).run(1);
    insert(samples.places, is_single);
    for (const Feature_curve& curve : curves) contract_along(chain_of(curve), curve.has_corners);
    return result();
  }

private:
  /// Of a face from which a vertex goes: 40 degrees, as between those that are no crease.
  static constexpr double cos_turn = 0.7660444;

  /// Finds the border. By point, of those that stand for others: whether it is there.
  std::vector<char> marks_of_border(const Soup_region& region)
  {
    std::vector<char> marks(m_whole.points.size(), 0);
    for (const auto& [a, b] : region.fields.kept_edges)
      m_edges.push_back(sorted_edge(m_places[region.points[a]], m_places[region.points[b]]));
    sort_uniquely(m_edges);
    for (const Edge& e : m_edges) m_vertices.insert(m_vertices.end(), e.begin(), e.end());
    sort_uniquely(m_vertices);
    for (const int v : m_vertices) marks[v] = 1;
    return marks;
  }

  std::vector<char> marks_of_rest(const Soup_region& region) const
  {
    std::vector<char> marks(m_whole.first.size() - 1, 0);
    for (const int k : region.others) marks[k] = 1;
    return marks;
  }

  bool is_border(const Edge& e) const
  {
    return std::binary_search(m_edges.begin(), m_edges.end(), e);
  }
  /// The number of a point among the border's vertices, or that of where it would be.
  int rank(int v) const
  {
    return static_cast<int>(std::lower_bound(m_vertices.begin(), m_vertices.end(), v) -
                            m_vertices.begin());
  }

  /// How much longer than its chord a piece of the border of length `l` around `v` is, if edges
  /// there are shorter than that: along edges of a mesh it is no straight line.
  static double detour(const Edge_graph& graph, const std::vector<Vec3d>& points, int v, double l)
  {
    constexpr double longest = 3;
    if (graph.degree(v) != 2) return 1;
    for (const int e : graph.at(v))
      if (length(points[graph.other_end(e, v)] - points[v]) > l) return 1;
    const auto [a, to_a] = point_ahead(graph, points, v, graph.at(v)[0], l / 2);
    const auto [b, to_b] = point_ahead(graph, points, v, graph.at(v)[1], l / 2);
    return (std::min)((to_a + to_b) / length(b - a), longest);
  }

  /// Vertices of the border to which something leads that is kept, and those where the surface is
  /// not one sheet with the border inside.
  void mark_corners(std::vector<int>& corners) const
  {
    const auto mark = [&](const Edge& e) {
      for (const int v : e)
        if (const int k = rank(v); k < int(m_vertices.size()) && m_vertices[k] == v)
          corners.push_back(k);
    };
    std::vector<std::pair<Edge, int>> sides; // with their pieces
    const std::vector<Border_pieces::Piece>& pieces = m_pieces.pieces();
    for (int p = 0; p < static_cast<int>(pieces.size()); ++p)
      for (int i = 0; i < 3; ++i)
        sides.emplace_back(sorted_edge(pieces[p].corners[i], pieces[p].corners[(i + 1) % 3]), p);
    std::sort(sides.begin(), sides.end());
    for (std::size_t first = 0, last; first < sides.size(); first = last) {
      const Edge& e = sides[first].first;
      for (last = first + 1; last < sides.size() && sides[last].first == e;) ++last;
      if (last - first != 2 ||
          (!is_border(e) && is_sharp(pieces[sides[first].second], pieces[sides[first + 1].second])))
        mark(e);
    }
    std::vector<Edge> lines = m_fields.lines;
    if (m_fields.creases)
      lines.insert(lines.end(), m_fields.creases->begin(), m_fields.creases->end());
    for (const auto& [a, b] : lines)
      if (const Edge e = sorted_edge(m_places[a], m_places[b]); !is_border(e)) mark(e);
    for (const int v : m_fields.kept_vertices) mark({m_places[v], m_places[v]});
    sort_uniquely(corners);
  }

  /// Whether the edge between two pieces is kept.
  bool is_sharp(const Border_pieces::Piece& a, const Border_pieces::Piece& b) const
  {
    if (!m_fields.labels.empty() && m_fields.labels[a.polygon] != m_fields.labels[b.polygon])
      return true;
    const auto normal = [&](const Triangle& t) {
      const std::vector<Vec3d>& points = m_pieces.points;
      return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
    };
    const Vec3d m = normal(a.corners), n = normal(b.corners);
    return dot(m, n) < m_cos_sharp * length(m) * length(n);
  }

  /// Makes vertices of places on the border. Old ones that are none of them are to go.
  void insert(const std::vector<Edge_place>& places, bool is_single)
  {
    m_is_to_go.assign(m_vertices.size(), 1);
    std::map<Edge, std::vector<std::pair<double, int>>> on_edges; // from the smaller end
    for (const auto& [from, to, at] : places) {
      const int a = m_vertices[from], b = m_vertices[to];
      Vec3d p = m_pieces.points[a] + (m_pieces.points[b] - m_pieces.points[a]) * at;
      if (is_single && from != to)
        for (double* x : {&p.x, &p.y, &p.z}) *x = static_cast<float>(*x);
      if (p == m_pieces.points[a] || p == m_pieces.points[b]) {
        m_is_to_go[p == m_pieces.points[a] ? from : to] = 0;
        continue;
      }
      on_edges[sorted_edge(a, b)].emplace_back(a < b ? at : 1 - at,
                                               static_cast<int>(m_pieces.points.size()));
      m_pieces.points.push_back(p);
      m_origins.push_back({a, b, at});
    }
    for (auto& [e, inside] : on_edges) {
      std::sort(inside.begin(), inside.end());
      for (const auto& [at, v] : inside) m_on_edges[e].push_back(v);
    }
    m_pieces.split(m_on_edges);
  }

  /// The vertices along a curve, old and new; the first one again at the end.
  std::vector<int> chain_of(const Feature_curve& curve) const
  {
    std::vector<int> chain;
    for (std::size_t k = 0; k + 1 < curve.vertices.size(); ++k) {
      const int a = m_vertices[curve.vertices[k]], b = m_vertices[curve.vertices[k + 1]];
      chain.push_back(a);
      const auto found = m_on_edges.find(sorted_edge(a, b));
      if (found == m_on_edges.end()) continue;
      std::vector<int> inside = found->second;
      if (a > b) std::reverse(inside.begin(), inside.end());
      chain.insert(chain.end(), inside.begin(), inside.end());
    }
    chain.push_back(m_vertices[curve.vertices.back()]);
    return chain;
  }

  bool is_to_go(int v) const
  {
    return v < static_cast<int>(m_whole.points.size()) && m_is_to_go[rank(v)];
  }

  /// Contracts the vertices of a chain that are to go into others of it.
  void contract_along(std::vector<int> chain, bool has_corners)
  {
    if (!has_corners) { // closed: it shall begin with one that stays
      chain.pop_back();
      const auto first =
          std::find_if(chain.begin(), chain.end(), [&](int v) { return !is_to_go(v); });
      if (first == chain.end()) return;
      std::rotate(chain.begin(), first, chain.end());
      chain.push_back(chain.front());
    }
    for (auto first = chain.begin(); first + 1 < chain.end();) {
      auto last = first + 1;
      while (is_to_go(*last)) ++last;
      contract_between({first, last + 1});
      first = last;
    }
  }

  /// The same of those between two that stay: those near to these first, toward them, if possible.
  void contract_between(std::vector<int> chain)
  {
    for (bool is_shorter = true; is_shorter && chain.size() > 2;) {
      is_shorter = false;
      const auto go = [&](std::size_t k, std::size_t near, std::size_t far) {
        if (!m_pieces.contract(chain[k], chain[near], cos_turn) &&
            !m_pieces.contract(chain[k], chain[far], cos_turn))
          return false;
        chain.erase(chain.begin() + static_cast<std::ptrdiff_t>(k));
        return is_shorter = true;
      };
      for (std::size_t k = 1; k < (chain.size() + 1) / 2;)
        if (!go(k, k - 1, k + 1)) ++k;
      for (std::size_t k = chain.size() - 2; k > 0 && k >= chain.size() / 2; --k)
        go(k, k + 1, k - 1);
    }
  }

  Changed_soup result() const
  {
    Changed_soup result;
    Polygon_soup& soup = result.soup;
    soup.points = m_pieces.points;
    soup.merges_vertices = m_whole.merges_vertices;
    const auto end = [&](std::size_t k, bool is_new) {
      soup.end_polygon();
      result.polygons.push_back(static_cast<int>(k));
      result.is_new.push_back(is_new);
    };
    for (std::size_t k = 0; k + 1 < m_whole.first.size(); ++k) {
      if (m_pieces.is_changed(static_cast<int>(k))) continue;
      soup.corners.insert(soup.corners.end(), m_whole.corners.begin() + m_whole.first[k],
                          m_whole.corners.begin() + m_whole.first[k + 1]);
      end(k, false);
    }
    for (const auto& [t, polygon] : m_pieces.pieces()) {
      if (t[0] < 0 || !m_pieces.is_changed(polygon)) continue;
      soup.corners.insert(soup.corners.end(), t.begin(), t.end());
      end(polygon, true);
    }
    set_fields(result);
    result.places = m_places;
    return result;
  }

  void set_fields(Changed_soup& result) const
  {
    Surface_fields& fields = result.fields;
    fields = m_fields;
    for (auto* values : {&fields.densities, &fields.sizes})
      if (*values)
        for (const auto& [a, b, at] : m_origins)
          (*values)->push_back((1 - at) * (**values)[a] + at * (**values)[b]);
    if (!fields.labels.empty()) {
      fields.labels.clear();
      for (const int k : result.polygons) fields.labels.push_back(m_fields.labels[k]);
    }
    const auto is_of_border = [&](const Edge& e) { // which is one as it is
      return is_border(sorted_edge(m_places[e[0]], m_places[e[1]]));
    };
    std::vector<Edge>& lines = fields.lines;
    lines.erase(std::remove_if(lines.begin(), lines.end(), is_of_border), lines.end());
    if (!fields.creases) return;
    std::vector<Edge>& creases = *fields.creases;
    creases.erase(std::remove_if(creases.begin(), creases.end(), is_of_border), creases.end());
  }

  const Polygon_soup& m_whole;
  const Surface_fields& m_fields;
  std::vector<int> m_places; // by point: the first of those at its place
  double m_cos_sharp;
  std::vector<Edge> m_edges;                   // of the border, sorted
  std::vector<int> m_vertices;                 // the same
  Border_pieces m_pieces;                      // after these: it is made of them
  std::vector<char> m_is_to_go;                // by vertex of the border
  std::map<Edge, std::vector<int>> m_on_edges; // new vertices, from the smaller end
  std::vector<Edge_place> m_origins;           // of the new points
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_FEATURES_BORDER_CHANGE_H
