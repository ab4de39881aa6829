// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles at a curve of edges that gets other vertices: new ones are inserted into its edges,
// old ones contracted along it.
#ifndef CGAL_POWER_RTF_FEATURES_BORDER_PIECES_H
#define CGAL_POWER_RTF_FEATURES_BORDER_PIECES_H

#include <CGAL/PowerRTF/input/Polygon_soup.h>
#include <CGAL/PowerRTF/input/polygon_triangulation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The shape of a triangle: twice its area over the squared longest edge.
inline double triangle_fatness(const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  const double longest =
      (std::max)({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
  return longest > 0 ? length(cross(b - a, c - a)) / longest : 0;
}

/// Appends the triangles of `t`, on whose sides there are more vertices: `on_sides[i]` from corner
/// `i` to the next one. No three of one side become a triangle, so that each has an area, whatever
/// the rounding. The best ear goes first.
inline void cut_at_sides(const std::vector<Vec3d>& points, const Triangle& t,
                         const std::array<std::vector<int>, 3>& on_sides,
                         std::vector<Triangle>& triangles)
{
  std::vector<int> polygon, sides; // of each vertex: bits of those that it is on
  for (int i = 0; i < 3; ++i) {
    polygon.push_back(t[i]);
    sides.push_back((1 << i) | (1 << (i + 2) % 3));
    polygon.insert(polygon.end(), on_sides[i].begin(), on_sides[i].end());
    sides.resize(polygon.size(), 1 << i);
  }
  while (polygon.size() > 3) {
    const std::size_t n = polygon.size();
    std::size_t best = n;
    double fattest = -1;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
      if (sides[before] & sides[i] & sides[after]) continue;
      int common = 7;
      for (std::size_t k = 0; k < n; ++k)
        if (k != i) common &= sides[k];
      if (common) continue;
      const double fatness =
          triangle_fatness(points[polygon[before]], points[polygon[i]], points[polygon[after]]);
      if (fatness <= fattest) continue;
      fattest = fatness;
      best = i;
    }
    triangles.push_back({polygon[(best + n - 1) % n], polygon[best], polygon[(best + 1) % n]});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(best));
    sides.erase(sides.begin() + static_cast<std::ptrdiff_t>(best));
  }
  triangles.push_back({polygon[0], polygon[1], polygon[2]});
}

/// The triangles of those polygons of a soup that have a corner at some of its vertices.
class Border_pieces {
public:
  struct Piece {
    Triangle corners; ///< the first one -1: it is no more
    int polygon;      ///< that it is a part of
  };

  /// \param places by point of `soup`, the one that stands for it; all vertices here are such
  /// \param is_touched by point, of those that stand for others: whether its polygons are taken
  /// \param stays by polygon: whether its triangles stay, so that their shape matters
  Border_pieces(const Polygon_soup& soup, const std::vector<int>& places,
                const std::vector<char>& is_touched, std::vector<char> stays)
      : points(soup.points), m_at(soup.points.size()), m_is_changed(soup.first.size() - 1, 0),
        m_stays(std::move(stays))
  {
    std::vector<Triangle> triangles;
    for (std::size_t k = 0; k + 1 < soup.first.size(); ++k) {
      std::vector<int> polygon;
      for (int c = soup.first[k]; c < soup.first[k + 1]; ++c)
        polygon.push_back(places[soup.corners[c]]);
      if (polygon.size() < 3 ||
          std::none_of(polygon.begin(), polygon.end(), [&](int v) { return is_touched[v] != 0; }))
        continue;
      triangles.clear();
      triangulate_polygon(points, polygon, triangles);
      for (const Triangle& t : triangles) add(t, static_cast<int>(k));
    }
  }

  std::vector<Vec3d> points; ///< of the soup, then new ones

  const std::vector<Piece>& pieces() const { return m_pieces; }
  bool is_changed(int polygon) const { return m_is_changed[polygon] != 0; }

  /// Inserts the vertices `on_edges[e]` into edge `e`, from its smaller end on.
  void split(const std::map<Edge, std::vector<int>>& on_edges)
  {
    m_at.resize(points.size());
    std::vector<Triangle> cut;
    const std::size_t old = m_pieces.size();
    for (std::size_t p = 0; p < old; ++p) {
      const auto [t, polygon] = m_pieces[p];
      std::array<std::vector<int>, 3> on_sides;
      for (int i = 0; i < 3; ++i) {
        const int a = t[i], b = t[(i + 1) % 3];
        const auto found = on_edges.find(sorted_edge(a, b));
        if (found == on_edges.end()) continue;
        on_sides[i] = found->second;
        if (a > b) std::reverse(on_sides[i].begin(), on_sides[i].end());
      }
      if (on_sides[0].empty() && on_sides[1].empty() && on_sides[2].empty()) continue;
      remove(static_cast<int>(p));
      cut.clear();
      cut_at_sides(points, t, on_sides, cut);
      for (const Triangle& part : cut) add(part, polygon);
    }
  }

  /// Moves vertex `v` along an edge into `u`, unless the surface would not stay a 2-manifold with
  /// the same topology there, a triangle turn by more than an angle with this cosine, or one that
  /// stays become slimmer than all of these were and than ten times as long as high.
  /// \returns whether that is done
  bool contract(int v, int u, double cos_turn)
  {
    constexpr double fair = 0.1, least_fatness = 1e-4;
    std::vector<int> left, wings; // pieces that stay; the third corners of the others
    std::map<int, std::vector<int>> link;
    double slimmest = fair;
    for (const int p : m_at[v]) {
      const Triangle& t = m_pieces[p].corners;
      const int i = static_cast<int>(std::find(t.begin(), t.end(), v) - t.begin());
      const int a = t[(i + 1) % 3], b = t[(i + 2) % 3];
      link[a].push_back(b);
      link[b].push_back(a);
      if (a != u && b != u)
        left.push_back(p);
      else
        wings.push_back(a == u ? b : a);
      if (m_stays[m_pieces[p].polygon])
        slimmest = (std::min)(slimmest, triangle_fatness(points[v], points[a], points[b]));
    }
    if (!is_cycle(link) || wings.size() != 2 || wings[0] == wings[1]) return false;
    for (const int p : m_at[u])
      for (const int w : m_pieces[p].corners)
        if (w != v && w != u && w != wings[0] && w != wings[1] && link.count(w)) return false;
    for (const int p : left)
      if (!may_become(m_pieces[p].corners, replaced(m_pieces[p].corners, v, u), cos_turn,
                      m_stays[m_pieces[p].polygon] ? slimmest : least_fatness))
        return false;
    const std::vector<int> all = m_at[v];
    for (const int p : all) {
      const auto [t, polygon] = m_pieces[p];
      remove(p);
      if (std::find(left.begin(), left.end(), p) != left.end()) add(replaced(t, v, u), polygon);
    }
    return true;
  }

private:
  static Triangle replaced(Triangle t, int v, int u)
  {
    std::replace(t.begin(), t.end(), v, u);
    return t;
  }

  /// Whether a graph is one cycle.
  static bool is_cycle(const std::map<int, std::vector<int>>& link)
  {
    for (const auto& [v, neighbors] : link)
      if (neighbors.size() != 2 || neighbors[0] == neighbors[1]) return false;
    if (link.empty()) return false;
    const int first = link.begin()->first;
    std::size_t steps = 0;
    for (int last = -1, v = first; steps == 0 || v != first; ++steps) {
      const std::vector<int>& next = link.at(v);
      const int other = next[next[0] == last];
      last = std::exchange(v, other);
    }
    return steps == link.size();
  }

  bool may_become(const Triangle& before, const Triangle& after, double cos_turn,
                  double slimmest) const
  {
    const auto normal = [&](const Triangle& t) {
      return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
    };
    const Vec3d m = normal(before), n = normal(after);
    return dot(m, n) > cos_turn * length(m) * length(n) &&
           triangle_fatness(points[after[0]], points[after[1]], points[after[2]]) >= slimmest;
  }

  void add(const Triangle& t, int polygon)
  {
    for (const int v : t) m_at[v].push_back(static_cast<int>(m_pieces.size()));
    m_pieces.push_back({t, polygon});
  }

  void remove(int p)
  {
    Piece& piece = m_pieces[p];
    m_is_changed[piece.polygon] = 1;
    for (const int v : piece.corners)
      m_at[v].erase(std::remove(m_at[v].begin(), m_at[v].end(), p), m_at[v].end());
    piece.corners = {-1, -1, -1};
  }

  std::vector<Piece> m_pieces;
  std::vector<std::vector<int>> m_at; // by vertex: pieces
  std::vector<char> m_is_changed;     // by polygon
  std::vector<char> m_stays;          // the same
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_FEATURES_BORDER_PIECES_H
