// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Searches in a packed tree by lanes that work on one item together.
#ifndef CGAL_POWER_RTF_CUDA_TREE_BY_LANES_CUH
#define CGAL_POWER_RTF_CUDA_TREE_BY_LANES_CUH

#include <CGAL/PowerRTF/geometry/Surface_view.h>

namespace CGAL::PowerRTF::device {

/// More than any squared distance.
constexpr float no_distance = 3e38f;

/// Lower bound of the squared distance of `query` to the child of a node that is this lane's;
/// `no_distance` where there is none.
template <class Lanes>
__device__ inline float child_distance(const Packed_tree_layout& tree, const Child_boxes* nodes,
                                       int level, int node, const float (&query)[3], Lanes lanes)
{
  const int child = lanes.rank() % Packed_tree_layout::arity;
  const Child_boxes& boxes = nodes[tree.first[level] + node];
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float outside =
        fmaxf(fabsf(query[axis] - boxes.center[axis][child]) - boxes.half[axis][child], 0.f);
    sum += outside * outside;
  }
  const bool is_there = node * Packed_tree_layout::arity + child < tree.children_end(level, node);
  return is_there ? sum : no_distance;
}

/// Calls `visit(node)` with all lanes for the nodes of level 0 that are no farther from `query`
/// than `bound`, near ones first; `visit` may lower the bound, for all lanes alike.
template <class Lanes, class Visit>
__device__ inline void visit_near_leaves(const Packed_tree_layout& tree, const Child_boxes* nodes,
                                         const float (&query)[3], const float& bound, Lanes lanes,
                                         Visit visit)
{
  constexpr int arity = Packed_tree_layout::arity;
  float pending[Packed_tree_layout::max_levels]; // of this lane's child, by level
  int level = tree.levels - 1, node = 0;
  for (bool is_new = true;;) {
    float mine = no_distance, nearest = no_distance;
    if (level == 0) {
      visit(node);
    } else {
      if (is_new) pending[level] = child_distance(tree, nodes, level, node, query, lanes);
      mine = pending[level] <= bound ? pending[level] : no_distance;
      nearest = lanes.least_of_eight(mine);
    }
    if (!(nearest < no_distance)) { // nothing left here: up
      if (++level >= tree.levels) break;
      node /= arity;
      is_new = false;
      continue;
    }
    const int next = lanes.first_with(mine == nearest);
    if (lanes.rank() % arity == next) pending[level] = no_distance;
    node = node * arity + next;
    --level;
    is_new = true;
  }
}

/// The nearest of the lanes' points, of equal ones that with the lowest `key`; in all lanes. Keys
/// differ.
template <class Real, class Lanes>
__device__ inline Surface_point<Real> nearest_of_lanes(const Surface_point<Real>& own, int key,
                                                       Lanes lanes)
{
  Real least = own.facet < 0 ? Real(1e30) : own.squared_distance;
  int least_key = own.facet < 0 ? 0x7fffffff : key;
#pragma unroll
  for (int step = Lanes::size / 2; step > 0; step /= 2) {
    const Real other = lanes.exchanged(least, step);
    const int other_key = lanes.exchanged(least_key, step);
    if (other < least || (other == least && other_key < least_key)) {
      least = other;
      least_key = other_key;
    }
  }
  const int lane = lanes.first_with(own.facet >= 0 && key == least_key);
  if (lane < 0) return own; // none
  return {
      {lanes.from(own.point.x, lane), lanes.from(own.point.y, lane), lanes.from(own.point.z, lane)},
      lanes.from(own.facet, lane),
      least};
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_TREE_BY_LANES_CUH
