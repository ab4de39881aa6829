// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Boxes in a packed tree along a Hilbert curve, and the pairs of them that overlap.
#ifndef CGAL_POWER_RTF_GEOMETRY_BOX_TREE_H
#define CGAL_POWER_RTF_GEOMETRY_BOX_TREE_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/geometry/box_around.h>
#include <CGAL/PowerRTF/geometry/for_each_node.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The boxes of a tree node's children side by side, so that one loop over them is one run of
/// vector instructions.
struct Sibling_boxes {
  static constexpr int size = Packed_tree_layout::arity;
  float lo[3][size], hi[3][size]; ///< by axis

  void set(int child, const Box3<float>& box)
  {
    const float los[3] = {box.lo.x, box.lo.y, box.lo.z}, his[3] = {box.hi.x, box.hi.y, box.hi.z};
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis][child] = los[axis];
      hi[axis][child] = his[axis];
    }
  }

  Box3<float> operator[](int child) const
  {
    return {{lo[0][child], lo[1][child], lo[2][child]}, {hi[0][child], hi[1][child], hi[2][child]}};
  }

  /// The box around all.
  Box3<float> around() const
  {
    Box3<float> box = (*this)[0];
    for (int child = 1; child < size; ++child) box.add((*this)[child]);
    return box;
  }

  /// Writes the numbers of the children that overlap `box`. \returns how many these are
  int overlapping(const Box3<float>& box, int (&children)[size]) const
  {
    float gap[size]; // at most 0 where they overlap
    for (int child = 0; child < size; ++child) {
      const float x = larger(lo[0][child] - box.hi.x, box.lo.x - hi[0][child]),
                  y = larger(lo[1][child] - box.hi.y, box.lo.y - hi[1][child]),
                  z = larger(lo[2][child] - box.hi.z, box.lo.z - hi[2][child]);
      gap[child] = larger(larger(x, y), z);
    }
    int count = 0;
    for (int child = 0; child < size; ++child) { // without branches: they would be guessed wrong
      children[count] = child;
      count += int(gap[child] <= 0);
    }
    return count;
  }
};

/// The boxes are rounded to single precision in the unit box: that keeps the order of numbers, so
/// boxes that overlap still do; some that nearly do may count, too.
class Box_tree {
public:
  /// `boxes`: finite.
  Box_tree(const Unset_vector<Box3<double>>& boxes, Concurrency concurrency)
      : m_concurrency(concurrency), m_tree(int(boxes.size())), m_nodes(m_tree.nodes())
  {
    if (boxes.empty()) return;
    const Box3<double> all = box_around(concurrency, int(boxes.size()), boxes);
    const Vec3d middle = 0.5 * all.lo + 0.5 * all.hi, half = 0.5 * all.hi - 0.5 * all.lo;
    const double reach = std::max({half.x, half.y, half.z});
    const auto inside = [&](double x, double center) {
      return reach > 0 ? float((x - center) / reach) : 0.f;
    };
    const auto point = [&](const Vec3d& p) {
      return Vec3<float>{inside(p.x, middle.x), inside(p.y, middle.y), inside(p.z, middle.z)};
    };
    sort_items(boxes);
    for_each_node(concurrency, m_tree, [&](int level, int k) {
      Sibling_boxes& node = m_nodes[m_tree.first[level] + k];
      const int begin = m_tree.children_begin(k), end = m_tree.children_end(level, k);
      for (int c = begin; c < begin + Sibling_boxes::size; ++c)
        node.set(c - begin, c >= end     ? nothing()
                            : level == 0 ? Box3<float>{point(boxes[m_items[c]].lo),
                                                       point(boxes[m_items[c]].hi)}
                                         : m_nodes[m_tree.first[level - 1] + c].around());
    });
  }

  /// The pairs of boxes, by number, that overlap, of which one at least `is_wanted(i)`, and with
  /// `test(i, j)`; each once, in an order that is the same for any number of threads.
  template <class IsWanted, class Test>
  std::vector<std::pair<int, int>> pairs(IsWanted&& is_wanted, Test&& test) const
  {
    constexpr int leaves_per_chunk = 16;
    const int leaves = m_tree.levels > 0 ? m_tree.nodes(0) : 0;
    Wanted wanted{Unset_vector<char>(m_items.size()), Unset_vector<int>(leaves + 1)};
    for_each_index(m_concurrency, leaves, [&](int leaf) {
      int& count = wanted.before[leaf] = 0;
      for (int place = m_tree.children_begin(leaf); place < m_tree.children_end(0, leaf); ++place)
        count += wanted.is_wanted[place] = is_wanted(m_items[place]);
    });
    wanted.before[leaves] = 0;
    exclusive_scan(m_concurrency, leaves + 1, wanted.before.data());
    std::vector<std::vector<std::pair<int, int>>> parts(leaves / leaves_per_chunk + 1);
    for_each_chunk(m_concurrency, leaves, leaves_per_chunk, [&](int begin, int end) {
      for (int leaf = begin; leaf < end; ++leaf)
        if (wanted.before[leaf] < wanted.before[leaf + 1])
          find_pairs(leaf, wanted, test, parts[begin / leaves_per_chunk]);
    });
    return concatenated(m_concurrency, parts);
  }

private:
  struct Wanted {
    Unset_vector<char> is_wanted; // by place in the tree
    Unset_vector<int> before;     // by leaf: the wanted ones in the leaves before it

    /// Whether all in these leaves are.
    bool are_all(int begin, int end) const
    {
      return before[end] - before[begin] == (end - begin) * Sibling_boxes::size;
    }
  };

  static Box3<float> nothing()
  {
    constexpr float x = std::numeric_limits<float>::infinity();
    return {{x, x, x}, {-x, -x, -x}};
  }

  void sort_items(const Unset_vector<Box3<double>>& boxes)
  {
    Unset_vector<Vec3d> centers(boxes.size());
    for_each_index(m_concurrency, int(boxes.size()),
                   [&](int i) { centers[i] = 0.5 * boxes[i].lo + 0.5 * boxes[i].hi; });
    m_items = spatial_order(centers, m_concurrency);
  }

  // Of a leaf.
  Box3<float> box_of(int leaf) const
  {
    constexpr int arity = Sibling_boxes::size;
    return m_tree.levels > 1 ? m_nodes[m_tree.first[1] + leaf / arity][leaf % arity]
                             : m_nodes[leaf].around();
  }

  // Those with a wanted box in a leaf; of two wanted ones the first in the tree finds the other.
  template <class Test>
  void find_pairs(int leaf, const Wanted& wanted, Test&& test,
                  std::vector<std::pair<int, int>>& found) const
  {
    const Sibling_boxes& boxes = m_nodes[leaf];
    const Box3<float> around = box_of(leaf);
    int children[Sibling_boxes::size], others[Sibling_boxes::size];
    const auto meet = [&](int other) {
      const Sibling_boxes& its_boxes = m_nodes[other];
      const int count = boxes.overlapping(box_of(other), children);
      for (int k = 0; k < count; ++k) {
        const int a = m_tree.children_begin(leaf) + children[k];
        if (!wanted.is_wanted[a]) continue;
        const int met = its_boxes.overlapping(boxes[children[k]], others);
        for (int l = 0; l < met; ++l) {
          const int b = m_tree.children_begin(other) + others[l];
          if (b != a && !(b < a && wanted.is_wanted[b]) && test(m_items[a], m_items[b]))
            found.emplace_back(m_items[a], m_items[b]);
        }
      }
    };
    struct Pending {
      int level, node;
    };
    Pending stack[Packed_tree_layout::stack_size];
    int size = 0;
    stack[size++] = {m_tree.levels - 1, 0};
    while (size > 0) {
      const Pending top = stack[--size];
      const int shift = 3 * top.level, begin = top.node << shift,
                end = std::min((top.node + 1) << shift, m_tree.nodes(0));
      if (end <= leaf && wanted.are_all(begin, end)) continue; // they find this leaf
      if (top.level == 0) {
        meet(top.node);
        continue;
      }
      int nodes[Sibling_boxes::size];
      for (int k = m_nodes[m_tree.first[top.level] + top.node].overlapping(around, nodes); k > 0;)
        stack[size++] = {top.level - 1, m_tree.children_begin(top.node) + nodes[--k]};
    }
  }

  Concurrency m_concurrency;
  Packed_tree_layout m_tree;
  std::vector<int> m_items; // by place in the tree
  Unset_vector<Sibling_boxes> m_nodes;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_BOX_TREE_H
