// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The projection of one sample by eight lanes: each looks at one child of a node and at one facet
// of a leaf. For few samples, where one thread for each would leave most of the GPU idle.
#ifndef CGAL_POWER_RTF_CUDA_PROJECTION_BY_LANES_CUH
#define CGAL_POWER_RTF_CUDA_PROJECTION_BY_LANES_CUH

#include "../device/Eight_lanes.cuh"
#include "Surface_view.h"

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// The result of `project_to_nearest_facet()` with a `Single_lane`, in all lanes.
template <class Real>
__device__ inline Surface_point<Real>
project_to_nearest_facet(const Surface_view<Real>& view, const Vec3<Real>& p,
                         const Vec3<Real>& normal, Real cos_angle, int hint, Eight_lanes lanes)
{
  static_assert(Eight_lanes::size == Packed_tree_layout::arity, "one lane for each child");
  constexpr float none = 3e38f;
  const int patch = view.patches ? view.patches[hint] : 0, rank = lanes.rank();
  const Packed_tree_layout& tree = view.facet_tree;
  const float q[3] = {float(p.x), float(p.y), float(p.z)};
  Surface_point<Real> best; // of this lane
  float bound = none;       // of all
  const auto test = [&](int place) {
    if (view.patches && view.patches[place] != patch) return;
    const Facet_corners<Real> f = view.facets[place];
    if (cos_angle > -1 && !(dot(f.normal, normal) > cos_angle)) return;
    const Vec3<Real> x = nearest_point_on_triangle(p, f.a, f.b, f.c);
    const Real d = squared_length(x - p);
    if (best.facet < 0 || d < best.squared_distance ||
        (d == best.squared_distance && place < best.facet)) {
      best = {x, place, d};
    }
  };
  const auto lower_bound = [&]() {
    bound = lanes.least(best.facet < 0 ? none : bound_of(best.squared_distance));
  };
  if (lanes.leads()) test(hint);
  lower_bound();

  float pending[Packed_tree_layout::max_levels]; // of this lane's child, by level; none: done
  int level = tree.levels - 1, node = 0;
  for (bool is_new = true;;) {
    if (is_new) {
      const Child_boxes& boxes = view.facet_nodes[tree.first[level] + node];
      float sum = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const float outside =
            fmaxf(fabsf(q[axis] - boxes.center[axis][rank]) - boxes.half[axis][rank], 0.f);
        sum += outside * outside;
      }
      const bool is_there = node * Eight_lanes::size + rank < tree.children_end(level, node);
      pending[level] = is_there ? sum : none;
    }
    const float mine = pending[level] <= bound ? pending[level] : none;
    if (level == 0) {
      if (mine < none && node * Eight_lanes::size + rank != hint)
        test(node * Eight_lanes::size + rank);
      lower_bound();
    }
    const float nearest = level == 0 ? none : lanes.least(mine);
    if (!(nearest < none)) { // nothing left here: up
      if (++level >= tree.levels) break;
      node /= Eight_lanes::size;
      is_new = false;
      continue;
    }
    const int next = lanes.first_with(mine == nearest);
    if (rank == next) pending[level] = none;
    node = node * Eight_lanes::size + next;
    --level;
    is_new = true;
  }

#pragma unroll
  for (int step = Eight_lanes::size / 2; step > 0; step /= 2) {
    const Surface_point<Real> other = {{lanes.exchanged(best.point.x, step),
                                        lanes.exchanged(best.point.y, step),
                                        lanes.exchanged(best.point.z, step)},
                                       lanes.exchanged(best.facet, step),
                                       lanes.exchanged(best.squared_distance, step)};
    if (other.facet >= 0 &&
        (best.facet < 0 || other.squared_distance < best.squared_distance ||
         (other.squared_distance == best.squared_distance && other.facet < best.facet)))
      best = other;
  }
  return best;
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_PROJECTION_BY_LANES_CUH
