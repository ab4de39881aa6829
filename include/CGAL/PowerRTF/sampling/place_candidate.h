// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a candidate, which is near the surface, to a point of it.
#ifndef CGAL_POWER_RTF_SAMPLING_PLACE_CANDIDATE_H
#define CGAL_POWER_RTF_SAMPLING_PLACE_CANDIDATE_H

#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/sampling/Lattice_field_base.h>
#include <CGAL/PowerRTF/sampling/Surface_strata.h>

namespace CGAL::PowerRTF {

/// Of the normal of a candidate's node and those of the facets that it may be put on.
constexpr double cos_same_side = 0.2;

/// How far the foot of the perpendicular from `p` to the plane of a facet is outside the facet.
template <class Real>
CGAL_POWER_RTF_HD Real distance_beyond(const Facet_corners<Real>& f, const Vec3<Real>& p)
{
  const Vec3<Real> foot = p - dot(p - f.a, f.normal) * f.normal;
  return length(foot - nearest_point_on_triangle(foot, f.a, f.b, f.c));
}

/// The candidate's point on `nearest`, the facet nearest to it on the node's side of a sheet; the
/// node itself where there is none (-1), and for a point of the lattice beyond a border, whose
/// nearest point is on it. `corners`: function place -> facet.
template <class Real, class Corners>
CGAL_POWER_RTF_HD Surface_point<Real> place_candidate(const Sample_candidate& candidate,
                                                      const Surface_cube& cube, int nearest,
                                                      const Corners& corners)
{
  constexpr double max_beyond = 0.05; // relative to the spacing
  const Lattice_node& node = candidate.node;
  const double h = double(node.spacing) / cube.scale;
  Surface_point<Real> result;
  result.facet = nearest < 0 ? node.facet : nearest;
  Vec3<Real> point = to_real<Real>(cube.to_outside(to_double(candidate.point)));
  if (distance_beyond(corners(result.facet), point) > Real(max_beyond * h)) {
    point = to_real<Real>(cube.to_outside(to_double(node.point)));
    result.facet = node.facet;
  }
  const Facet_corners<Real> f = corners(result.facet);
  result.point = nearest_point_on_triangle(point, f.a, f.b, f.c);
  result.squared_distance = squared_length(result.point - point);
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_PLACE_CANDIDATE_H
