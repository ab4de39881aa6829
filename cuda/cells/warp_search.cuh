// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A warp's search in the tree of arity 32: one child per lane, several nodes at a time to overlap
// the latencies of their loads.
#ifndef CGAL_POWER_RTF_CUDA_WARP_SEARCH_CUH
#define CGAL_POWER_RTF_CUDA_WARP_SEARCH_CUH

#include "Lane_cell.h"
#include "warp_reductions.cuh"

namespace CGAL::PowerRTF::device {

/// Calls `on_sites(reached, site, place)` on all lanes together for every group of 32 sites that
/// the query reaches; `reached`: the lane's site is one that the query is about. `stack`: the
/// warp's.
template <class Real, class F>
__device__ inline void search_sites(const Group_view<Real>& view, Search_stack& stack,
                                    const Group_query<Real>& query, int lane, F&& on_sites)
{
  constexpr int at_once = Search_stack::at_once;
  const unsigned below_lane = (1u << lane) - 1;
  int size = 1;
  if (lane == 0) stack.nodes[0] = view.tree.nodes() - 1;
  __syncwarp();
  while (size > 0) {
    const int taken = size <= Search_stack::crowded ? min(size, at_once) : 1;
    Vec3<Real> lo[at_once], hi[at_once];
    Real weight[at_once];
    int first_child[at_once]; // of nodes: their place in the array; of sites: theirs
    bool exists[at_once], is_leaf[at_once];
#pragma unroll
    for (int k = 0; k < at_once; ++k) {
      exists[k] = is_leaf[k] = false;
      if (k >= taken) continue;
      const int node = stack.nodes[size - 1 - k];
      int level = 0;
      while (node >= view.tree.first[level + 1]) ++level;
      const int child = (node - view.tree.first[level]) * Group_layout::arity;
      exists[k] = child + lane < view.tree.below(level);
      is_leaf[k] = level == 0;
      first_child[k] = level == 0 ? child : view.tree.first[level - 1] + child;
      if (!exists[k]) continue;
      if (level == 0) {
        const Packed_site<Real> site = load(view.sites + first_child[k] + lane);
        lo[k] = hi[k] = site.point;
        weight[k] = site.weight;
      } else {
        const Group_node<Real> box = load(view.nodes + first_child[k] + lane);
        lo[k] = box.lo;
        hi[k] = box.hi;
        weight[k] = box.max_weight;
      }
    }
    size -= taken;
    __syncwarp();
#pragma unroll
    for (int k = 0; k < at_once; ++k) {
      if (k >= taken) continue;
      const bool reached = exists[k] && query.reaches(lo[k], hi[k], weight[k]);
      if (is_leaf[k]) {
        on_sites(reached, Packed_site<Real>{lo[k], weight[k]}, first_child[k] + lane);
      } else {
        const unsigned lanes = __ballot_sync(full_warp, reached);
        if (reached) stack.nodes[size + __popc(lanes & below_lane)] = first_child[k] + lane;
        size += __popc(lanes);
      }
    }
    __syncwarp();
  }
}

/// Calls `on_groups(reached, group)` on all lanes together; `reached`: the query is about sites of
/// the lane's `group`. Small trees are searched without their upper levels, to overlap
/// the latencies of all loads.
template <class Real, class F>
__device__ inline void search_groups(const Group_view<Real>& view, Search_stack& stack,
                                     const Group_query<Real>& query, int lane, F&& on_groups)
{
  constexpr int max_rows = 4; // of 32 groups
  const int groups = view.tree.nodes(0);
  const bool is_small = groups <= 32 * max_rows;
  int size = 1;
  if (!is_small && lane == 0) stack.nodes[0] = view.tree.nodes() - 1;
  __syncwarp();
  while (size > 0) {
    int first = 0, rows = 1;
    unsigned reached = 0; // bit k: group first + 32 k + lane
    --size;
    if (is_small) {
      rows = (groups + 31) / 32;
#pragma unroll
      for (int k = 0; k < max_rows; ++k) {
        const int group = 32 * k + lane;
        if (group >= groups) continue;
        const Group_node<Real> box = load(view.nodes + group);
        if (query.reaches(box.lo, box.hi, box.max_weight)) reached |= 1u << k;
      }
    } else {
      const int node = stack.nodes[size];
      int level = 1;
      while (node >= view.tree.first[level + 1]) ++level;
      first = (node - view.tree.first[level]) * Group_layout::arity;
      const int child = view.tree.first[level - 1] + first + lane;
      if (first + lane < view.tree.below(level)) {
        const Group_node<Real> box = load(view.nodes + child);
        reached = query.reaches(box.lo, box.hi, box.max_weight);
      }
      __syncwarp();
      if (level > 1) {
        const unsigned lanes = __ballot_sync(full_warp, reached != 0);
        if (reached) stack.nodes[size + __popc(lanes & ((1u << lane) - 1))] = child;
        size += __popc(lanes);
        __syncwarp();
        continue;
      }
    }
#pragma unroll 1
    for (int k = 0; k < rows; ++k) on_groups((reached >> k & 1) != 0, first + 32 * k + lane);
  }
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WARP_SEARCH_CUH
