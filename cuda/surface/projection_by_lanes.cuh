// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The projection of one sample by eight lanes: each looks at one child of a node and at one facet
// of a leaf. For few samples, where one thread for each would leave most of the GPU idle.
#ifndef CGAL_POWER_RTF_CUDA_PROJECTION_BY_LANES_CUH
#define CGAL_POWER_RTF_CUDA_PROJECTION_BY_LANES_CUH

#include "../backend/Eight_lanes.cuh"
#include "tree_by_lanes.cuh"

namespace CGAL::PowerRTF::device {

/// The result of `project_to_nearest_facet()` with a `Single_lane`, in all lanes.
template <class Real>
__device__ inline Surface_point<Real>
project_to_nearest_facet(const Surface_view<Real>& view, const Vec3<Real>& p,
                         const Vec3<Real>& normal, Real cos_angle, int hint, Eight_lanes lanes)
{
  static_assert(Eight_lanes::size == Packed_tree_layout::arity, "one lane for each child");
  const Facet_query<Real> query(view, p, normal, cos_angle, hint);
  const float q[3] = {float(p.x), float(p.y), float(p.z)};
  Surface_point<Real> best{}; // of this lane
  float bound = no_distance;  // of all
  const auto lower_bound = [&]() {
    bound = lanes.least_of_eight(best.facet < 0 ? no_distance : bound_of(best.squared_distance));
  };
  if (lanes.leads()) best = query.onto(hint);
  lower_bound();
  visit_near_leaves(view.facet_tree, view.facet_nodes, q, bound, lanes, [&](int node) {
    const int place = node * Eight_lanes::size + lanes.rank();
    const float d = child_distance(view.facet_tree, view.facet_nodes, 0, node, q, lanes);
    if (d < no_distance && d <= bound && place != hint) {
      const Surface_point<Real> x = query.onto(place);
      if (is_nearer(x, place, best, best.facet)) best = x;
    }
    lower_bound();
  });
  return nearest_of_lanes(best, best.facet, lanes);
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_PROJECTION_BY_LANES_CUH
