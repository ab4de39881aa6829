// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mechanical parts as a CAD program exports them: flat faces in few long facets, narrow chamfers
// and fillets. Lengths in mm.
#ifndef CGAL_POWER_RTF_TEST_CAD_SHAPES_H
#define CGAL_POWER_RTF_TEST_CAD_SHAPES_H

#include "sweeps.h"

namespace shapes {

/// A polygon around the z axis, moved inwards by `distance`: each side keeps its direction.
inline Loop inset(const Loop& loop, double distance)
{
  const std::size_t count = loop.size();
  const auto inwards = [&](std::size_t i) { // normal of the side from vertex i
    return normalized(cross(Vec3d{0, 0, 1}, loop[(i + 1) % count] - loop[i % count]));
  };
  Loop result;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d a = inwards(i + count - 1), b = inwards(i);
    result.push_back(loop[i] + (distance / (1 + dot(a, b))) * (a + b));
  }
  return result;
}

/// A gear around the z axis from z = 0 to z = 8, 40 across, with a bore; the rims of its teeth are
/// cut off at 45 degrees by `chamfer`, 0: not at all.
inline Soup gear(double chamfer)
{
  const int teeth = 12, sides = 4 * teeth;
  const double tip = 20, root = 16, bore = 5, height = 8;
  const double place[4] = {0, 0.4, 0.5, 0.9}; // within a tooth's share of the circle
  const auto profile = [&](double z, double cut) {
    Loop loop;
    for (int i = 0; i < sides; ++i) {
      const double u = 2 * pi * (i / 4 + place[i % 4]) / teeth, r = i % 4 < 2 ? root : tip;
      loop.push_back({r * std::cos(u), r * std::sin(u), z});
    }
    return inset(loop, cut);
  };
  std::vector<Loop> loops = {circle(sides, 0, bore), profile(0, chamfer)};
  if (chamfer > 0) {
    loops.push_back(profile(chamfer, 0));
    loops.push_back(profile(height - chamfer, 0));
  }
  loops.push_back(profile(height, chamfer));
  loops.push_back(circle(sides, height, bore));
  return wall(loops, true);
}

/// A round hole through the plate between the quadrangles `top` (counter-clockwise, seen from
/// outside) and `bottom` (the vertices on the other side), which it adds, too.
inline void add_plate_with_hole(Soup& s, const std::array<int, 4>& top,
                                const std::array<int, 4>& bottom, double radius)
{
  const int quarter = 8, first = static_cast<int>(s.points.size());
  const auto center = [&](const std::array<int, 4>& q) {
    return 0.25 * (s.points[q[0]] + s.points[q[1]] + s.points[q[2]] + s.points[q[3]]);
  };
  const Vec3d x = normalized(s.points[top[1]] - s.points[top[0]]),
              y = normalized(s.points[top[3]] - s.points[top[0]]);
  const Vec3d centers[2] = {center(top), center(bottom)};
  for (int i = 0; i < 4 * quarter; ++i)
    for (const Vec3d& c : centers) {
      const double u = pi + 2 * pi * i / (4 * quarter);
      s.points.push_back(c + radius * std::cos(u) * x + radius * std::sin(u) * y);
    }
  const auto at = [=](int i, int side) { return first + 2 * (i % (4 * quarter)) + side; };
  for (int i = 0; i < 4 * quarter; ++i) {
    s.triangles.push_back({top[i / quarter], at(i + 1, 0), at(i, 0)});
    s.triangles.push_back({bottom[i / quarter], at(i, 1), at(i + 1, 1)});
    add_quad(s, at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1));
  }
  for (int k = 0; k < 4; ++k) {
    s.triangles.push_back({top[k], top[(k + 1) % 4], at((k + 1) * quarter, 0)});
    s.triangles.push_back({bottom[(k + 1) % 4], bottom[k], at((k + 1) * quarter, 1)});
  }
}

/// A plate, 5 thick, of `columns` by `rows` squares of 30, each with a round hole of radius 8.
inline Soup drilled_plate(int columns, int rows)
{
  const double thickness = 5, square = 30, hole = 8;
  Soup s;
  for (int i = 0; i <= columns; ++i)
    for (int j = 0; j <= rows; ++j)
      for (const double z : {0., thickness}) s.points.push_back({i * square, j * square, z});
  const auto bottom = [=](int i, int j) { return 2 * (i * (rows + 1) + j); };
  const auto top = [=](int i, int j) { return bottom(i, j) + 1; };
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j)
      add_plate_with_hole(s, {top(i, j), top(i + 1, j), top(i + 1, j + 1), top(i, j + 1)},
                          {bottom(i, j), bottom(i + 1, j), bottom(i + 1, j + 1), bottom(i, j + 1)},
                          hole);
  const auto add_side = [&](int i, int j, int k, int l) { // counter-clockwise, seen from the top
    add_quad(s, bottom(i, j), bottom(k, l), top(k, l), top(i, j));
  };
  for (int i = 0; i < columns; ++i) {
    add_side(i, 0, i + 1, 0);
    add_side(i + 1, rows, i, rows);
  }
  for (int j = 0; j < rows; ++j) {
    add_side(columns, j, columns, j + 1);
    add_side(0, j + 1, 0, j);
  }
  return s;
}

/// Two plates at a right angle with a round hole each, 4 thick and 30 wide; along the inner edge a
/// fillet of radius `fillet`, the outer edge is rounded about the same axis.
inline Soup bracket(double fillet, int steps)
{
  const double thickness = 4, width = 30, length = 60, height = 45, hole = 6;
  Soup s;
  // Four vertices at each station on the way from one plate's end to the other's.
  const auto add_station = [&](double x, double z, double outer_x, double outer_z) {
    for (const Vec3d& p : {Vec3d{x, 0, z}, Vec3d{x, width, z}, Vec3d{outer_x, width, outer_z},
                           Vec3d{outer_x, 0, outer_z}})
      s.points.push_back(p);
  };
  add_station(length, thickness, length, 0);
  const double axis = thickness + fillet;
  for (int k = 0; k <= steps; ++k) {
    const double u = -pi / 2 * (1 + double(k) / steps), c = std::cos(u), d = std::sin(u);
    add_station(axis + fillet * c, axis + fillet * d, axis + axis * c, axis + axis * d);
  }
  add_station(thickness, height, 0, height);

  const auto at = [](int k, int i) { return 4 * k + i % 4; };
  const int last = steps + 2;
  for (int k = 0; k < last; ++k) {
    const bool is_plate = k == 0 || k == last - 1;
    for (int i = is_plate ? 1 : 0; i < 4; i += is_plate ? 2 : 1)
      add_quad(s, at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i));
    if (is_plate)
      add_plate_with_hole(s, {at(k, 0), at(k, 1), at(k + 1, 1), at(k + 1, 0)},
                          {at(k, 3), at(k, 2), at(k + 1, 2), at(k + 1, 3)}, hole);
  }
  add_quad(s, at(0, 3), at(0, 2), at(0, 1), at(0, 0));
  add_quad(s, at(last, 0), at(last, 1), at(last, 2), at(last, 3));
  return s;
}

} // namespace shapes

#endif // CGAL_POWER_RTF_TEST_CAD_SHAPES_H
