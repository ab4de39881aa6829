// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pointed, sharp, thin, folded, noisy and one-sided shapes, and such as touch themselves.
#ifndef CGAL_POWER_RTF_TEST_ODD_SHAPES_H
#define CGAL_POWER_RTF_TEST_ODD_SHAPES_H

#include "dirty_shapes.h"
#include "random_input.h"

#include <set>

namespace shapes {

// --- deformed boxes and spheres
// --------------------------------------------------------------------------------

/// The soup with every point `p` at `map(p)`.
template <class Map>
Soup mapped(Soup s, const Map& map)
{
  for (Vec3d& p : s.points) p = map(p);
  return s;
}

/// The box of the given side lengths in 12 triangles.
inline Soup long_box(double x, double y, double z)
{
  return mapped(box(1), [=](const Vec3d& p) { return 0.5 * Vec3d{x * p.x, y * p.y, z * p.z}; });
}

/// A sphere with every `k`th vertex drawn out to the distance `reach`.
inline Soup spiked_sphere(int subdivisions, std::size_t k, double reach)
{
  Soup s = icosphere(subdivisions);
  for (std::size_t v = 0; v < s.points.size(); v += k) s.points[v] *= reach;
  return s;
}

/// A sphere with every vertex at a random distance from the center, up to `reach`.
inline Soup hedgehog(int subdivisions, double reach, unsigned seed)
{
  random_input::Random random(seed);
  return mapped(icosphere(subdivisions), [&](const Vec3d& p) { return random.real(1, reach) * p; });
}

/// The soup with its first vertex `factor` times as far from the origin.
inline Soup drawn_out(Soup s, double factor)
{
  s.points[0] *= factor;
  return s;
}

// --- thin, folded, noisy -------------------------------------------------------------------------

/// A prism along y of which the two long faces, of length 1, enclose `degrees` at the y axis.
inline Soup wedge(double degrees)
{
  const double x = std::cos(degrees * pi / 360), z = std::sin(degrees * pi / 360);
  return {{{0, -0.5, 0}, {x, -0.5, -z}, {x, -0.5, z}, {0, 0.5, 0}, {x, 0.5, -z}, {x, 0.5, z}},
          {{{0, 1, 2}},
           {{3, 5, 4}},
           {{0, 3, 4}},
           {{0, 4, 1}},
           {{1, 4, 5}},
           {{1, 5, 2}},
           {{2, 5, 3}},
           {{2, 3, 0}}}};
}

/// A height field over the unit square with independent random heights of up to `roughness`.
inline Soup terrain(int divisions, double roughness, unsigned seed)
{
  random_input::Random random(seed);
  return mapped(plane_patch(divisions, divisions), [&](const Vec3d& p) {
    return Vec3d{p.x, p.y, random.real(0, roughness)};
  });
}

/// Two concentric spheres, the inner one inside out: a hollow ball with a wall of thickness `gap`.
inline Soup shell(int subdivisions, double gap)
{
  const Soup sphere = icosphere(subdivisions);
  return joined(sphere, some_reversed(scaled(sphere, 1 - gap), 1));
}

/// A sheet folded over once: its halves are parallel, `gap` apart, joined by half a cylinder.
inline Soup hairpin(double gap)
{
  const double r = gap / 2, bend = pi * r, side = 1;
  return mapped(plane_patch(120, 20), [=](const Vec3d& p) {
    const double s = p.x * (2 * side + bend);
    if (s < side) return Vec3d{s, p.y, -r};
    if (s > side + bend) return Vec3d{2 * side + bend - s, p.y, r};
    const double u = (s - side) / r - pi / 2;
    return Vec3d{side + r * std::cos(u), p.y, r * std::sin(u)};
  });
}

/// A sheet in `folds` folds of height 1, `gap` apart.
inline Soup accordion(int folds, double gap)
{
  return mapped(plane_patch(8 * folds, 10), [=](const Vec3d& p) {
    const double fold = folds * p.x;
    return Vec3d{gap * fold, p.y, std::abs(std::remainder(fold, 2))};
  });
}

/// A ribbon of width 0.3 that winds `turns` times around the z axis.
inline Soup ribbon(int turns)
{
  return mapped(plane_patch(60 * turns, 6), [=](const Vec3d& p) {
    const double u = 2 * pi * turns * p.x, r = 1 + 0.3 * p.y;
    return Vec3d{r * std::cos(u), r * std::sin(u), 0.5 * turns * p.x};
  });
}

/// Two parallel unit squares, `gap` apart.
inline Soup two_sheets(int divisions, double gap)
{
  const Soup sheet = plane_patch(divisions, divisions);
  return joined(sheet, translated(sheet, {0, 0, gap}));
}

/// A comb of `teeth` teeth 4 high and 1 wide, `gap` apart.
inline Soup comb(int teeth, double gap, int divisions)
{
  const Soup even = voxels({2 * teeth - 1, 2, 5}, divisions,
                           [](int x, int, int z) { return x % 2 == 0 || z == 0; });
  return mapped(even, [=](const Vec3d& p) {
    const double tooth = std::floor(p.x / 2), rest = p.x - 2 * tooth;
    return Vec3d{tooth * (1 + gap) + (rest < 1 ? rest : 1 + (rest - 1) * gap), p.y, p.z};
  });
}

// --- voxels and one-sided surfaces ---------------------------------------------------------------

/// Each of `size`^3 cubes with the probability `share`. Cubes touch in edges and vertices, too.
inline Soup random_voxels(int size, double share, unsigned seed)
{
  random_input::Random random(seed);
  std::set<std::array<int, 3>> solid = {{0, 0, 0}};
  for (int x = 0; x < size; ++x)
    for (int y = 0; y < size; ++y)
      for (int z = 0; z < size; ++z)
        if (random.real(0, 1) < share) solid.insert({x, y, z});
  return voxels({size, size, size}, 1, [&](int x, int y, int z) {
    return solid.count({x, y, z}) > 0;
  });
}

/// Stairs of `steps` steps of one cube each.
inline Soup stairs(int steps)
{
  return voxels({steps, 2, steps}, 1, [](int x, int, int z) { return z <= x; });
}

/// The cube of 3^`level` cubes along each edge with square holes of all sizes through it.
inline Soup menger_sponge(int level)
{
  int size = 1;
  for (int k = 0; k < level; ++k) size *= 3;
  return voxels({size, size, size}, 1, [=](int x, int y, int z) {
    for (; x > 0 || y > 0 || z > 0; x /= 3, y /= 3, z /= 3)
      if ((x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1) > 1) return false;
    return true;
  });
}

/// Klein's bottle as the figure eight that turns over on its way around the z axis: closed,
/// one-sided, crosses itself along a circle.
inline Soup klein_bottle(int nu, int nv)
{
  Soup s;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double u = 2 * pi * i / nu, v = 2 * pi * j / nv;
      const double across = std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
      const double up = std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
      s.points.push_back({(3 + across) * std::cos(u), (3 + across) * std::sin(u), up});
    }
  const auto at = [=](int i, int j) {
    return i < nu ? i * nv + j % nv : (2 * nv - j) % nv; // turned over after a whole turn
  };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j)
      add_quad(s, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return s;
}

} // namespace shapes

#endif // CGAL_POWER_RTF_TEST_ODD_SHAPES_H
