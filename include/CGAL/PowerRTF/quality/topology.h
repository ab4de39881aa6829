// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Combinatorics of a triangle soup: counts, Euler characteristic, borders, defects. Works for any
// soup, manifold or not; linear in the number of triangles (edges are bucket-sorted).
#ifndef CGAL_POWER_RTF_QUALITY_TOPOLOGY_H
#define CGAL_POWER_RTF_QUALITY_TOPOLOGY_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/Surface.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// Disjoint sets over 0 .. n-1.
class Disjoint_sets {
public:
  explicit Disjoint_sets(std::size_t n)
  {
    m_parent.reserve(n);
    for (std::size_t i = 0; i < n; ++i) m_parent.push_back(static_cast<int>(i));
  }

  int find(int x)
  {
    while (m_parent[x] != x) x = m_parent[x] = m_parent[m_parent[x]];
    return x;
  }
  /// Joins the sets of `a` and `b`; whether they were different.
  bool join(int a, int b)
  {
    a = find(a), b = find(b);
    m_parent[a] = b;
    return a != b;
  }

private:
  std::vector<int> m_parent;
};

/// Halfedge 3f + k runs from corner k of facet f to corner k + 1.
/// Halfedges with the same two ends are paired when they are exactly two.
class Soup_edges {
public:
  enum : int { border = -1, non_manifold = -2 };

  explicit Soup_edges(const std::vector<Triangle>& triangles)
      : m_triangles(triangles), m_opposite(3 * triangles.size(), border)
  {
    int largest = -1;
    for (const Triangle& t : triangles) largest = std::max({largest, t[0], t[1], t[2]});
    m_corner.assign(static_cast<std::size_t>(largest + 1), -1);

    std::vector<int> begin(m_corner.size() + 1, 0); // buckets by the smaller end
    for_each_halfedge([&](int, int a, int b) { ++begin[std::min(a, b) + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    struct Entry {
      int far_end, halfedge;
    };
    std::vector<Entry> entries(static_cast<std::size_t>(begin.back()));
    std::vector<int> end(begin.begin(), begin.end() - 1);
    for_each_halfedge([&](int h, int a, int b) {
      entries[end[std::min(a, b)]++] = {std::max(a, b), h};
      m_corner[a] = h;
    });
    for (std::size_t v = 0; v < end.size(); ++v) {
      const auto first = entries.begin() + begin[v], last = entries.begin() + end[v];
      std::sort(first, last, [](const Entry& x, const Entry& y) {
        return x.far_end != y.far_end ? x.far_end < y.far_end : x.halfedge < y.halfedge;
      });
      for (auto i = first; i != last;) {
        auto j = i;
        while (j != last && j->far_end == i->far_end) ++j;
        add_edge(static_cast<int>(j - i), i->halfedge, (j - 1)->halfedge);
        if (j - i > 2)
          for (; i != j; ++i) m_opposite[i->halfedge] = non_manifold;
        i = j;
      }
    }
  }

  /// Facets with a repeated vertex have no edges.
  template <class F>
  void for_each_halfedge(F f) const
  {
    for (std::size_t i = 0; i < m_triangles.size(); ++i) {
      const Triangle& t = m_triangles[i];
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      for (int k = 0; k < 3; ++k) f(static_cast<int>(3 * i) + k, t[k], t[(k + 1) % 3]);
    }
  }

  std::size_t number_of_edges() const { return m_edges; }
  std::size_t number_of_non_manifold_edges() const { return m_non_manifold; }
  bool oriented() const { return m_oriented; }
  const std::vector<int>& corner_of_vertex() const
  {
    return m_corner;
  } ///< a halfedge from v, or -1
  int opposite(int h) const { return m_opposite[h]; }
  int source(int h) const { return m_triangles[h / 3][h % 3]; }
  int target(int h) const { return m_triangles[h / 3][(h + 1) % 3]; }

  /// Turns around `v` from facet to facet, starting in the facet of `h` and leaving it through its
  /// other edge at `v`; returns the edge where the turn ends: a border or non-manifold edge, or `h`
  /// after a full turn. Counts the facets. Needs no orientation.
  int turn(int v, int h, int& facets) const
  {
    for (int e = h;;) {
      ++facets;
      const int f = e / 3;
      for (int k = 0; k < 3; ++k) {
        const int other = 3 * f + k;
        if (other == e || (source(other) != v && target(other) != v)) continue;
        e = other;
        break;
      }
      if (m_opposite[e] < 0) return e;
      e = m_opposite[e];
      if (e == h) return h;
    }
  }

private:
  void add_edge(int uses, int h, int g)
  {
    ++m_edges;
    if (uses > 2) ++m_non_manifold;
    if (uses != 2) return;
    m_opposite[h] = g;
    m_opposite[g] = h;
    if (source(h) == source(g)) m_oriented = false;
  }

  const std::vector<Triangle>& m_triangles;
  std::vector<int> m_opposite, m_corner;
  std::size_t m_edges = 0, m_non_manifold = 0;
  bool m_oriented = true;
};

} // namespace internal

/// Topology of the soup `triangles` (#F vertex indices >= 0). `vertices` counts the used ones. A
/// vertex is non-manifold when its facets do not form one fan or one disk. A facet with a repeated
/// vertex is counted in `faces` and otherwise ignored.
inline Topology_statistics topology(const std::vector<Triangle>& triangles)
{
  using internal::Soup_edges;
  Topology_statistics result;
  const Soup_edges edges(triangles);
  const std::vector<int>& corner = edges.corner_of_vertex();
  result.faces = triangles.size();
  result.edges = edges.number_of_edges();
  result.non_manifold_edges = edges.number_of_non_manifold_edges();
  result.oriented = edges.oriented() && result.non_manifold_edges == 0;

  internal::Disjoint_sets component(corner.size()), loop(3 * triangles.size());
  std::vector<int> degree(corner.size(), 0);
  std::vector<char> bad(corner.size(), 0);
  std::size_t joins = 0, loop_joins = 0;
  edges.for_each_halfedge([&](int h, int a, int b) {
    joins += component.join(a, b);
    ++degree[a];
    if (edges.opposite(h) == Soup_edges::non_manifold) bad[a] = bad[b] = 1;
    if (edges.opposite(h) != Soup_edges::border) return;
    ++result.border_edges;
    for (const int v : {a, b}) {
      int facets = 0;
      const int next = edges.turn(v, h, facets);
      if (edges.opposite(next) == Soup_edges::border) loop_joins += loop.join(h, next);
    }
  });
  for (std::size_t i = 0; i < corner.size(); ++i) {
    if (corner[i] < 0) continue;
    ++result.vertices;
    const int v = static_cast<int>(i);
    if (!bad[i]) {
      // one way from the first facet; the other way too when that ended at a border
      int facets = 0, rest = 0;
      const int stop = edges.turn(v, corner[i], facets);
      if (stop != corner[i] && edges.opposite(corner[i]) >= 0) {
        edges.turn(v, edges.opposite(corner[i]), rest);
      }
      bad[i] = facets + rest != degree[i];
    }
    result.non_manifold_vertices += bad[i];
  }
  result.components = result.vertices - joins;
  result.border_loops = result.border_edges - loop_joins;
  result.euler_characteristic = static_cast<long>(result.vertices) -
                                static_cast<long>(result.edges) + static_cast<long>(result.faces);
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_QUALITY_TOPOLOGY_H
