// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A packed R-tree over items that are already in spatial order: node k of level 0 covers the items
// 8k .. 8k+7, node k of a level above the nodes 8k .. 8k+7 of the level below. There are no
// pointers; to refit after the items have moved is to recompute the boxes level by level. The
// order of the items only affects speed, never a result. (Kamel and Faloutsos, "On packing
// R-trees", 1993.)
#ifndef CGAL_POWER_RTF_GEOMETRY_PACKED_TREE_H
#define CGAL_POWER_RTF_GEOMETRY_PACKED_TREE_H

#include <CGAL/PowerRTF/geometry/vector.h>

namespace CGAL::PowerRTF {

namespace internal {
template <class FT>
CGAL_POWER_RTF_HD inline FT larger(FT a, FT b)
{
  return a > b ? a : b;
}
template <class FT>
CGAL_POWER_RTF_HD inline FT smaller(FT a, FT b)
{
  return a < b ? a : b;
}
} // namespace internal

/// An axis-aligned box.
template <class FT>
struct Box3 {
  Vec3<FT> lo, hi;

  CGAL_POWER_RTF_HD void add(const Vec3<FT>& p) { add(Box3{p, p}); }
  CGAL_POWER_RTF_HD void add(const Box3& b)
  {
    lo = {internal::smaller(b.lo.x, lo.x), internal::smaller(b.lo.y, lo.y),
          internal::smaller(b.lo.z, lo.z)};
    hi = {internal::larger(b.hi.x, hi.x), internal::larger(b.hi.y, hi.y),
          internal::larger(b.hi.z, hi.z)};
  }
};

/// Squared distance of two boxes; 0 where they overlap.
template <class FT>
CGAL_POWER_RTF_HD inline FT squared_distance(const Box3<FT>& a, const Box3<FT>& b)
{
  using internal::larger;
  const FT dx = larger(larger(b.lo.x - a.hi.x, a.lo.x - b.hi.x), FT(0));
  const FT dy = larger(larger(b.lo.y - a.hi.y, a.lo.y - b.hi.y), FT(0));
  const FT dz = larger(larger(b.lo.z - a.hi.z, a.lo.z - b.hi.z), FT(0));
  return dx * dx + dy * dy + dz * dz;
}

/// Squared distance of a box and a point; 0 inside.
template <class FT>
CGAL_POWER_RTF_HD inline FT squared_distance(const Box3<FT>& b, const Vec3<FT>& p)
{
  using internal::larger; // one instruction each: a branch would be guessed wrong half of the time
  const FT dx = larger(larger(b.lo.x - p.x, p.x - b.hi.x), FT(0));
  const FT dy = larger(larger(b.lo.y - p.y, p.y - b.hi.y), FT(0));
  const FT dz = larger(larger(b.lo.z - p.z, p.z - b.hi.z), FT(0));
  return dx * dx + dy * dy + dz * dz;
}

/// The shape of a packed tree over `items` items: how its nodes lie in one array. Node k of level 0
/// covers the items from k * Arity on, node k of a level above as many nodes of the level below.
template <int Arity, int Max_levels>
struct Basic_tree_layout {
  static constexpr int arity = Arity, max_levels = Max_levels; // arity^max_levels > 2^31 items

  int items = 0;
  int levels = 0;                 ///< level `levels - 1` holds the root alone
  int first[max_levels + 1] = {}; ///< first node of each level; first[levels]: number of nodes

  CGAL_POWER_RTF_HD explicit Basic_tree_layout(int number_of_items = 0) : items(number_of_items)
  {
    int below = items;
    while (below > 1 || (levels == 0 && below > 0)) {
      below = (below + arity - 1) / arity;
      first[levels + 1] = first[levels] + below;
      ++levels;
    }
  }

  CGAL_POWER_RTF_HD int nodes() const { return first[levels]; }
  CGAL_POWER_RTF_HD int nodes(int level) const { return first[level + 1] - first[level]; }
  /// What the nodes of `level` cover: items (level 0), or the nodes of the level below.
  CGAL_POWER_RTF_HD int below(int level) const { return level == 0 ? items : nodes(level - 1); }

  /// Children of node `k` of `level`.
  CGAL_POWER_RTF_HD int children_begin(int k) const { return k * arity; }
  CGAL_POWER_RTF_HD int children_end(int level, int k) const
  {
    return (k + 1) * arity < below(level) ? (k + 1) * arity : below(level);
  }
};

/// The tree of the CPU.
struct Packed_tree_layout : Basic_tree_layout<8, 11> {
  using Basic_tree_layout::Basic_tree_layout;
  /// Nodes that wait in a depth-first traversal: at most 7 siblings per level, and the last 8.
  static constexpr int stack_size = 7 * max_levels + 1;
};

/// Visits the tree's leaves depth first. `enter(node)` tells whether a node (its position in the
/// array of nodes) is worth visiting; `leaf(begin, end)` receives the items of a leaf.
template <class Enter, class Leaf>
CGAL_POWER_RTF_HD inline void traverse(const Packed_tree_layout& tree, Enter&& enter, Leaf&& leaf)
{
  if (tree.items == 0) return;
  struct Pending {
    int level, node;
  };
  Pending stack[Packed_tree_layout::stack_size];
  int size = 0;
  stack[size++] = {tree.levels - 1, 0};
  while (size > 0) {
    const Pending top = stack[--size];
    const int begin = tree.children_begin(top.node), end = tree.children_end(top.level, top.node);
    if (top.level == 0) {
      leaf(begin, end);
      continue;
    }
    const int first = tree.first[top.level - 1];
    for (int child = end - 1; child >= begin; --child)
      if (enter(first + child)) stack[size++] = {top.level - 1, child};
  }
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_PACKED_TREE_H
