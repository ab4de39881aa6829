// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The k vertices of the surface nearest to a point: a static, balanced tree of tight boxes over
// contiguous leaves. For small k several times as fast as CGAL's Kd_tree, and without allocation.
#ifndef CGAL_POWER_RTF_SURFACE_NEAREST_VERTICES_H
#define CGAL_POWER_RTF_SURFACE_NEAREST_VERTICES_H

#include <CGAL/PowerRTF/surface/Surface.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace PowerRTF {

/// Finds nearest points among a fixed set. Queries may run in parallel.
class Nearest_vertices {
public:
  static constexpr int max_neighbors = 64;

  explicit Nearest_vertices(const Surface& surface) : Nearest_vertices(surface.points) {}

  explicit Nearest_vertices(const std::vector<Vec3d>& points)
  {
    std::vector<int> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    m_nodes.reserve(points.size() / 2 + 1);
    if (!points.empty()) build(points, order, 0, static_cast<int>(points.size()));
    m_points.reserve(points.size());
    for (const int v : order) m_points.push_back({points[v], v});
  }

  /// Writes the indices of the `k` vertices nearest to `q` (at most `max_neighbors`, all if there
  /// are fewer) by increasing distance, equal distances by index.
  /// \returns the number of indices written
  int find(const Vec3d& q, int k, int* indices) const
  {
    k = (std::min)({k, static_cast<int>(m_points.size()), int(max_neighbors)});
    if (k <= 0) return 0;
    Query query; // `found` is left as it is: only its first `count` entries are ever read
    query.point = q;
    query.k = k;
    query.count = 0;
    search(0, query);
    for (int i = 0; i < k; ++i) indices[i] = query.found[i].index;
    return k;
  }

private:
  static constexpr int leaf_size = 8;

  struct Entry {
    Vec3d point;
    int index;
  };
  struct Node {
    Vec3d low, high; // the box of its points
    int begin, end;  // in m_points
    int right;       // the left child follows its parent; 0: a leaf
  };
  struct Found {
    double squared_distance;
    int index;

    bool operator<(const Found& o) const
    {
      return squared_distance < o.squared_distance ||
             (squared_distance == o.squared_distance && index < o.index);
    }
  };
  struct Query {
    Vec3d point;
    int k, count;
    Found found[max_neighbors]; // sorted
  };

  static double coordinate(const Vec3d& p, int axis)
  { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

  int build(const std::vector<Vec3d>& points, std::vector<int>& order, int begin, int end)
  {
    Node node{points[order[begin]], points[order[begin]], begin, end, 0};
    for (int i = begin; i < end; ++i) {
      const Vec3d& p = points[order[i]];
      node.low = {(std::min)(node.low.x, p.x), (std::min)(node.low.y, p.y),
                  (std::min)(node.low.z, p.z)};
      node.high = {(std::max)(node.high.x, p.x), (std::max)(node.high.y, p.y),
                   (std::max)(node.high.z, p.z)};
    }
    const int self = static_cast<int>(m_nodes.size());
    m_nodes.push_back(node);
    if (end - begin <= leaf_size) return self;
    const Vec3d size = node.high - node.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int middle = (begin + end) / 2;
    std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
                     [&](int a, int b)
                     {
                       const double x = coordinate(points[a], axis);
                       const double y = coordinate(points[b], axis);
                       return x < y || (x == y && a < b);
                     });
    build(points, order, begin, middle);
    const int right = build(points, order, middle, end);
    m_nodes[self].right = right;
    return self;
  }

  /// Rounded like the distance to a point, so that it never exceeds that of a point in the box.
  static double squared_distance(const Vec3d& q, const Node& box)
  {
    const auto outside = [](double x, double low, double high)
    { return (std::max)((std::max)(low - x, x - high), 0.); };
    return squared_length(Vec3d{outside(q.x, box.low.x, box.high.x),
                                outside(q.y, box.low.y, box.high.y),
                                outside(q.z, box.low.z, box.high.z)});
  }

  static double worst(const Query& query)
  {
    return query.count < query.k ? (std::numeric_limits<double>::infinity)()
                                 : query.found[query.k - 1].squared_distance;
  }

  void search(int index, Query& query) const
  {
    const Node& node = m_nodes[index];
    if (node.right == 0) {
      for (int i = node.begin; i < node.end; ++i) {
        const double d = squared_length(m_points[i].point - query.point);
        if (d <= worst(query)) insert({d, m_points[i].index}, query);
      }
      return;
    }
    int near = index + 1, far = node.right;
    double near_distance = squared_distance(query.point, m_nodes[near]);
    double far_distance = squared_distance(query.point, m_nodes[far]);
    if (far_distance < near_distance) {
      std::swap(near, far);
      std::swap(near_distance, far_distance);
    }
    if (near_distance <= worst(query)) search(near, query);
    if (far_distance <= worst(query)) search(far, query);
  }

  static void insert(const Found& f, Query& query)
  {
    if (query.count == query.k && !(f < query.found[query.k - 1])) return;
    int i = query.count < query.k ? query.count++ : query.k - 1;
    for (; i > 0 && f < query.found[i - 1]; --i) query.found[i] = query.found[i - 1];
    query.found[i] = f;
  }

  std::vector<Entry> m_points; // in the tree's order
  std::vector<Node> m_nodes;
};

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_SURFACE_NEAREST_VERTICES_H
