// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The direction of the lattice's rows: a field of tangents that count up to sixths of a turn
// (6-RoSy), as smooth as it can be. An angle theta in the node's tangent frame is kept as the
// phasor u = e^(6 i theta), and the field minimizes sum |u_i - t_ij u_j|^2 over the neighbors, |u|
// = 1, where t_ij carries a direction from j to i: the field of Knoeppel, Crane, Pinkall and
// Schroeder, "Globally optimal direction fields" (2013), found from coarse to fine as in Jakob,
// Tarini, Panozzo and Sorkine-Hornung, "Instant field-aligned meshes" (2015).
#ifndef CGAL_POWER_RTF_SAMPLING_ORIENTATION_FIELD_H
#define CGAL_POWER_RTF_SAMPLING_ORIENTATION_FIELD_H

#include <CGAL/PowerRTF/sampling/lattice_nodes.h>

namespace CGAL::PowerRTF {

/// The frame of a node with the normal `from`, carried to where the normal is `to`, in the frame
/// there.
CGAL_POWER_RTF_HD inline Phasor frame_turn(const Vec3f& from, const Vec3f& to)
{
  const Tangent_frame<float> from_frame(from), frame(to);
  const Vec3f u = carried(from_frame.u, from, to);
  return {dot(u, frame.u), dot(u, frame.v)};
}

/// t_ij = e^(6 i a): `a` is the angle between the frames of node `j` and node `i`, carried along
/// the surface, and what the lattice turns on the way.
CGAL_POWER_RTF_HD inline Phasor direction_turn(const Lattice_view& from, int j,
                                               const Lattice_view& to, int i)
{
  const Vec3f n = to.normals[i];
  if (!is_carried(from.normals[j], n)) return {};
  const float turns = 6 * 0.159154943f * turning_between(from, j, to, i);
  return sixth_power(frame_turn(from.normals[j], n)) * phasor_at(turns);
}

/// u of a node whose axis is known.
CGAL_POWER_RTF_HD inline Phasor axis_direction(const Lattice_view& view, int i)
{
  return sixth_power(phasor_of_quarter(view.axes[i]));
}

struct Set_direction_edges {
  Lattice_view view;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    for_each_edge(view, i, [&](Lattice_edge& edge) {
      edge.direction_turn = direction_turn(view, int(edge.node), view, i);
    });
  }
};

/// The first guess of free node i: the direction of its coarse node.
struct Refine_direction {
  Lattice_view coarse, fine;
  Phasor* result;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    const int j = coarse_node(coarse, fine, i);
    result[i] = direction_turn(coarse, j, fine, i) * axis_direction(coarse, j);
  }
};

/// One sweep: u_i <- (u_i + sum t_ij u_j) / |...|.
struct Smooth_direction {
  Lattice_view view;
  const Phasor* directions;
  const unsigned char* is_directed; ///< of the sites
  Phasor* result;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    Phasor sum = directions[i];
    if (i < view.free || !is_directed[i - view.free]) {
      for_each_edge(view, i, [&](const Lattice_edge& edge) {
        sum = sum + Phasor(edge.direction_turn) * directions[edge.node];
      });
      sum = unit(sum);
    }
    result[i] = sum;
  }
};

/// Several sweeps from `from` to `to` and back.
struct Smooth_directions {
  Lattice_view view;
  const unsigned char* is_directed; ///< of the sites
  Phasor *from, *to;

  CGAL_POWER_RTF_HD void operator()(int sweep, int i) const
  {
    const bool is_back = sweep % 2;
    Smooth_direction{view, is_back ? to : from, is_directed, is_back ? from : to}(i);
  }
};

struct Set_axis {
  Lattice_view view;
  const Phasor* directions;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    view.axes[i] = quarter_tangent(phasor_at(turns_of(directions[i]) / 6));
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_ORIENTATION_FIELD_H
