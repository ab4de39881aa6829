// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The catalog of shapes that intersect themselves. Each has a name that can be a file's.
#ifndef CGAL_POWER_RTF_TEST_CROSSING_SHAPES_H
#define CGAL_POWER_RTF_TEST_CROSSING_SHAPES_H

#include "hard_shapes.h"

#include <string>
#include <utility>
#include <vector>

namespace shapes {

/// A square that stands across another one, `lower` of it below.
inline Soup crossing_squares(double lower)
{
  const Soup wall = mapped(plane_patch(5, 5), [=](const Vec3d& p) {
    return Vec3d{0.43, 0.9 * p.y + 0.03, p.x - lower};
  });
  return joined(plane_patch(5, 5), wall);
}

/// As many soups as `count`, the `k`th at `place(soup, k)`, in one.
template <class Place>
Soup several(const Soup& soup, int count, const Place& place)
{
  Soup all;
  for (int k = 0; k < count; ++k) all = joined(all, place(soup, k));
  return all;
}

/// The closed tube of radius `radius` around the curve `center(u)`, `u` from 0 to 2 pi.
template <class Curve>
Soup closed_tube(int steps, int sides, double radius, const Curve& center)
{
  return wall(tube(steps, sides, radius, [&](double k) { return center(2 * pi * k / steps); }),
              true);
}

inline void add_crossing_spheres(Named_shapes& all)
{
  const Soup sphere = icosphere(2);
  const auto two = [&](const Vec3d& shift) { return joined(sphere, translated(sphere, shift)); };
  all.emplace_back("spheres_deep", two({0.3, 0.1, 0.05}));
  all.emplace_back("spheres", two({0.9, 0.3, 0.2}));
  all.emplace_back("spheres_turned", rotated(two({0.9, 0.3, 0.2}), 0.7));
  all.emplace_back("spheres_symmetric", two({1, 0, 0}));
  all.emplace_back("spheres_shallow", two({1.9, 0.1, 0.05}));
  all.emplace_back("spheres_near", joined(sphere, rotated(sphere, 0.3)));
  all.emplace_back("spheres_one_inside", joined(sphere, scaled(rotated(sphere, 0.4), 0.99)));
  all.emplace_back("spheres_of_two_sizes",
                   joined(icosphere(3), translated(scaled(icosphere(3), 0.1), {1, 0.02, 0.01})));
  all.emplace_back("spheres_five_in_a_row", several(sphere, 5, [](const Soup& s, int k) {
                     return translated(s, {1.3 * k, 0.1 * k, 0.03 * k});
                   }));
  all.emplace_back("spheres_eight_at_a_corner", several(sphere, 8, [](const Soup& s, int k) {
                     return translated(s, {0.7 * (k & 1), 0.71 * (k >> 1 & 1), 0.72 * (k >> 2)});
                   }));
  all.emplace_back("octahedra", joined(octahedron(), translated(octahedron(), {0.6, 0.18, 0})));
  all.emplace_back("tetrahedra", joined(tetrahedron(), scaled(tetrahedron(), -1)));
  all.emplace_back(
      "triangle_through_a_face", // which it cuts in one edge
      joined(tetrahedron(), Soup{{{0.1, 0.2, 0.1}, {1, 0.9, 0.8}, {0.8, 1, 0.9}}, {{{0, 1, 2}}}}));
  all.emplace_back("ellipsoids", joined(ellipsoid(1, 0.3, 0.3, 3), ellipsoid(0.3, 1, 0.3, 3)));
  all.emplace_back("needle_through_sphere", joined(icosphere(3), ellipsoid(3, 0.05, 0.05, 3)));
}

inline void add_crossing_boxes(Named_shapes& all)
{
  const auto two = [](const Vec3d& shift) { return joined(box(3), translated(box(3), shift)); };
  all.emplace_back("boxes", two({1, 0.9, 0.8}));
  all.emplace_back("boxes_turned", rotated(two({1, 0.9, 0.8}), 0.7));
  all.emplace_back("boxes_in_one_plane", two({1, 0.9, 0}));
  all.emplace_back("boxes_in_one_plane_turned", rotated(two({1, 0.9, 0}), 0.7));
  all.emplace_back("boxes_in_two_planes", two({1, 0, 0}));
  all.emplace_back("boxes_in_two_planes_turned", rotated(two({1, 0, 0}), 0.7));
  all.emplace_back("boxes_on_each_other", two({0.5, 0.25, 2}));
  all.emplace_back("boxes_on_each_other_turned", rotated(two({0.5, 0.25, 2}), 0.7));
  all.emplace_back("box_and_turned_box", joined(box(3), rotated(box(3), 0.7)));
  all.emplace_back("box_and_box_turned_a_little", joined(box(3), rotated(box(3), 0.02)));
  all.emplace_back("box_and_box_turned_in_place", joined(box(3), rotated(box(3), 0.7, {0, 0, 1})));
  all.emplace_back("box_through_box", joined(box(3), long_box(5, 0.8, 0.7)));
  all.emplace_back("boxes_crosswise", joined(long_box(5, 1, 1), long_box(1, 5, 1)));
  all.emplace_back("boxes_crosswise_turned",
                   rotated(joined(long_box(5, 1, 1), long_box(1, 5, 1)), 0.7));
  all.emplace_back("boxes_three_axes",
                   joined(long_box(5, 1, 1), joined(long_box(1, 5, 1), long_box(1, 1, 5))));
  all.emplace_back("box_through_sphere", joined(icosphere(3), long_box(3, 0.5, 0.5)));
  all.emplace_back("box_scales_1_to_100",
                   joined(box(3), translated(scaled(box(3), 0.01), {1, 0, 0})));
}

inline void add_crossing_sheets(Named_shapes& all)
{
  all.emplace_back("squares", crossing_squares(0.51));
  all.emplace_back("squares_barely", crossing_squares(0.001));
  all.emplace_back("squares_turned", rotated(crossing_squares(0.51), 0.7));
  all.emplace_back("squares_three",
                   joined(crossing_squares(0.51), mapped(plane_patch(4, 4), [](const Vec3d& p) {
                            return Vec3d{p.y, 0.6, p.x - 0.45};
                          })));
  all.emplace_back(
      "squares_at_5_degrees",
      joined(plane_patch(5, 5),
             translated(rotated(plane_patch(5, 5), 5 * pi / 180, {0, 1, 0}), {0, 0, 0.04})));
  all.emplace_back(
      "squares_at_1_degree",
      joined(plane_patch(5, 5),
             translated(rotated(plane_patch(5, 5), pi / 180, {0, 1, 0}), {0, 0, 0.008})));
  all.emplace_back("squares_in_one_plane",
                   joined(plane_patch(3, 3), translated(plane_patch(3, 3), {0.5, 0.25, 0})));
  all.emplace_back(
      "squares_in_one_plane_turned",
      rotated(joined(plane_patch(3, 3), translated(plane_patch(3, 3), {0.5, 0.25, 0})), 0.7));
  all.emplace_back("terrains", joined(terrain(12, 0.2, 1), terrain(12, 0.2, 2)));
  all.emplace_back("square_through_sphere",
                   joined(icosphere(3), mapped(plane_patch(6, 6), [](const Vec3d& p) {
                            return Vec3d{3 * p.x - 1.5, 3 * p.y - 1.5, 0.21};
                          })));
  all.emplace_back("cylinders_open",
                   joined(open_cylinder(24, 6, 0.5, 3),
                          translated(rotated(open_cylinder(24, 6, 0.4, 3), pi / 2, {0, 1, 0}),
                                     {-1.5, 0.05, 1.5})));
}

inline void add_surfaces_through_themselves(Named_shapes& all)
{
  // Tori whose tube is wider than the hole pass through themselves near the axis.
  all.emplace_back("spindle_torus", torus(24, 12, 0.5, 1));
  all.emplace_back("spindle_torus_turned", rotated(torus(24, 12, 0.5, 1), 0.7));
  all.emplace_back("spindle_torus_fine", rotated(torus(32, 16, 0.3, 1), 0.7));
  all.emplace_back("spindle_torus_deep", rotated(torus(20, 10, 0.1, 1), 0.4));
  all.emplace_back("spindle_torus_barely", rotated(torus(20, 10, 0.95, 1), 0.4));
  all.emplace_back("klein_bottle", klein_bottle(40, 20));
  all.emplace_back("klein_bottle_turned", rotated(klein_bottle(40, 20), 0.7));
  for (const unsigned seed : {1, 2, 3})
    all.emplace_back(numbered("crumpled_sphere", seed), shaken(icosphere(2), 0.25, seed));
  all.emplace_back("crumpled_sphere_fine", shaken(icosphere(3), 0.08, 1));
  all.emplace_back("crumpled_torus", shaken(torus(24, 12, 1, 0.4), 0.15, 1));
  all.emplace_back("tube_that_crosses_itself", closed_tube(80, 10, 0.25, [](double u) {
                     return Vec3d{2 * std::sin(u), std::sin(2 * u), 0.1 * std::cos(u)};
                   }));
  all.emplace_back("tube_tangled", closed_tube(160, 8, 0.12, [](double u) {
                     return Vec3d{std::sin(2 * u + 0.3), std::sin(3 * u), 0.1 * std::sin(5 * u)};
                   }));
  all.emplace_back("knot_too_thick", trefoil_knot(90, 12, 0.9));
}

inline void add_mechanical_parts(Named_shapes& all)
{
  const Soup ring = torus(24, 12, 1, 0.4);
  all.emplace_back("tori", joined(ring, translated(ring, {1.1, 0.2, 0.1})));
  all.emplace_back("tori_chained",
                   joined(ring, translated(rotated(ring, pi / 2, {1, 0, 0}), {0.5, 0, 0})));
  all.emplace_back("comb_and_box", joined(comb(6, 0.3, 1), translated(box(2), {3, 1.01, 2.5})));
  all.emplace_back("gears", joined(gear(0.5), translated(gear(0.5), {0.7, 0.1, 0.05})));
  all.emplace_back("stairs_and_sphere",
                   joined(stairs(4), translated(scaled(icosphere(3), 1.4), {2, 1, 2})));
}

/// All of them.
inline Named_shapes crossing_shapes()
{
  Named_shapes all;
  add_crossing_spheres(all);
  add_crossing_boxes(all);
  add_crossing_sheets(all);
  add_surfaces_through_themselves(all);
  add_mechanical_parts(all);
  return all;
}

} // namespace shapes

#endif // CGAL_POWER_RTF_TEST_CROSSING_SHAPES_H
