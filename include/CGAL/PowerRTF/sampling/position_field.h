// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the lattice's points lie: each node has the phases of the three waves (`Waves`) that have
// their crests in the lattice's points. From a neighbor they come with the phase that the waves
// pass through on the way, b_k d turns, and the field minimizes sum |w_i - t_ij w_j|^2, |w| = 1.
// Phases that do not fit around a loop make a dislocation: a row ends there. (The position field
// of Jakob, Tarini, Panozzo and Sorkine-Hornung, "Instant field-aligned meshes", 2015, with the
// phases of Knoeppel, Crane, Pinkall and Schroeder, "Stripe patterns on surfaces", 2015.)
#ifndef CGAL_POWER_RTF_SAMPLING_POSITION_FIELD_H
#define CGAL_POWER_RTF_SAMPLING_POSITION_FIELD_H

#include <CGAL/PowerRTF/sampling/lattice_nodes.h>

namespace CGAL::PowerRTF {

/// A vector in the frame of a node's axis, in units of the spacing.
struct Lattice_vector {
  float x, y;
};

/// `v`, of the given length, in a frame: unrolled, not projected.
CGAL_POWER_RTF_HD inline Lattice_vector unrolled(const Lattice_frame& frame, float spacing,
                                                 const Vec3f& v, float length)
{
  const float x = dot(v, frame.axis), y = dot(v, frame.left);
  const float flat = std::sqrt(x * x + y * y);
  const float factor = length / ((flat > 0.1f * length ? flat : 0.1f * length) * spacing);
  return length > 0 ? Lattice_vector{factor * x, factor * y} : Lattice_vector{0, 0};
}

/// The way from one node to another in the other's lattice.
struct Lattice_step {
  int sixths;      ///< of a turn, from the axis that is reached to the one that is left
  float phases[2]; ///< what the first two waves pass through, in turns
};

/// From node `j` to node `i`, whose frame is `own`; the phases are the means of those that the two
/// nodes see.
CGAL_POWER_RTF_HD inline Lattice_step lattice_step(const Lattice_view& from, int j,
                                                   const Lattice_view& to, int i,
                                                   const Lattice_frame& own)
{
  const Lattice_frame other = from.frame(j);
  const Vec3f axis = carried(other.axis, from.normals[j], to.normals[i]);
  const Phasor turned = // from the axis of i to that of j
      Phasor{dot(axis, own.axis), dot(axis, own.left)} *
      phasor_at(0.159154943f * turning_between(from, j, to, i));
  // Of the axes at 0, 1 and 2 sixths of a turn, the one that is nearest, or its opposite.
  constexpr float half = 0.5f, root = 0.866025404f; // sqrt 3 / 2
  const float cosines[3] = {1, half, -half}, sines[3] = {0, root, root};
  int sixths = 0;
  float most = turned.x;
  for (int k = 1; k < 3; ++k) {
    const float along = turned.x * cosines[k] + turned.y * sines[k];
    if (!(std::fabs(along) > std::fabs(most))) continue;
    most = along;
    sixths = k;
  }
  const float sign = most < 0 ? -1.f : 1.f;
  const Phasor best{sign * cosines[sixths], sign * sines[sixths]};
  if (most < 0) sixths += 3;
  const Vec3f d = step_between(from, j, to, i);
  const float distance = length(d);
  const Lattice_vector here = unrolled(own, to.spacing(i), d, distance),
                       there = unrolled(other, from.spacing(j), d, distance);
  const float x = 0.5f * (here.x + best.x * there.x - best.y * there.y);
  const float y = 0.5f * (here.y + best.y * there.x + best.x * there.y);
  constexpr float slope = 0.577350269f; // 1 / sqrt 3
  return {sixths, {x - slope * y, 2 * slope * y}};
}

/// What the waves of node `j` need to become those of node `i`: the waves seen from a lattice that
/// is turned by sixths, and the phases of the way.
CGAL_POWER_RTF_HD inline Lattice_edge
wave_edge(const Lattice_view& from, int j, const Lattice_view& to, int i, const Lattice_frame& own)
{
  const Lattice_step step = lattice_step(from, j, to, i, own);
  Lattice_edge edge(unsigned(j), unsigned(step.sixths));
  for (int k = 0; k < 2; ++k) edge.turns[k] = Short_turn(step.phases[k]);
  return edge;
}

/// The waves of the edge's node as they arrive.
CGAL_POWER_RTF_HD inline Waves carried(const Lattice_edge& edge, const Stored_waves& from)
{
  const Phasor first = edge.turns[0], second = edge.turns[1];
  const Phasor turn[] = {first, second, conjugate(first * second)};
  Waves to;
  for (int k = 0; k < Waves::size; ++k) {
    const Phasor wave = from.wave[(unsigned(k) + edge.sixths) % Waves::size];
    to.wave[k] = turn[k] * (edge.sixths % 2 ? conjugate(wave) : wave);
  }
  return to;
}

CGAL_POWER_RTF_HD inline Stored_waves stored(const Waves& w)
{
  return {{w.wave[0], w.wave[1], w.wave[2]}};
}

struct Set_wave_edges {
  Lattice_view view;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    const Lattice_frame own = view.frame(i);
    for_each_edge(
        view, i, [&](Lattice_edge& edge) { edge = wave_edge(view, int(edge.node), view, i, own); });
  }
};

/// The first guess of free node i: the lattice of its coarse node.
struct Refine_waves {
  Lattice_view coarse, fine;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    const int j = coarse_node(coarse, fine, i);
    const bool has_guess = is_carried(coarse.normals[j], fine.normals[i]);
    fine.waves[i] =
        stored(has_guess ? carried(wave_edge(coarse, j, fine, i, fine.frame(i)), coarse.waves[j])
                         : Waves{});
  }
};

/// One sweep: w_i <- (a v + (1 - a) w'_i) / |...| with v = (w_i + sum t_ij w_j) / |...|, the waves
/// w' of the sweep before and a >= 1: what is smooth over many nodes comes twice as fast with a
/// = 1.6 as with v alone (a = 1). (Golub, Varga, "Chebyshev semi-iterative methods, successive
/// overrelaxation iterative methods, and second order Richardson iterative methods", 1961.)
struct Smooth_waves {
  Lattice_view view;
  Stored_waves* result; ///< w' before
  float acceleration;   ///< a; 1: w' is not read

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    const Stored_waves& own = view.waves[i];
    Waves sum{{own.wave[0], own.wave[1], own.wave[2]}};
    for_each_edge(view, i, [&](const Lattice_edge& edge) {
      const Waves waves = carried(edge, view.waves[edge.node]);
      for (int k = 0; k < Waves::size; ++k) sum.wave[k] = sum.wave[k] + waves.wave[k];
    });
    for (int k = 0; k < Waves::size; ++k) {
      const Phasor v = unit(sum.wave[k]), before = result[i].wave[k];
      const float a = acceleration;
      result[i].wave[k] =
          a > 1 ? unit({a * v.x + (1 - a) * before.x, a * v.y + (1 - a) * before.y}) : v;
    }
  }
};

/// Several sweeps from the waves of `view` to `result` and back.
struct Smooth_waves_repeatedly {
  Lattice_view view;
  Stored_waves* result;

  CGAL_POWER_RTF_HD void operator()(int sweep, int i) const
  {
    constexpr float acceleration = 1.6f; // without: 30 and 15 sweeps
    Smooth_waves rule{view, result, sweep == 0 ? 1 : acceleration};
    if (sweep % 2) {
      rule.result = view.waves;
      rule.view.waves = result;
    }
    rule(i);
  }
};

/// The lattice's point that is nearest to node i, in the node's tangent plane; `distance`: from the
/// node, relative to the spacing.
CGAL_POWER_RTF_HD inline Vec3f nearest_lattice_point(const Lattice_view& view, int i,
                                                     float& distance)
{
  const Stored_waves& w = view.waves[i];
  const float phases[] = {turns_of(w.wave[0]), turns_of(w.wave[1]), turns_of(w.wave[2])};
  // The three have the sum 0 but for full turns; what is left is shared.
  const float sum = phases[0] + phases[1] + phases[2];
  const float excess = (sum - nearest_integer(sum)) / 3;
  float x = 0, y = 0, best = 3e38f;
  for (int m = -1; m <= 1; ++m)
    for (int n = -1; n <= 1; ++n) { // node - p = a (1, 0) + b (1/2, sqrt 3 / 2)
      const float a = phases[0] - excess + float(m), b = phases[1] - excess + float(n);
      const float from_x = a + 0.5f * b, from_y = 0.866025404f * b;
      const float squared = from_x * from_x + from_y * from_y;
      if (squared >= best) continue;
      best = squared;
      x = from_x;
      y = from_y;
    }
  distance = std::sqrt(best);
  const Lattice_frame frame = view.frame(i);
  return view.points[i] - view.spacing(i) * (x * frame.axis + y * frame.left);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_POSITION_FIELD_H
