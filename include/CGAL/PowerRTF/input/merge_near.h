// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Joins what lies within a tolerance of the user's: vertices become one, and vertices on edges
// become vertices of the polygons there. That closes cracks and T-junctions, and makes layers on
// top of each other the same polygons, which the repair drops.
#ifndef CGAL_POWER_RTF_INPUT_MERGE_NEAR_H
#define CGAL_POWER_RTF_INPUT_MERGE_NEAR_H

#include <CGAL/PowerRTF/geometry/Box_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/point_grid.h>
#include <CGAL/PowerRTF/input/soup_triangles.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Near_merger {
public:
  /// \param tolerance above 0, in the soup's unit
  Near_merger(Polygon_soup& soup, double tolerance, Concurrency concurrency)
      : m_soup(soup), m_box(boxed_points(soup, concurrency)), m_concurrency(concurrency),
        m_tolerance(tolerance * m_box.normalization.scale)
  {}

  void run(Repair_counts& repairs)
  {
    repairs.duplicate_vertices += join_vertices();
    repairs.inserted_vertices += insert_vertices();
  }

private:
  const Vec3d& point(int v) const { return m_box.points[v]; }
  int corners(int k) const { return m_soup.first[k + 1] - m_soup.first[k]; }
  Edge edge(int k, int i) const
  {
    const int* const polygon = &m_soup.corners[m_soup.first[k]];
    return sorted_edge(polygon[i], polygon[(i + 1) % corners(k)]);
  }

  /// The first of the vertices that are one stands for all. \returns how many others there are
  std::size_t join_vertices()
  {
    const std::vector<int> first = merged_vertices(m_soup, m_box.used, m_concurrency);
    std::vector<int> places; // each place once
    for (int v = 0; v < static_cast<int>(first.size()); ++v)
      if (m_box.used[v] && first[v] == v) places.push_back(v);
    boost::disjoint_sets_with_storage<> joined(first.size());
    const Point_grid grid(m_box.points, places, m_tolerance);
    for (const int a : places)
      grid.for_each_near(point(a), m_tolerance, [&](int b, double) { joined.union_set(a, b); });
    std::vector<int> name(first.size(), -1), vertex(first.size());
    std::size_t count = 0;
    for (int v = 0; v < static_cast<int>(first.size()); ++v) {
      if (!m_box.used[v]) continue;
      const int root = joined.find_set(first[v]);
      if (name[root] < 0) name[root] = v;
      vertex[v] = name[root];
      count += vertex[v] != v;
    }
    for (int& v : m_soup.corners) v = vertex[v];
    if (std::adjacent_find(m_soup.corners.begin(), m_soup.corners.end(), std::not_equal_to<>()) ==
        m_soup.corners.end())
      throw Invalid_input_error("merge_distance is so large that all vertices become one");
    return count;
  }

  /// Inserts each vertex into the edges that pass by it, in the order along them. \returns how many
  std::size_t insert_vertices()
  {
    std::vector<Edge> edges;
    const int polygons = static_cast<int>(m_soup.first.size()) - 1;
    for (int k = 0; k < polygons; ++k)
      for (int i = 0; i < corners(k); ++i) edges.push_back(edge(k, i));
    sort_uniquely(edges);
    std::vector<int> vertices = m_soup.corners;
    sort_uniquely(vertices);
    const std::vector<Inserted> inserted = vertices_on(edges, vertices);
    if (inserted.empty()) return 0;

    Polygon_soup result;
    for (int k = 0; k < polygons; ++k) {
      for (int i = 0; i < corners(k); ++i) {
        const int from = m_soup.corners[m_soup.first[k] + i];
        const Edge e = edge(k, i);
        result.corners.push_back(from);
        const auto [begin, end] =
            std::equal_range(inserted.begin(), inserted.end(), Inserted{e, 0, 0},
                             [](const Inserted& a, const Inserted& b) { return a.edge < b.edge; });
        const std::size_t at = result.corners.size();
        for (auto it = begin; it != end; ++it) result.corners.push_back(it->vertex);
        if (from != e[0]) std::reverse(result.corners.begin() + at, result.corners.end());
      }
      result.end_polygon();
    }
    m_soup.corners.swap(result.corners);
    m_soup.first.swap(result.first);
    return inserted.size();
  }

  struct Inserted {
    Edge edge;
    double at; // along the edge
    int vertex;
  };

  /// By edge, then along it.
  std::vector<Inserted> vertices_on(const std::vector<Edge>& edges,
                                    const std::vector<int>& vertices) const
  {
    const int first_vertex = static_cast<int>(edges.size());
    const Vec3d margin{m_tolerance, m_tolerance, m_tolerance};
    Unset_vector<Box3<double>> boxes;
    for (const Edge& e : edges) {
      Box3<double> box{point(e[0]), point(e[0])};
      box.add(point(e[1]));
      boxes.push_back({box.lo - margin, box.hi + margin});
    }
    for (const int v : vertices) boxes.push_back({point(v), point(v)});
    const auto place = [&](const Edge& e, int v) { // along the edge; outside (0, 1): not on it
      const Vec3d along = point(e[1]) - point(e[0]), to = point(v) - point(e[0]);
      const double at = dot(along, to) / squared_length(along);
      const bool is_near = squared_length(to - at * along) <= m_tolerance * m_tolerance;
      return v != e[0] && v != e[1] && is_near ? at : -1;
    };
    const auto is_on = [&](int i, int j) {
      if (i > j) std::swap(i, j);
      if (i >= first_vertex || j < first_vertex) return false;
      const double at = place(edges[i], vertices[j - first_vertex]);
      return at > 0 && at < 1;
    };
    std::vector<Inserted> result;
    for (auto [i, j] :
         Box_tree(boxes, m_concurrency).pairs([&](int k) { return k >= first_vertex; }, is_on)) {
      if (i > j) std::swap(i, j);
      const int v = vertices[j - first_vertex];
      result.push_back({edges[i], place(edges[i], v), v});
    }
    std::sort(result.begin(), result.end(), [](const Inserted& a, const Inserted& b) {
      return std::tie(a.edge, a.at, a.vertex) < std::tie(b.edge, b.at, b.vertex);
    });
    return result;
  }

  Polygon_soup& m_soup;
  Boxed_points m_box;
  Concurrency m_concurrency;
  double m_tolerance; // in the unit box
};

/// Joins the vertices of `soup` within `tolerance` of each other, or of edges. Its points stay.
/// \throws Invalid_input_error no facet, no area, a coordinate that is not finite or too large; all
///   vertices would be one
inline void merge_near(Polygon_soup& soup, double tolerance, Repair_counts& repairs,
                       Concurrency concurrency)
{
  Near_merger(soup, tolerance, concurrency).run(repairs);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INPUT_MERGE_NEAR_H
