// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which candidates for samples are near each other.
#ifndef CGAL_POWER_RTF_SAMPLING_CANDIDATE_GRAPH_H
#define CGAL_POWER_RTF_SAMPLING_CANDIDATE_GRAPH_H

#include <CGAL/PowerRTF/geometry/Hilbert_table.h>
#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/for_each_node.h>
#include <CGAL/PowerRTF/geometry/hilbert_code.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/order_by_key.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/sampling/crowding.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Which candidates see each other: closer than the sum of their radii, normals compatible. Places
/// are those of the candidates in spatial order.
struct Candidate_graph {
  static constexpr int part_size = 512; ///< places whose neighbors are in one array

  Unset_vector<int> order;                           ///< the candidate at each place
  std::vector<std::vector<Crowding_neighbor>> parts; ///< the neighbors of all places, part by part
  Unset_vector<int> end; ///< of the neighbors of each place, in its part; the next ones begin there

  /// Calls `f(neighbor)` for the neighbors of place `k`.
  template <class F>
  void for_each_neighbor(int k, F&& f) const
  {
    const std::vector<Crowding_neighbor>& part = parts[k / part_size];
    for (int e = k % part_size == 0 ? 0 : end[k - 1]; e < end[k]; ++e) f(part[e]);
  }
};

/// The candidates in a packed tree, of whose nodes the largest radius is known, too: the work of a
/// search does not grow with the contrast of the radii.
class Candidate_tree {
public:
  static constexpr int group_size = Packed_tree_layout::arity * Packed_tree_layout::arity;

  Candidate_tree(const Elimination_candidates& candidates, Concurrency concurrency)
      : m_layout(static_cast<int>(candidates.size())), m_order(candidates.size()),
        m_sorted(candidates.size()), m_boxes(m_layout.nodes()), m_radii(m_layout.nodes())
  {
    const Hilbert_table& curve = Hilbert_table::get();
    order_by_key(
        concurrency, m_layout.items,
        [&](int i) { return curve.index(hilbert_cube(candidates[i].point)); }, m_order.data());
    for_each_index(concurrency, m_layout.items,
                   [&](int k) { m_sorted[k] = candidates[m_order[k]]; });
    for_each_node(concurrency, m_layout, [&](int level, int k) { fit(level, k); });
  }

  Unset_vector<int>&& order() && { return std::move(m_order); }
  /// Groups of `group_size` places.
  int groups() const { return (m_layout.items + group_size - 1) / group_size; }

  /// What is near a group, and one of its leaves.
  struct Near {
    struct Item {
      int place;
      double radius;
      Vec3d point;
    };
    std::vector<int> leaves; ///< the group's
    std::vector<Item> items; ///< the first `size` are the leaf's
    int size = 0;
  };

  /// Calls `found(neighbor)` for the neighbors of the places of a group in order, and after those
  /// of place k `finish(k)`. `near` is memory.
  template <class Found, class Finish>
  void for_each_neighbor(int group, double cos_normal_angle, Near& near, Found&& found,
                         Finish&& finish) const
  {
    constexpr int arity = Packed_tree_layout::arity;
    find_near_leaves(group, near.leaves);
    const int end = (std::min)((group + 1) * arity, m_layout.nodes(0));
    for (int leaf = group * arity; leaf < end; ++leaf) {
      find_near_items(leaf, near);
      for (int i = m_layout.children_begin(leaf); i < m_layout.children_end(0, leaf); ++i) {
        const Elimination_candidate& a = m_sorted[i];
        for (int k = 0; k < near.size; ++k) {
          const Near::Item& b = near.items[k];
          const double reach = a.radius + b.radius, squared = squared_length(a.point - b.point);
          if (squared >= reach * reach || b.place == i ||
              dot(a.normal, m_sorted[b.place].normal) < cos_normal_angle)
            continue;
          found(Crowding_neighbor{b.place, crowding(squared, reach)});
        }
        finish(i);
      }
    }
  }

private:
  /// Whether something may see what is in a node at that squared distance.
  bool is_near(double squared, double radius, int node) const
  {
    const double reach = radius + m_radii[node];
    return squared <= reach * reach;
  }

  bool are_near(int node, int other) const
  {
    return is_near(squared_distance(m_boxes[node], m_boxes[other]), m_radii[node], other);
  }

  void find_near_leaves(int group, std::vector<int>& near) const
  {
    const int node = m_layout.levels > 1 ? m_layout.first[1] + group : 0;
    near.clear();
    traverse(
        m_layout, [&](int other) { return are_near(node, other); },
        [&](int begin, int) { near.push_back(begin / Packed_tree_layout::arity); });
  }

  /// In order, as they are summed up.
  void find_near_items(int leaf, Near& near) const
  {
    const std::size_t most = near.leaves.size() * Packed_tree_layout::arity;
    if (near.items.size() < most) near.items.resize(most);
    near.size = 0;
    for (const int other : near.leaves) {
      if (!are_near(leaf, other)) continue;
      for (int j = m_layout.children_begin(other); j < m_layout.children_end(0, other); ++j) {
        const Elimination_candidate& b = m_sorted[j];
        near.items[near.size] = {j, b.radius, b.point}; // without a branch: half are guessed wrong
        near.size += is_near(squared_distance(m_boxes[leaf], b.point), b.radius, leaf);
      }
    }
  }

  void fit(int level, int k)
  {
    const int node = m_layout.first[level] + k, begin = m_layout.children_begin(k);
    const auto add = [&](int c, const Box3<double>& box, double radius) {
      if (c == begin) {
        m_boxes[node] = box;
        m_radii[node] = radius;
      }
      m_boxes[node].add(box);
      m_radii[node] = (std::max)(m_radii[node], radius);
    };
    for (int c = begin; c < m_layout.children_end(level, k); ++c) {
      if (level == 0) {
        const Elimination_candidate& item = m_sorted[c];
        add(c, {item.point, item.point}, item.radius);
      } else {
        const int below = m_layout.first[level - 1] + c;
        add(c, m_boxes[below], m_radii[below]);
      }
    }
  }

  Packed_tree_layout m_layout;
  Unset_vector<int> m_order;
  Elimination_candidates m_sorted;
  Unset_vector<Box3<double>> m_boxes; // of the nodes
  Unset_vector<double> m_radii;       // the largest in each node
};

/// \param cos_normal_angle candidates whose normals' dot product is below it do not see each other
///   (NVISPC)
inline Candidate_graph candidate_graph(const Elimination_candidates& candidates,
                                       double cos_normal_angle, Concurrency concurrency)
{
  constexpr int groups_per_part = Candidate_graph::part_size / Candidate_tree::group_size;
  using Neighbors = std::vector<Crowding_neighbor>;
  Candidate_tree tree(candidates, concurrency);
  Candidate_graph graph;
  graph.end.resize(candidates.size());
  graph.parts.resize(tree.groups() / groups_per_part + 1);
  for_each_chunk(concurrency, tree.groups(), groups_per_part, [&](int begin, int end) {
    Neighbors part;
    Candidate_tree::Near near;
    for (int group = begin; group < end; ++group)
      tree.for_each_neighbor(
          group, cos_normal_angle, near, [&](const auto& neighbor) { part.push_back(neighbor); },
          [&](int k) { graph.end[k] = static_cast<int>(part.size()); });
    graph.parts[begin / groups_per_part] = Neighbors(part.begin(), part.end());
  });
  graph.order = std::move(tree).order();
  return graph;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SAMPLING_CANDIDATE_GRAPH_H
