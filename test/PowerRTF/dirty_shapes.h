// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What users bring: shapes that touch, one-sided ones, and a sphere with one defect each.
#ifndef CGAL_POWER_RTF_TEST_DIRTY_SHAPES_H
#define CGAL_POWER_RTF_TEST_DIRTY_SHAPES_H

#include "shapes.h"

#include <CGAL/PowerRTF/input/near_borders.h>

#include <string>

namespace shapes {

/// Vertices at the same place become one.
inline Soup merged(const Soup& s)
{
  const std::vector<int> first = CGAL::PowerRTF::first_of_equal_points(s.points);
  Soup result;
  std::vector<int> index(s.points.size(), -1);
  for (std::size_t v = 0; v < s.points.size(); ++v)
    if (first[v] == static_cast<int>(v)) {
      index[v] = static_cast<int>(result.points.size());
      result.points.push_back(s.points[v]);
    }
  for (const Triangle& t : s.triangles)
    result.triangles.push_back({index[first[t[0]]], index[first[t[1]]], index[first[t[2]]]});
  return result;
}

/// The surface of the unit cubes at the whole numbers `(x, y, z)` from 0 to below `size` for which
/// `is_solid(x, y, z)`: `divisions` squares along each unit edge.
template <class Is_solid>
Soup voxels(const std::array<int, 3>& size, int divisions, const Is_solid& is_solid)
{
  const auto is_inside = [&](const std::array<int, 3>& p) {
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < 0 || p[axis] >= size[axis]) return false;
    return is_solid(p[0], p[1], p[2]);
  };
  Soup s;
  const auto add_side = [&](const std::array<int, 3>& cube, int axis, bool upper) {
    const auto point = [&](int i, int j) {
      double p[3] = {double(cube[0]), double(cube[1]), double(cube[2])};
      p[axis] += upper;
      p[(axis + 1) % 3] += double(i) / divisions;
      p[(axis + 2) % 3] += double(j) / divisions;
      s.points.push_back({p[0], p[1], p[2]});
      return static_cast<int>(s.points.size()) - 1;
    };
    for (int i = 0; i < divisions; ++i)
      for (int j = 0; j < divisions; ++j) {
        const int a = point(i, j), b = point(i + 1, j), c = point(i + 1, j + 1),
                  d = point(i, j + 1);
        upper ? add_quad(s, a, b, c, d) : add_quad(s, a, d, c, b);
      }
  };
  for (int x = 0; x < size[0]; ++x)
    for (int y = 0; y < size[1]; ++y)
      for (int z = 0; z < size[2]; ++z) {
        const std::array<int, 3> cube = {x, y, z};
        if (!is_inside(cube)) continue;
        for (int axis = 0; axis < 3; ++axis)
          for (const bool upper : {false, true}) {
            std::array<int, 3> neighbor = cube;
            neighbor[axis] += upper ? 1 : -1;
            if (!is_inside(neighbor)) add_side(cube, axis, upper);
          }
      }
  return merged(s);
}

/// A plate of 2 * `holes` + 1 by 3 by 1 unit cubes with `holes` square holes through it: a closed
/// surface of genus `holes`. `divisions` squares along each unit edge.
inline Soup plate_with_holes(int holes, int divisions)
{
  return voxels({2 * holes + 1, 3, 1}, divisions,
                [](int x, int y, int) { return !(x % 2 == 1 && y == 1); });
}

/// Two cubes that share what their places have in common: `shift` of 0s and 1s says along which
/// axes the second one is moved by the cubes' side. One 1: a face, two: an edge, three: a vertex.
inline Soup touching_cubes(int divisions, const Vec3d& shift)
{
  return merged(joined(box(divisions), translated(box(divisions), 2 * shift)));
}

/// A strip around the z axis with one half twist: one side, one border loop.
inline Soup moebius_strip(int steps)
{
  Soup s;
  for (int i = 0; i < steps; ++i)
    for (const int side : {-1, 1}) {
      const double u = 2 * pi * i / steps, r = 1 + 0.4 * side * std::cos(u / 2);
      s.points.push_back({r * std::cos(u), r * std::sin(u), 0.4 * side * std::sin(u / 2)});
    }
  for (int i = 0; i < steps; ++i) {
    const int a = 2 * i, b = a + 1, n = 2 * steps;
    i + 1 < steps ? add_quad(s, a, a + 2, b + 2, b) : add_quad(s, a, (b + 2) % n, (a + 2) % n, b);
  }
  return s;
}

/// The soup with each facet's vertices of its own.
inline Soup cut_into_facets(const Soup& s)
{
  Soup cut;
  for (const Triangle& t : s.triangles) {
    const int k = static_cast<int>(cut.points.size());
    for (const int v : t) cut.points.push_back(s.points[v]);
    cut.triangles.push_back({k, k + 1, k + 2});
  }
  return cut;
}

/// Moves every coordinate by up to `most`.
inline Soup shaken(Soup s, double most, unsigned seed)
{
  std::mt19937_64 random(seed);
  const auto shift = [&] { return most * (2 * double(random() >> 11) * 0x1p-53 - 1); };
  for (Vec3d& p : s.points) p += Vec3d{shift(), shift(), shift()};
  return s;
}

/// Turns every `k`th facet round.
inline Soup some_reversed(Soup s, std::size_t k)
{
  for (std::size_t f = 0; f < s.triangles.size(); f += k)
    std::swap(s.triangles[f][0], s.triangles[f][1]);
  return s;
}

/// Splits the facets around every `k`th one at a point of an edge, `height` times its length off
/// it: slivers.
inline Soup with_slivers(Soup s, std::size_t k, double height)
{
  const std::size_t facets = s.triangles.size();
  for (std::size_t f = 0; f < facets; f += k) {
    const Triangle t = s.triangles[f];
    const Vec3d a = s.points[t[0]], b = s.points[t[1]], c = s.points[t[2]];
    const int m = static_cast<int>(s.points.size());
    s.points.push_back(0.5 * (a + b) + height * (c - 0.5 * (a + b)));
    s.triangles[f] = {t[0], t[1], m};
    s.triangles.push_back({t[1], t[2], m});
    s.triangles.push_back({t[2], t[0], m});
  }
  return s;
}

/// The sphere of `icosphere(2)`, with a defect each that does not change its shape.
inline std::vector<std::pair<std::string, Soup>> dirty_spheres()
{
  const Soup sphere = icosphere(2);
  std::vector<std::pair<std::string, Soup>> all;
  all.emplace_back("clean", sphere);
  all.emplace_back("facets with vertices of their own", cut_into_facets(sphere));
  all.emplace_back("the same, torn by rounding", shaken(cut_into_facets(sphere), 1e-6, 1));
  all.emplace_back("facets the wrong way round", some_reversed(sphere, 3));
  Soup twice = sphere;
  twice.triangles.insert(twice.triangles.end(), sphere.triangles.begin(),
                         sphere.triangles.begin() + 40);
  all.emplace_back("repeated facets", twice);
  all.emplace_back("repeated facets, some the wrong way round", some_reversed(twice, 7));
  Soup unused = sphere;
  unused.points.insert(unused.points.begin(), {1000, 1000, 1000});
  for (Triangle& t : unused.triangles)
    for (int& v : t) ++v;
  unused.points.push_back({-1e6, 0, 0});
  all.emplace_back("unused vertices far away", unused);
  all.emplace_back("slivers", with_slivers(sphere, 5, 1e-4));
  all.emplace_back("finer slivers", with_slivers(sphere, 5, 1e-8));
  all.emplace_back("facets without area", with_slivers(sphere, 5, 0));
  all.emplace_back("far from the origin", translated(sphere, {1e6, -3e6, 2e6}));
  all.emplace_back("tiny", scaled(sphere, 1e-30));
  all.emplace_back("huge", scaled(sphere, 1e30));
  Soup uneven = sphere; // three facets refined again and again around their centers
  for (std::size_t f = 0, level = 0; level < 30; ++level) {
    const Triangle t = uneven.triangles[f];
    const int m = static_cast<int>(uneven.points.size());
    uneven.points.push_back((1. / 3) *
                            (uneven.points[t[0]] + uneven.points[t[1]] + uneven.points[t[2]]));
    uneven.triangles[f] = {t[0], t[1], m};
    uneven.triangles.push_back({t[1], t[2], m});
    uneven.triangles.push_back({t[2], t[0], m});
    f = level % 3 == 2 ? 10 * level : uneven.triangles.size() - 1;
  }
  all.emplace_back("facets of very different sizes", uneven);
  return all;
}

} // namespace shapes

#endif // CGAL_POWER_RTF_TEST_DIRTY_SHAPES_H
