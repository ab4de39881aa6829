// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_FOR_EACH_NODE_H
#define CGAL_POWER_RTF_GEOMETRY_FOR_EACH_NODE_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>

namespace CGAL::PowerRTF::internal {

/// Calls `f(level, k)` for node `k` of each level of a tree, for its children before. A thread goes
/// three levels up by itself: the higher ones are too small to be shared one by one.
template <class F>
void for_each_node(Concurrency concurrency, const Packed_tree_layout& tree, F&& f)
{
  constexpr int levels = 3, arity = Packed_tree_layout::arity;
  for (int bottom = 0; bottom < tree.levels; bottom += levels) {
    const int top = (std::min)(bottom + levels, tree.levels);
    for_each_chunk(concurrency, tree.nodes(bottom), arity * arity, [&](int begin, int end) {
      for (int level = bottom; level < top; ++level) {
        for (int k = begin; k < end; ++k) f(level, k);
        begin /= arity;
        end = (end + arity - 1) / arity;
      }
    });
  }
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_FOR_EACH_NODE_H
