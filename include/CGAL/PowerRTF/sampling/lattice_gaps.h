// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the fields of a lattice do not fit: there points come twice, and there are gaps between
// them.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_GAPS_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_GAPS_H

#include <CGAL/PowerRTF/geometry/Point_tree.h>
#include <CGAL/PowerRTF/sampling/lattice_nodes.h>
#include <CGAL/PowerRTF/sampling/lattice_points.h>

namespace CGAL::PowerRTF {

/// Points, and the node that each is seen from.
struct Placed_points {
  Lattice_view nodes;
  Point_tree_view<double> tree;
  const int* seen_from;
  const float* distances; ///< from there, relative to the spacing

  CGAL_POWER_RTF_HD bool are_on_one_side(int i, int j) const
  {
    return nodes.components[i] == nodes.components[j] &&
           dot(nodes.normals[i], nodes.normals[j]) > 0;
  }
};

/// Makes the points from those that were given, and then from sites on creases and borders.
struct Place_points {
  Lattice_view nodes;
  int given;
  const int* given_from; ///< the node that each of these is seen from
  const Seen_point* seen;
  int* seen_from;
  Vec3d* points;
  float* distances;

  CGAL_POWER_RTF_HD void operator()(int p) const
  {
    seen_from[p] = p < given ? given_from[p] : nodes.free + p - given;
    points[p] = to_double(p < given ? seen[p].point : nodes.points[seen_from[p]]);
    distances[p] = p < given ? seen[p].distance : 0;
  }
};

/// Whether there is another point nearly at the same place that is nearer to its node.
struct Mark_twin {
  Placed_points placed;
  unsigned char* is_twin;

  CGAL_POWER_RTF_HD void operator()(int p) const
  {
    constexpr double nearly = 0.6; // relative to the spacing
    const int i = placed.seen_from[p];
    const float distance = placed.distances[p];
    is_twin[p] = placed.tree.any_near(
        placed.tree.points[p], nearly * double(placed.nodes.spacing(i)), [&](int o) {
          const float other = placed.distances[o];
          return o != p && placed.are_on_one_side(i, placed.seen_from[o]) &&
                 (other < distance || (other == distance && o < p));
        });
  }
};

/// Whether no point is near a node.
struct Mark_gap {
  Placed_points placed;
  unsigned char* is_gap;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    constexpr double radius = 0.7; // relative to the spacing
    is_gap[i] = !placed.tree.any_near(
        to_double(placed.nodes.points[i]), radius * double(placed.nodes.spacing(i)),
        [&](int o) { return placed.are_on_one_side(i, placed.seen_from[o]); });
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_GAPS_H
