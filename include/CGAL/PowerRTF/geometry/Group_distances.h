// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances of many points from the facets of a tree. Points that follow each other are near each
// other: the facets near a group of them are gathered once, and only these are compared with each.
// How far to gather is a guess, from what the group before has needed; a point that has no facet so
// near is looked for in the whole tree. The distances are those of `Facet_tree::nearest_anywhere()`
// to the last bit.
#ifndef CGAL_POWER_RTF_GEOMETRY_GROUP_DISTANCES_H
#define CGAL_POWER_RTF_GEOMETRY_GROUP_DISTANCES_H

#include <CGAL/PowerRTF/geometry/Facet_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CGAL::PowerRTF::internal {

class Group_distances {
public:
  static constexpr int most_points = 12;

  explicit Group_distances(const Facet_tree& tree) : m_tree(&tree) {}

  /// How many of `points` that are spread over a surface of so many facets make a good group.
  static int group_size(int points, int facets) { return 2 * points >= facets ? most_points : 1; }

  /// Finds the squared distances of `n` points, at most `most_points`, to the nearest facets. Where
  /// one is no larger than `enough`, any that is no larger may stand for it.
  /// \pre the tree has a facet
  void find(const Vec3d* points, int n, double* squared_distances, double enough = -1)
  {
    if (n >= 4 && m_reach >= 0 && !gather(points, n)) {
      find(points, n / 2, squared_distances, enough);
      find(points + n / 2, n - n / 2, squared_distances + n / 2, enough);
      return;
    }
    const bool is_gathered = n >= 4 && m_reach >= 0;
    double farthest = 0;
    for (int i = 0; i < n; ++i) {
      double d = m_nearest < 0 ? any : squared_distance(points[i], m_nearest);
      if (is_gathered && d > enough) d = search_gathered(points[i], d, enough);
      if (d > enough && !(is_gathered && d <= m_reach * m_reach)) d = search_tree(points[i]);
      farthest = std::max(farthest, squared_distances[i] = d);
    }
    m_reach = 1.5 * std::sqrt(farthest);
  }

private:
  static constexpr int width = Child_boxes::size, most_near = 16 * width; // facets

  // The facets near the group. Returns `false` if they are too many.
  bool gather(const Vec3d* points, int n)
  {
    Box3<double> box{points[0], points[0]};
    for (int i = 1; i < n; ++i) box.add(points[i]);
    m_reach = std::max(m_reach, 0.05 * length(box.hi - box.lo));
    const float reach = bound_of(m_reach * m_reach);
    const Box_query query(box);
    const Surface_view<double> view = m_tree->view();
    const Packed_tree_layout& tree = view.facet_tree;
    int nodes[most_near] = {0}, size = 1; // of the level
    for (int level = tree.levels - 1; level >= 0; --level) {
      int found = 0;
      for (int k = 0; k < size; ++k) {
        if (found > most_near - width) return false;
        const Child_boxes& node = view.facet_nodes[tree.first[level] + nodes[k]];
        float d[width];
        node.squared_distances(query, d);
        const int begin = tree.children_begin(nodes[k]), end = tree.children_end(level, nodes[k]);
        for (int c = 0; c < width; ++c) { // without branches: they would be guessed wrong
          m_places[found] = begin + c;
          if (level == 0) m_boxes[found / width].copy(found % width, node, c);
          found += int(d[c] <= reach) & int(begin + c < end);
        }
      }
      std::copy_n(m_places, size = found, nodes);
    }
    m_near = size;
    return true;
  }

  // `least`: to `m_nearest`.
  double search_gathered(const Vec3d& p, double least, double enough)
  {
    const Point_query query(p);
    float bound = bound_of(least);
    const int last = m_nearest;
    for (int begin = 0; begin < m_near; begin += width) {
      float d[width];
      m_boxes[begin / width].squared_distances(query, d);
      if (least_of(d) > bound) continue;
      for (int k = 0; k < width && begin + k < m_near; ++k) {
        if (d[k] > bound || m_places[begin + k] == last) continue;
        const double there = squared_distance(p, m_places[begin + k]);
        if (!(there < least)) continue;
        least = there;
        bound = bound_of(least);
        m_nearest = m_places[begin + k];
        if (least <= enough) return least;
      }
    }
    return least;
  }

  static float least_of(const float (&d)[width])
  {
    float half[width / 2];
    for (int k = 0; k < width / 2; ++k) half[k] = std::min(d[k], d[k + width / 2]);
    return std::min(std::min(half[0], half[1]), std::min(half[2], half[3]));
  }

  double search_tree(const Vec3d& p)
  {
    const Surface_point<double> nearest = project_to_nearest_facet(
        m_tree->all_patches(), p, Vec3d{0, 0, 0}, -2.0, m_nearest, Single_lane());
    m_nearest = nearest.facet;
    return nearest.squared_distance;
  }

  double squared_distance(const Vec3d& p, int place) const
  {
    const Facet_corners<double>& f = m_tree->view().facets[place];
    return squared_length(nearest_point_on_triangle(p, f.a, f.b, f.c) - p);
  }

  static constexpr double any = std::numeric_limits<double>::infinity();

  const Facet_tree* m_tree;
  int m_nearest = -1;  // place of the facet nearest to the last point
  double m_reach = -1; // up to which facets are gathered around a group
  int m_near = 0;      // the number of them
  Child_boxes m_boxes[most_near / width] = {};
  int m_places[most_near] = {}; // of their boxes
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_GROUP_DISTANCES_H
