// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the fields to the points of the lattice.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_POINTS_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_POINTS_H

#include <CGAL/PowerRTF/sampling/position_field.h>

namespace CGAL::PowerRTF {

/// The lattice's point that a node sees nearest to itself.
struct Seen_point {
  Vec3d point;
  float distance; ///< from the node, relative to the spacing; -1: the node is a site and the point
};

struct See_points {
  Lattice_view view;
  Seen_point* result;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    result[i] = {view.points[i], -1};
    if (i < view.free) result[i].point = nearest_lattice_point(view, i, result[i].distance);
  }
};

/// Several nodes see each point, a little differently where the field is not perfect. The one that
/// is nearest to its point has a say: the mean of what it and its neighbors see.
struct Choose_points {
  Lattice_view view;
  const Seen_point* seen;
  unsigned char* is_chosen;
  Vec3d* result;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    constexpr float same = 0.5f, sure = 0.3f; // distances relative to the spacing
    const Seen_point own = seen[i];
    const double h = view.spacing[i];
    bool is_nearest = true;
    Vec3d sum = own.point;
    int count = 1;
    for_each_edge(view, i, [&](const Lattice_edge& edge) {
      const Seen_point other = seen[edge.node];
      const double squared = squared_length(other.point - own.point);
      if (squared > same * same * h * h) return;
      if (other.distance < own.distance || (other.distance == own.distance && int(edge.node) < i))
        is_nearest = false;
      if (squared > sure * sure * h * h) return;
      sum += other.point;
      ++count;
    });
    is_chosen[i] = is_nearest;
    result[i] = (1. / count) * sum;
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_POINTS_H
