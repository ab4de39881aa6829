// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A kd-tree over weighted samples whose nodes know their box and their largest weight. CGAL's and
// Boost's trees have no such node data; without it a bound for the search must use the largest
// weight of all samples, which is far too loose once weights are large.
#ifndef CGAL_POWER_RTF_EXACT_WEIGHTED_SITE_TREE_H
#define CGAL_POWER_RTF_EXACT_WEIGHTED_SITE_TREE_H

#include <CGAL/PowerRTF/exact/Tangent_cell_clipper.h>

#include <algorithm>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Weighted_site_tree {
  static constexpr int leaf_size = 8;

  struct Node {
    Weighted_box box;
    int first, last; // range of m_order
    int left = -1, right = -1;
  };

  std::vector<int> m_order;
  std::vector<Node> m_nodes;

public:
  /// `points` and `weights`: one per sample; only read here.
  Weighted_site_tree(const std::vector<Vec3d>& points, const std::vector<double>& weights)
      : m_order(points.size())
  {
    std::iota(m_order.begin(), m_order.end(), 0);
    if (points.empty()) return;
    m_nodes.push_back({box_of(points, weights, 0, int(points.size())), 0, int(points.size())});
    for (std::size_t node = 0; node < m_nodes.size(); ++node) split(node, points, weights);
  }

  /// Calls `visit(j)` for samples j by roughly increasing distance from `center`, leaving out the
  /// nodes for which `is_needed(box)` is false when they are reached.
  template <class IsNeeded, class Visit>
  void visit(const Vec3d& center, IsNeeded is_needed, Visit visit_sample) const
  {
    using Entry = std::pair<double, int>; // squared distance: only for the order
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    const auto push = [&](int node) {
      queue.push({squared_distance(m_nodes[node].box, center), node});
    };
    if (!m_nodes.empty()) push(0);
    while (!queue.empty()) {
      const Node& node = m_nodes[queue.top().second];
      queue.pop();
      if (!is_needed(node.box)) continue;
      if (node.left < 0) {
        for (int k = node.first; k < node.last; ++k) visit_sample(m_order[k]);
      } else {
        push(node.left);
        push(node.right);
      }
    }
  }

private:
  Weighted_box box_of(const std::vector<Vec3d>& points, const std::vector<double>& weights,
                      int first, int last) const
  {
    const Vec3d& p = points[m_order[first]];
    Weighted_box b{{p, p}, weights[m_order[first]]};
    for (int k = first + 1; k < last; ++k) {
      b.add(points[m_order[k]]);
      b.max_weight = (std::max)(b.max_weight, weights[m_order[k]]);
    }
    return b;
  }

  void split(std::size_t node, const std::vector<Vec3d>& points, const std::vector<double>& weights)
  {
    const int first = m_nodes[node].first, last = m_nodes[node].last;
    if (last - first <= leaf_size) return;
    const Vec3d extent = m_nodes[node].box.hi - m_nodes[node].box.lo;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const int middle = first + (last - first) / 2;
    std::nth_element(m_order.begin() + first, m_order.begin() + middle, m_order.begin() + last,
                     [&](int i, int j) {
                       return std::make_pair(coordinate(points[i], axis), i) <
                              std::make_pair(coordinate(points[j], axis), j);
                     });
    m_nodes[node].left = int(m_nodes.size());
    m_nodes.push_back({box_of(points, weights, first, middle), first, middle});
    m_nodes[node].right = int(m_nodes.size());
    m_nodes.push_back({box_of(points, weights, middle, last), middle, last});
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXACT_WEIGHTED_SITE_TREE_H
