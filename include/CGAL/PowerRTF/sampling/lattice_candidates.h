// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the points of a lattice, and from its nodes, to what may become samples.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_CANDIDATES_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_CANDIDATES_H

#include <CGAL/PowerRTF/sampling/Lattice_field_base.h>
#include <CGAL/PowerRTF/sampling/Lattice_plan.h>
#include <CGAL/PowerRTF/sampling/crowding.h>
#include <CGAL/PowerRTF/sampling/lattice_gaps.h>
#include <CGAL/PowerRTF/sampling/lattice_points.h>

#include <cstdint>

namespace CGAL::PowerRTF {

/// The free nodes whose points are those of the lattice.
struct Mark_chosen {
  Choose_points choose;
  const Component_share* shares;
  unsigned char* result;
  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    result[i] = has_lattice(shares[choose.view.components[i]]) && choose(i);
  }
};

struct Find_mean_points {
  Lattice_view view;
  const Seen_point* seen;
  const int* chosen;
  int* nodes;
  Seen_point* points;
  CGAL_POWER_RTF_HD void operator()(int k) const
  {
    nodes[k] = chosen[k];
    points[k] = {mean_seen_point(view, seen, chosen[k]), seen[chosen[k]].distance};
  }
};

/// The free nodes in gaps, and those of components without lattice.
struct Mark_gap_or_small {
  Mark_gap mark_gap;
  const Component_share* shares;
  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    if (has_lattice(shares[mark_gap.placed.nodes.components[i]]))
      mark_gap(i);
    else
      mark_gap.is_gap[i] = 1;
  }
};

struct Mark_components {
  const int* components;
  const unsigned char* is_wanted;
  unsigned char* result;
  CGAL_POWER_RTF_HD void operator()(int i) const { result[i] = is_wanted[components[i]]; }
};

/// Of points of the lattice, and then of nodes.
struct Make_candidate {
  Lattice_view view;
  Strata_view strata;
  std::uint64_t seed; ///< of the level
  int points;
  const int* seen_from; ///< of the points
  const Seen_point* seen;
  const int* nodes;
  Sample_candidate* result;

  CGAL_POWER_RTF_HD void operator()(int k) const
  {
    const bool is_point = k < points;
    const int i = is_point ? seen_from[k] : nodes[k - points];
    const Seen_point p = is_point ? seen[k] : Seen_point{view.points[i], -1};
    const int facet = strata.facet(strata.place(i, view.free, seed));
    result[k] = {
        p.point,
        p.distance,
        {view.points[i], view.normals[i], view.node_spacing[i], view.components[i], facet}};
  }
};

/// Of a point whose neighbors in a lattice are `spacing` away.
CGAL_POWER_RTF_HD inline internal::Elimination_candidate
elimination_candidate(const Vec3f& point, const Vec3f& normal, float spacing)
{
  return {to_double(point), to_double(normal), 0.5 * double(spacing)};
}
CGAL_POWER_RTF_HD inline internal::Elimination_candidate
elimination_candidate(const Sample_candidate& c)
{
  return elimination_candidate(c.point, c.node.normal, c.node.spacing);
}

/// The candidate i, or the site `i - free` on creases and borders.
struct As_elimination_candidate {
  Lattice_view view;
  int free;
  const Sample_candidate* candidates;

  CGAL_POWER_RTF_HD internal::Elimination_candidate operator()(int i) const
  {
    if (i < free) return elimination_candidate(candidates[i]);
    const int k = view.free + i - free;
    return elimination_candidate(view.points[k], view.normals[k], view.node_spacing[k]);
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_CANDIDATES_H
