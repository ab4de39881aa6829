// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces through a sequence of closed polygons (loops) with equally many vertices: cones, prisms,
// tubes, gears. Loops run counter-clockwise, seen from where the next loop lies.
#ifndef CGAL_POWER_RTF_TEST_SWEEPS_H
#define CGAL_POWER_RTF_TEST_SWEEPS_H

#include "shapes.h"

namespace shapes {

using Loop = std::vector<Vec3d>;

/// A polygon around the z axis at height `z`: vertex i at the angle 2 pi i / `sides`, its distance
/// from the axis is `radius(i)`.
template <class Radius>
Loop loop_around_z(int sides, double z, const Radius& radius)
{
  Loop loop;
  for (int i = 0; i < sides; ++i) {
    const double u = 2 * pi * i / sides;
    loop.push_back({radius(i) * std::cos(u), radius(i) * std::sin(u), z});
  }
  return loop;
}

inline Loop circle(int sides, double z, double radius)
{
  return loop_around_z(sides, z, [=](int) { return radius; });
}

/// The wall through the loops, open at both ends; `closed`: from the last loop to the first, too.
inline Soup wall(const std::vector<Loop>& loops, bool closed = false)
{
  Soup s;
  for (const Loop& loop : loops) s.points.insert(s.points.end(), loop.begin(), loop.end());
  const int count = static_cast<int>(loops.size()), sides = static_cast<int>(loops[0].size());
  const auto at = [=](int k, int i) { return (k % count) * sides + i % sides; };
  for (int k = 0; k + 1 < count + closed; ++k)
    for (int i = 0; i < sides; ++i)
      add_quad(s, at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i));
  return s;
}

/// The wall through the loops, closed by a fan around `first` and one around `last`.
inline Soup spindle(const Vec3d& first, const std::vector<Loop>& loops, const Vec3d& last)
{
  Soup s = wall(loops);
  const int sides = static_cast<int>(loops[0].size()), end = static_cast<int>(s.points.size());
  s.points.push_back(first);
  s.points.push_back(last);
  for (int i = 0; i < sides; ++i) {
    const int j = (i + 1) % sides;
    s.triangles.push_back({end, j, i});
    s.triangles.push_back({end + 1, end - sides + i, end - sides + j});
  }
  return s;
}

/// A solid cone around the z axis, its base in z = 0; the side has `rows` rows of facets.
inline Soup cone(int sides, double radius, double height, int rows)
{
  std::vector<Loop> loops;
  for (int k = 0; k < rows; ++k)
    loops.push_back(circle(sides, height * k / rows, radius * (rows - k) / rows));
  return spindle({0, 0, 0}, loops, {0, 0, height});
}

/// Two cones with the same base: tips at `height` above it and `depth` below it.
inline Soup double_cone(int sides, double radius, double height, double depth)
{
  return spindle({0, 0, -depth}, {circle(sides, 0, radius)}, {0, 0, height});
}

/// A prism over a star in z = 0 with `points` points at distance 1, the corners between them at
/// distance `inner`.
inline Soup star_prism(int points, double inner, double height)
{
  const auto star = [=](double z) {
    return loop_around_z(2 * points, z, [=](int i) { return i % 2 == 0 ? 1 : inner; });
  };
  return spindle({0, 0, 0}, {star(0), star(height)}, {0, 0, height});
}

/// The loops of a tube of circles around the curve `center`, of which the tangent is never along z.
template <class Curve>
std::vector<Loop> tube(int steps, int sides, double radius, const Curve& center)
{
  std::vector<Loop> loops;
  for (int k = 0; k < steps; ++k) {
    const Vec3d tangent = normalized(center(k + 0.5) - center(k - 0.5)),
                across = normalized(cross(Vec3d{0, 0, 1}, tangent)), up = cross(tangent, across);
    Loop loop = circle(sides, 0, radius);
    for (Vec3d& p : loop) p = center(k) + p.x * across + p.y * up;
    loops.push_back(loop);
  }
  return loops;
}

/// A wire of radius `wire` wound around the z axis at distance 1, `pitch` higher with each turn.
inline Soup coil_spring(int turns, double pitch, double wire, int steps_per_turn, int sides)
{
  const int steps = turns * steps_per_turn + 1;
  const auto center = [=](double k) {
    const double turn = k / steps_per_turn, u = 2 * pi * turn;
    return Vec3d{std::cos(u), std::sin(u), pitch * turn};
  };
  return spindle(center(0), tube(steps, sides, wire, center), center(steps - 1));
}

/// A trefoil knot as a closed tube.
inline Soup trefoil_knot(int steps, int sides, double radius)
{
  const auto center = [=](double k) {
    const double u = 2 * pi * k / steps, r = 2 + std::cos(3 * u);
    return Vec3d{r * std::cos(2 * u), r * std::sin(2 * u), std::sin(3 * u)};
  };
  return wall(tube(steps, sides, radius, center), true);
}

} // namespace shapes

#endif // CGAL_POWER_RTF_TEST_SWEEPS_H
