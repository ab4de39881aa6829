// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boxes in a packed tree along a Hilbert curve, and the pairs of them that overlap.
#ifndef CGAL_POWER_RTF_GEOMETRY_BOX_TREE_H
#define CGAL_POWER_RTF_GEOMETRY_BOX_TREE_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

inline bool do_overlap(const Box3<double>& a, const Box3<double>& b)
{
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
         a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

class Box_tree {
public:
  /// `boxes`: finite.
  Box_tree(const Unset_vector<Box3<double>>& boxes, Concurrency concurrency)
      : m_concurrency(concurrency), m_tree(int(boxes.size())), m_boxes(boxes.size()),
        m_nodes(m_tree.nodes())
  {
    if (boxes.empty()) return;
    sort_items(boxes);
    for (int level = 0; level < m_tree.levels; ++level) {
      const Box3<double>* below = level == 0 ? m_boxes.data() : &m_nodes[m_tree.first[level - 1]];
      for_each_index(concurrency, m_tree.nodes(level), [&](int k) {
        Box3<double> box = below[m_tree.children_begin(k)];
        for (int c = m_tree.children_begin(k) + 1; c < m_tree.children_end(level, k); ++c)
          box.add(below[c]);
        m_nodes[m_tree.first[level] + k] = box;
      });
    }
  }

  /// The pairs of boxes, by number, that overlap, of which one at least `is_wanted(i)`, and with
  /// `test(i, j)`; each once, in an order that is the same for any number of threads.
  template <class IsWanted, class Test>
  std::vector<std::pair<int, int>> pairs(IsWanted&& is_wanted, Test&& test) const
  {
    constexpr int leaves_per_chunk = 16;
    Unset_vector<char> wanted(m_items.size()); // by place in the tree
    for_each_index(m_concurrency, int(wanted.size()),
                   [&](int place) { wanted[place] = is_wanted(m_items[place]); });
    const int leaves = m_tree.levels > 0 ? m_tree.nodes(0) : 0;
    std::vector<std::vector<std::pair<int, int>>> parts(leaves / leaves_per_chunk + 1);
    for_each_chunk(m_concurrency, leaves, leaves_per_chunk, [&](int begin, int end) {
      for (int leaf = begin; leaf < end; ++leaf)
        find_pairs(leaf, wanted, test, parts[begin / leaves_per_chunk]);
    });
    std::vector<std::pair<int, int>> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
  }

private:
  void sort_items(const Unset_vector<Box3<double>>& boxes)
  {
    Unset_vector<Vec3d> centers(boxes.size());
    for_each_index(m_concurrency, int(boxes.size()),
                   [&](int i) { centers[i] = 0.5 * boxes[i].lo + 0.5 * boxes[i].hi; });
    m_items = spatial_order(centers, m_concurrency);
    for_each_index(m_concurrency, int(boxes.size()),
                   [&](int place) { m_boxes[place] = boxes[m_items[place]]; });
  }

  // Those with a wanted box in a leaf; of two wanted ones the first in the tree finds the other.
  template <class Test>
  void find_pairs(int leaf, const Unset_vector<char>& wanted, Test&& test,
                  std::vector<std::pair<int, int>>& found) const
  {
    const int first = m_tree.children_begin(leaf), last = m_tree.children_end(0, leaf);
    if (std::none_of(&wanted[first], &wanted[last - 1] + 1, [](char w) { return w; })) return;
    const auto meet = [&](int a, int begin, int end) {
      for (int b = begin; b < end; ++b)
        if (b != a && !(wanted[b] && b < a) && do_overlap(m_boxes[a], m_boxes[b]) &&
            test(m_items[a], m_items[b]))
          found.emplace_back(m_items[a], m_items[b]);
    };
    traverse(
        m_tree, [&](int node) { return do_overlap(m_nodes[node], m_nodes[leaf]); },
        [&](int begin, int end) {
          const Box3<double>& box = m_nodes[begin / Packed_tree_layout::arity];
          for (int a = first; a < last; ++a)
            if (wanted[a] && do_overlap(m_boxes[a], box)) meet(a, begin, end);
        });
  }

  Concurrency m_concurrency;
  Packed_tree_layout m_tree;
  std::vector<int> m_items;           // by place in the tree
  Unset_vector<Box3<double>> m_boxes; // by place
  Unset_vector<Box3<double>> m_nodes;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_BOX_TREE_H
