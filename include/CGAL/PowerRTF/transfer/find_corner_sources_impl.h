// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for find_corner_sources.h.
#ifndef CGAL_POWER_RTF_TRANSFER_FIND_CORNER_SOURCES_IMPL_H
#define CGAL_POWER_RTF_TRANSFER_FIND_CORNER_SOURCES_IMPL_H

#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/input/Soup_region.h>
#include <CGAL/PowerRTF/transfer/Source_triangles.h>
#include <CGAL/PowerRTF/transfer/find_corner_sources.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// The polygons of a soup as they hang together, but not across seams.
class Seam_sides {
public:
  Seam_sides(const Polygon_soup& soup, const std::vector<Edge>& seams,
             const Normalization& normalization, Concurrency concurrency)
      : m_soup(soup), m_triangles(soup, normalization), m_polygon(soup.corners.size()),
        m_next(soup.corners.size(), seam)
  {
    const std::vector<int> places = places_of_points(soup);
    const auto edge = [&](int a, int b) { return sorted_edge(places[a], places[b]); };
    std::vector<Edge> closed;
    for (const auto& [a, b] : seams) closed.push_back(edge(a, b));
    sort_uniquely(closed);
    std::vector<std::pair<Edge, int>> sides;
    for (int k = 0; k + 1 < static_cast<int>(soup.first.size()); ++k)
      for_each_side(soup, k, [&](int a, int b) {
        m_polygon[sides.size()] = k;
        sides.emplace_back(edge(a, b), static_cast<int>(sides.size()));
      });
    sort(concurrency, sides.begin(), sides.end());
    for (auto begin = sides.begin(); begin != sides.end();) {
      const auto end = std::find_if(begin, sides.end(),
                                    [&](const auto& side) { return side.first != begin->first; });
      if (!std::binary_search(closed.begin(), closed.end(), begin->first))
        for (auto s = begin; s != end; ++s)
          m_next[s->second] = (s + 1 == end ? begin : s + 1)->second;
      begin = end;
    }
  }

  /// The source of a corner at `p`: that of its vertex, unless a seam parts it from polygon `from`
  /// within `reach` of `p`.
  Source source(const Vec3d& p, const Source& of_vertex, int from, double reach) const
  {
    using Item = std::pair<double, int>; // squared distance, polygon
    std::priority_queue<Item, std::vector<Item>, std::greater<Item>> queue;
    std::set<int> seen;
    Surface_point<double> nearest;
    const auto add = [&](int k, double most) {
      if (!seen.insert(k).second) return;
      const Surface_point<double> here = nearest_of_polygon(k, p);
      if (here.squared_distance > most) return;
      queue.emplace(here.squared_distance, k);
      const auto rank = [](const auto& q) { return std::pair(q.squared_distance, q.facet); };
      if (here.facet >= 0 && (nearest.facet < 0 || rank(here) < rank(nearest))) nearest = here;
    };
    add(from, std::numeric_limits<double>::infinity());
    bool meets_seam = false;
    while (!queue.empty()) {
      const int k = queue.top().second;
      queue.pop();
      if (k == of_vertex.face) return of_vertex;
      for (int side = m_soup.first[k]; side < m_soup.first[k + 1]; ++side) {
        meets_seam = meets_seam || m_next[side] == seam;
        if (m_next[side] != seam)
          for (int s = m_next[side]; s != side; s = m_next[s]) add(m_polygon[s], reach * reach);
      }
    }
    return meets_seam && nearest.facet >= 0 ? m_triangles.source(nearest.facet, nearest.point)
                                            : of_vertex;
  }

private:
  /// Without an area, a polygon is its first corner, with facet -1.
  Surface_point<double> nearest_of_polygon(int k, const Vec3d& p) const
  {
    const std::vector<int>& polygons = m_triangles.polygons;
    const auto [begin, end] = std::equal_range(polygons.begin(), polygons.end(), k);
    Surface_point<double> nearest;
    if (begin == end && m_soup.first[k] < m_soup.first[k + 1]) {
      nearest.point = m_triangles.points[m_soup.corners[m_soup.first[k]]];
      nearest.squared_distance = squared_length(nearest.point - p);
    }
    for (auto t = begin; t != end; ++t) {
      const int f = static_cast<int>(t - polygons.begin());
      const auto corner = [&](int i) { return m_triangles.points[m_triangles.triangles[f][i]]; };
      const Vec3d q = nearest_point_on_triangle(p, corner(0), corner(1), corner(2));
      const double d = squared_length(q - p);
      if (nearest.facet < 0 || d < nearest.squared_distance) nearest = {q, f, d};
    }
    return nearest;
  }

  static constexpr int seam = -1;
  const Polygon_soup& m_soup;
  Source_triangles m_triangles;
  // By side, which has the number of the corner where it begins: its polygon, and the next side at
  // the same edge, in a cycle.
  std::vector<int> m_polygon, m_next;
};

} // namespace internal

CGAL_POWER_RTF_INLINE std::vector<std::array<Source, 3>>
find_corner_sources(const Polygon_soup& input, const std::vector<Edge>& seams,
                    const Normalization& normalization, const std::vector<Vec3d>& points,
                    const std::vector<Triangle>& triangles, const Sources& sources,
                    internal::Concurrency concurrency)
{
  // A way from the center of a triangle to its corner stays that near to the corner on a plane, and
  // a little bent elsewhere; on a wider way the end of a seam could be passed around.
  constexpr double slack = 1.25;
  const internal::Seam_sides sides(input, seams, normalization, concurrency);
  std::vector<std::array<Source, 3>> result(triangles.size());
  internal::for_each_index(concurrency, static_cast<int>(triangles.size()), [&](int f) {
    const Triangle& t = triangles[f];
    const Vec3d center = (points[t[0]] + points[t[1]] + points[t[2]]) * (1. / 3);
    for (int i = 0; i < 3; ++i) {
      const Vec3d& p = points[t[i]];
      result[f][i] = sides.source(p, sources.vertices[t[i]], sources.faces[f].face,
                                  slack * length(p - center));
    }
  });
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_TRANSFER_FIND_CORNER_SOURCES_IMPL_H
