// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that may become samples, and how much they crowd each other (Yuksel 2015, "Sample
// Elimination for Generating Poisson Disk Sample Sets").
#ifndef CGAL_POWER_RTF_SAMPLING_CROWDING_H
#define CGAL_POWER_RTF_SAMPLING_CROWDING_H

#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/host_device.h>

#include <cmath>

namespace CGAL::PowerRTF::internal {

/// A point that may become a sample.
struct Elimination_candidate {
  Vec3d point;
  Vec3d normal;
  double radius; ///< half the distance of samples that are packed as densely as possible
};

using Elimination_candidates = Unset_vector<Elimination_candidate>;

/// Another candidate, by its place in spatial order, that is closer than the sum of the radii.
struct Crowding_neighbor {
  int place;
  double crowding; ///< Yuksel's weight, from 0 (radii touch) to 1 (same point)
};

/// Yuksel's weight (alpha = 8) of candidates at a distance below `reach`, the sum of their radii.
CGAL_POWER_RTF_HD inline double crowding(double squared_distance, double reach)
{
  const double free = 1 - std::sqrt(squared_distance) / reach;
  const double free_2 = free * free, free_4 = free_2 * free_2;
  return free_4 * free_4;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SAMPLING_CROWDING_H
