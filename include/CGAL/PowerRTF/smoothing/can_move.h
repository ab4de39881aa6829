// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SMOOTHING_CAN_MOVE_H
#define CGAL_POWER_RTF_SMOOTHING_CAN_MOVE_H

#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

namespace CGAL::PowerRTF::internal {

/// Whether the center of a star can move from `p` to `q`: no triangle turns by more than an angle,
/// given by its cosine, and none that was better gets more badness than `limit`.
/// \tparam Star calls `f` for its triangles, as `Star_view::Star`
template <class Star>
CGAL_POWER_RTF_HD bool can_move(const Star& star, const Vec3d& p, const Vec3d& q,
                                double max_turn_cosine, double limit)
{
  bool result = true;
  star.for_each([&](const auto& c) {
    if (!result) return;
    const Vec3d before = cross(c.a - p, c.b - p), after = cross(c.a - q, c.b - q);
    const double badness = triangle_badness(q, c.a, c.b).badness;
    result = dot(before, after) > max_turn_cosine * length(before) * length(after) &&
             !(badness > limit && badness > triangle_badness(p, c.a, c.b).badness);
  });
  return result;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_CAN_MOVE_H
