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
  Vec3f point;
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
/// is nearest to its point has a say.
struct Choose_points {
  Lattice_view view;
  const Seen_point* seen;

  CGAL_POWER_RTF_HD bool operator()(int i) const
  {
    constexpr float same = 0.5f; // distance relative to the spacing
    const Seen_point own = seen[i];
    const float radius = same * view.spacing(i);
    bool is_nearest = true;
    for_each_edge(view, i, [&](const Lattice_edge& edge) {
      const Seen_point other = seen[edge.node];
      if (squared_length(other.point - own.point) > radius * radius) return;
      if (other.distance < own.distance || (other.distance == own.distance && int(edge.node) < i))
        is_nearest = false;
    });
    return is_nearest;
  }
};

/// The point of a chosen node: the mean of what it and its neighbors see.
CGAL_POWER_RTF_HD inline Vec3f mean_seen_point(const Lattice_view& view, const Seen_point* seen,
                                               int i)
{
  constexpr float sure = 0.3f; // distance relative to the spacing
  const Vec3f own = seen[i].point;
  const float radius = sure * view.spacing(i);
  Vec3f sum{0, 0, 0}; // from there
  int count = 1;
  for_each_edge(view, i, [&](const Lattice_edge& edge) {
    const Vec3f d = seen[edge.node].point - own;
    if (squared_length(d) > radius * radius) return;
    sum += d;
    ++count;
  });
  return own + (1.f / float(count)) * sum;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_POINTS_H
