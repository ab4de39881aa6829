// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes built in code, so that tests need no files. Closed shapes are oriented outwards.
#ifndef CGAL_POWER_RTF_TEST_SHAPES_H
#define CGAL_POWER_RTF_TEST_SHAPES_H

#include <CGAL/PowerRTF/input/import_surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace shapes {

using CGAL::PowerRTF::Surface;
using CGAL::PowerRTF::Triangle;
using CGAL::PowerRTF::Vec3d;

constexpr double pi = 3.14159265358979323846;

struct Soup {
  std::vector<Vec3d> points;
  std::vector<Triangle> triangles;
};

/// Adds the two triangles of the quadrangle `a b c d` (counter-clockwise).
inline void add_quad(Soup& soup, int a, int b, int c, int d)
{
  soup.triangles.push_back({a, b, c});
  soup.triangles.push_back({a, c, d});
}

/// Each triangle from its smallest index on, in lexicographic order: equal for equal meshes.
inline std::vector<Triangle> sorted(std::vector<Triangle> triangles)
{
  for (Triangle& t : triangles)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// --- polyhedra -----------------------------------------------------------------------------------

inline Soup tetrahedron()
{
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
          {{{0, 1, 2}}, {{0, 3, 1}}, {{0, 2, 3}}, {{1, 3, 2}}}};
}

inline Soup octahedron()
{
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{{0, 2, 4}},
           {{2, 1, 4}},
           {{1, 3, 4}},
           {{3, 0, 4}},
           {{2, 0, 5}},
           {{1, 2, 5}},
           {{3, 1, 5}},
           {{0, 3, 5}}}};
}

inline Soup icosahedron()
{
  const double g = (1 + std::sqrt(5.)) / 2;
  Soup s;
  s.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  s.triangles = {{{0, 11, 5}}, {{0, 5, 1}},  {{0, 1, 7}},   {{0, 7, 10}}, {{0, 10, 11}},
                 {{1, 5, 9}},  {{5, 11, 4}}, {{11, 10, 2}}, {{10, 7, 6}}, {{7, 1, 8}},
                 {{3, 9, 4}},  {{3, 4, 2}},  {{3, 2, 6}},   {{3, 6, 8}},  {{3, 8, 9}},
                 {{4, 9, 5}},  {{2, 4, 11}}, {{6, 2, 10}},  {{8, 6, 7}},  {{9, 8, 1}}};
  for (Vec3d& p : s.points) p = normalized(p);
  return s;
}

/// The unit sphere: `20 * 4^subdivisions` facets.
inline Soup icosphere(int subdivisions)
{
  Soup s = icosahedron();
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<int, int>, int> midpoints;
    const auto midpoint = [&](int a, int b) {
      const auto [it, is_new] =
          midpoints.insert({std::minmax(a, b), static_cast<int>(s.points.size())});
      if (is_new) s.points.push_back(normalized(s.points[a] + s.points[b]));
      return it->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle& t : s.triangles) {
      const int a = midpoint(t[0], t[1]), b = midpoint(t[1], t[2]), c = midpoint(t[2], t[0]);
      finer.insert(finer.end(), {{{t[0], a, c}}, {{t[1], b, a}}, {{t[2], c, b}}, {{a, b, c}}});
    }
    s.triangles = std::move(finer);
  }
  return s;
}

/// A unit ball with three thin needles of length 1.
inline Soup ball_with_needles()
{
  Soup soup = icosphere(4);
  for (Vec3d& p : soup.points)
    for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{-0.6, 0.8, 0}, Vec3d{0, -0.6, 0.8}}) {
      const double height = dot(p, axis);
      if (height > 0.99) p = p + (height - 0.99) * 100 * axis;
    }
  return soup;
}

/// The axis-parallel ellipsoid with half-axes `a`, `b`, `c`.
inline Soup ellipsoid(double a, double b, double c, int subdivisions)
{
  Soup s = icosphere(subdivisions);
  for (Vec3d& p : s.points) p = {a * p.x, b * p.y, c * p.z};
  return s;
}

/// A torus around the z axis: `nu` steps around the axis (radius `R`), `nv` around the tube (`r`).
inline Soup torus(int nu, int nv, double R, double r)
{
  Soup s;
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j) {
      const double u = 2 * pi * i / nu, v = 2 * pi * j / nv, d = R + r * std::cos(v);
      s.points.push_back({d * std::cos(u), d * std::sin(u), r * std::sin(v)});
    }
  const auto at = [=](int i, int j) { return (i % nu) * nv + j % nv; };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j)
      add_quad(s, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return s;
}

/// The cube [-1, 1]^3 with `divisions` squares along each edge.
inline Soup box(int divisions)
{
  Soup s;
  std::map<std::array<int, 3>, int> index;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [it, is_new] = index.insert({p, static_cast<int>(s.points.size())});
    if (is_new)
      s.points.push_back(
          {2. * p[0] / divisions - 1, 2. * p[1] / divisions - 1, 2. * p[2] / divisions - 1});
    return it->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < divisions; ++i)
        for (int j = 0; j < divisions; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> p;
            p[axis] = side * divisions;
            p[(axis + 1) % 3] = i + di;
            p[(axis + 2) % 3] = j + dj;
            return vertex(p);
          };
          const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          side == 1 ? add_quad(s, a, b, c, d) : add_quad(s, a, d, c, b);
        }
  return s;
}

// --- surfaces with borders, several components, close sheets -------------------------------------

/// The unit square in z = 0, seen from above: `nx * ny` squares, one border loop.
inline Soup plane_patch(int nx, int ny)
{
  Soup s;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) s.points.push_back({double(i) / nx, double(j) / ny, 0});
  const auto at = [=](int i, int j) { return j * (nx + 1) + i; };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      add_quad(s, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return s;
}

/// The side of a cylinder around the z axis, without its ends: two border loops.
inline Soup open_cylinder(int nu, int nz, double radius, double height)
{
  Soup s;
  for (int j = 0; j <= nz; ++j)
    for (int i = 0; i < nu; ++i) {
      const double u = 2 * pi * i / nu;
      s.points.push_back({radius * std::cos(u), radius * std::sin(u), height * j / nz});
    }
  const auto at = [=](int i, int j) { return j * nu + i % nu; };
  for (int j = 0; j < nz; ++j)
    for (int i = 0; i < nu; ++i)
      add_quad(s, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return s;
}

/// A cylinder with lids around the z axis: two closed creases.
inline Soup can(int nu, int nz)
{
  Soup s = open_cylinder(nu, nz, 1, 2);
  for (const int z : {0, 2}) {
    const int center = int(s.points.size()), first = z == 0 ? 0 : nz * nu;
    s.points.push_back({0, 0, double(z)});
    for (int i = 0; i < nu; ++i) {
      const int a = first + i, b = first + (i + 1) % nu;
      if (z == 0)
        s.triangles.push_back({center, b, a});
      else
        s.triangles.push_back({center, a, b});
    }
  }
  return s;
}

/// A closed disc of radius 1 and thickness `gap`: two close sheets joined at the rim.
inline Soup thin_disc(double gap, int rings = 20)
{
  Soup s;
  const int sectors = 6 * rings;
  const auto at = [=](int side, int ring, int sector) {
    const int first = side * (1 + rings * sectors);
    return ring == 0 ? first : first + 1 + (ring - 1) * sectors + sector % sectors;
  };
  for (int side = 0; side < 2; ++side) {
    const double z = side == 0 ? gap / 2 : -gap / 2;
    s.points.push_back({0, 0, z});
    for (int ring = 1; ring <= rings; ++ring)
      for (int k = 0; k < sectors; ++k) {
        const double r = double(ring) / rings, u = 2 * pi * k / sectors;
        s.points.push_back({r * std::cos(u), r * std::sin(u), z});
      }
  }
  for (int k = 0; k < sectors; ++k) {
    s.triangles.push_back({at(0, 0, 0), at(0, 1, k), at(0, 1, k + 1)});
    s.triangles.push_back({at(1, 0, 0), at(1, 1, k + 1), at(1, 1, k)});
    for (int ring = 1; ring < rings; ++ring) {
      add_quad(s, at(0, ring, k), at(0, ring + 1, k), at(0, ring + 1, k + 1), at(0, ring, k + 1));
      add_quad(s, at(1, ring, k), at(1, ring, k + 1), at(1, ring + 1, k + 1), at(1, ring + 1, k));
    }
    add_quad(s, at(0, rings, k), at(1, rings, k), at(1, rings, k + 1), at(0, rings, k + 1));
  }
  return s;
}

/// A ball of radius 1 with a finger of the diameter `thickness`, both round, around the z axis.
inline Soup ball_with_finger(double thickness)
{
  constexpr int sectors = 48, ball = 40, shaft = 60, tip = 8;
  const double r = thickness / 2, foot = std::acos(r), top = 2;
  std::vector<std::pair<double, double>> profile; // distance to the axis, height
  for (int k = 1; k <= ball; ++k) {
    const double a = -pi / 2 + (foot + pi / 2) * k / ball;
    profile.emplace_back(std::cos(a), std::sin(a));
  }
  for (int k = 1; k <= shaft; ++k)
    profile.emplace_back(r, std::sin(foot) + (top - std::sin(foot)) * k / shaft);
  for (int k = 1; k < tip; ++k) {
    const double a = pi / 2 * k / tip;
    profile.emplace_back(r * std::cos(a), top + r * std::sin(a));
  }
  Soup s{{{0, 0, -1}, {0, 0, top + r}}, {}};
  for (const auto& [x, z] : profile)
    for (int k = 0; k < sectors; ++k) {
      const double a = 2 * pi * k / sectors;
      s.points.push_back({x * std::cos(a), x * std::sin(a), z});
    }
  const auto at = [](std::size_t ring, int k) { return int(2 + ring * sectors) + k % sectors; };
  for (int k = 0; k < sectors; ++k) {
    s.triangles.push_back({0, at(0, k + 1), at(0, k)});
    s.triangles.push_back({1, at(profile.size() - 1, k), at(profile.size() - 1, k + 1)});
    for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring)
      add_quad(s, at(ring, k), at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k));
  }
  return s;
}

/// Both soups, side by side in one.
inline Soup joined(Soup a, const Soup& b)
{
  const int offset = static_cast<int>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const Triangle& t : b.triangles)
    a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

// --- transformations -----------------------------------------------------------------------------

inline Soup scaled(Soup s, double factor)
{
  for (Vec3d& p : s.points) p *= factor;
  return s;
}

inline Soup translated(Soup s, const Vec3d& v)
{
  for (Vec3d& p : s.points) p += v;
  return s;
}

/// Rotated by `angle` (radians) about `axis`, through the origin.
inline Soup rotated(Soup s, double angle, Vec3d axis = {1, 2, 3})
{
  axis = normalized(axis);
  const double c = std::cos(angle), d = std::sin(angle);
  for (Vec3d& p : s.points) p = c * p + d * cross(axis, p) + (1 - c) * dot(axis, p) * axis;
  return s;
}

/// The same surface with its vertices and facets in another order, and each facet turned.
inline Soup permuted(const Soup& s, unsigned seed)
{
  std::mt19937_64 random(seed);
  const auto shuffle = [&random](auto& range) {
    for (std::size_t i = range.size(); i > 1; --i) std::swap(range[i - 1], range[random() % i]);
  };
  std::vector<int> new_index(s.points.size());
  std::iota(new_index.begin(), new_index.end(), 0);
  shuffle(new_index);
  Soup result;
  result.points.resize(s.points.size());
  for (std::size_t v = 0; v < s.points.size(); ++v) result.points[new_index[v]] = s.points[v];
  for (const Triangle& t : s.triangles) {
    Triangle u{new_index[t[0]], new_index[t[1]], new_index[t[2]]};
    std::rotate(u.begin(), u.begin() + random() % 3, u.end());
    result.triangles.push_back(u);
  }
  shuffle(result.triangles);
  return result;
}

/// Two unit spheres whose centers are `distance` apart along x.
inline Soup two_spheres(int subdivisions, double distance = 3)
{
  return joined(icosphere(subdivisions), translated(icosphere(subdivisions), {distance, 0, 0}));
}

/// The shape as the remesher sees it: imported, with normals and areas, uniform density.
inline Surface make_surface(const Soup& soup)
{
  CGAL::PowerRTF::Repair_counts repairs;
  return CGAL::PowerRTF::import_soup(soup.points, soup.triangles, repairs);
}

} // namespace shapes

#endif // CGAL_POWER_RTF_TEST_SHAPES_H
