// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The catalog of shapes that are hard to remesh. Each has a name that can be a file's.
#ifndef CGAL_POWER_RTF_TEST_HARD_SHAPES_H
#define CGAL_POWER_RTF_TEST_HARD_SHAPES_H

#include "cad_shapes.h"
#include "odd_shapes.h"

#include <sstream>
#include <string>

namespace shapes {

using Named_shapes = std::vector<std::pair<std::string, Soup>>;

/// `what` and the number, as a file name can hold them: "wedge_0.2", "sphere_of_size_1e-20".
inline std::string numbered(const std::string& what, double number)
{
  std::ostringstream text;
  text << what << '_' << number;
  return text.str();
}

inline void add_sharp_shapes(Named_shapes& all)
{
  for (const double degrees : {3., 2., 1., 0.5, 0.2}) {
    const Soup shape = wedge(degrees);
    all.emplace_back(numbered("wedge", degrees), shape);
    all.emplace_back(numbered("wedge_moved", degrees), translated(rotated(shape, 1), {3, 5, -7}));
  }
  all.emplace_back("box_1_1e-4_1e-4", long_box(1, 1e-4, 1e-4));
  all.emplace_back("box_1_1_1e-4", long_box(1, 1, 1e-4));
  all.emplace_back("box_1_1e-2_1e-6", long_box(1, 1e-2, 1e-6));
  all.emplace_back("box_1_1e-2_1e-2", long_box(1, 1e-2, 1e-2));
  all.emplace_back("cube", long_box(1, 1, 1));
  all.emplace_back("gear_chamfered", gear(0.5));
  all.emplace_back("gear", gear(0));
  all.emplace_back("bracket", bracket(3, 16));
  all.emplace_back("cylinder",
                   spindle({0, 0, 0}, {circle(64, 0, 1), circle(64, 10, 1)}, {0, 0, 10}));
  all.emplace_back("comb", comb(6, 1, 1));
  all.emplace_back("comb_narrow", comb(6, 0.01, 2));
  all.emplace_back("stairs", stairs(8));
}

inline void add_pointed_shapes(Named_shapes& all)
{
  all.emplace_back("cone", cone(64, 1, 3, 1));
  all.emplace_back("cone_40_rows", cone(64, 1, 3, 40));
  all.emplace_back("cone_1_to_1e4", cone(32, 1, 1e4, 1));
  all.emplace_back("cone_flat", cone(64, 1, 0.01, 1));
  all.emplace_back("double_cone", double_cone(64, 1, 3, 3));
  all.emplace_back("double_cone_long", double_cone(32, 1, 100, 1));
  all.emplace_back("double_cone_flat", double_cone(64, 1, 0.01, 0.01));
  for (const double factor : {16., 1024., 65536.})
    all.emplace_back(numbered("icosahedron_drawn_out", factor), drawn_out(icosahedron(), factor));
  all.emplace_back("tetrahedron_drawn_out_1e4", drawn_out(tetrahedron(), 1e4));
  all.emplace_back("tetrahedron_drawn_out_askew",
                   Soup{{{20000, 0, 1000}, {0, -2, 0}, {0, 2, -0.1}, {-2, 0, 0}},
                        {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}});
  all.emplace_back("star_prism_5", star_prism(5, 0.4, 0.5));
  all.emplace_back("star_prism_24_sharp", star_prism(24, 0.1, 0.2));
  all.emplace_back("star_prism_100_sharp", star_prism(100, 0.01, 0.01));
  all.emplace_back("star_prism_200", star_prism(200, 0.05, 1));
  all.emplace_back("star_prism_flat", star_prism(50, 0.01, 1e-3));
  all.emplace_back("star_prism_tall", star_prism(12, 0.05, 20));
  all.emplace_back("spiked_sphere_12", spiked_sphere(3, 54, 6));
  all.emplace_back("spiked_sphere_many", spiked_sphere(3, 7, 2));
  all.emplace_back("hedgehog", hedgehog(3, 1.5, 1));
  all.emplace_back("needle_1_to_100", ellipsoid(1, 0.01, 0.01, 3));
  all.emplace_back("needle_1_to_1e4", ellipsoid(1, 1e-4, 1e-4, 3));
  all.emplace_back("lentil", ellipsoid(1, 1, 1e-3, 4));
}

inline void add_thin_and_open_shapes(Named_shapes& all)
{
  for (const double gap : {0.1, 0.01, 0.001}) {
    all.emplace_back(numbered("shell", gap), shell(4, gap));
    all.emplace_back(numbered("thin_disc", gap), thin_disc(gap));
  }
  for (const int holes : {1, 2, 3, 6, 12})
    all.emplace_back(numbered("plate_with_holes", holes), plate_with_holes(holes, 2));
  all.emplace_back("plate_thin", mapped(plate_with_holes(3, 3), [](const Vec3d& p) {
                     return Vec3d{p.x, p.y, 0.01 * p.z};
                   }));
  for (const unsigned seed : {1, 2, 3}) {
    all.emplace_back(numbered("terrain", seed), terrain(30, 0.2, seed));
    all.emplace_back(numbered("terrain_rough", seed), terrain(40, 1, seed));
  }
  all.emplace_back("terrain_coarse", terrain(20, 1, 3));
  all.emplace_back("tube", open_cylinder(40, 10, 1, 2));
  all.emplace_back("tube_long", open_cylinder(12, 1, 1, 1000));
  all.emplace_back("tube_short", open_cylinder(200, 1, 1, 0.01));
  all.emplace_back("coil_spring", coil_spring(5, 0.5, 0.1, 48, 10));
  all.emplace_back("coil_spring_dense", coil_spring(5, 0.21, 0.1, 48, 10));
  all.emplace_back("ribbon", ribbon(3));
  all.emplace_back("hairpin", hairpin(0.01));
  all.emplace_back("accordion", accordion(10, 0.02));
  all.emplace_back("two_sheets_0.01", two_sheets(20, 0.01));
  all.emplace_back("two_sheets_1e-6", two_sheets(20, 1e-6));
}

inline void add_knotted_and_touching_shapes(Named_shapes& all)
{
  all.emplace_back("torus_fat", torus(40, 40, 1, 0.999));
  all.emplace_back("torus_thin", torus(200, 8, 1, 0.01));
  all.emplace_back("torus_very_thin", torus(400, 4, 1, 1e-3));
  all.emplace_back(
      "tori_linked",
      joined(torus(40, 20, 1, 0.3),
             translated(rotated(torus(40, 20, 1, 0.3), pi / 2, {1, 0, 0}), {1, 0, 0})));
  all.emplace_back("trefoil_knot", trefoil_knot(150, 12, 0.3));
  all.emplace_back("klein_bottle", klein_bottle(60, 30));
  all.emplace_back("klein_bottle_coarse", klein_bottle(20, 12));
  all.emplace_back("moebius_strip", moebius_strip(60));
  for (const double share : {0.2, 0.5, 0.8})
    all.emplace_back(numbered("voxels", share), random_voxels(6, share, 1));
  all.emplace_back("voxels_many", random_voxels(10, 0.6, 2));
  all.emplace_back("menger_sponge", menger_sponge(2));
  all.emplace_back("cubes_sharing_a_face", touching_cubes(4, {1, 0, 0}));
  all.emplace_back("cubes_sharing_an_edge", touching_cubes(4, {1, 1, 0}));
  all.emplace_back("cubes_sharing_a_vertex", touching_cubes(4, {1, 1, 1}));
  all.emplace_back("spheres_of_unequal_sizes",
                   joined(icosphere(3), translated(scaled(icosphere(2), 1e-3), {2, 0, 0})));
  all.emplace_back("spheres_far_apart", two_spheres(3, 1e6));
}

inline void add_far_and_scaled_shapes(Named_shapes& all)
{
  for (const double size : {1e-20, 1e-10, 1e10, 1e15})
    all.emplace_back(numbered("sphere_of_size", size), scaled(icosphere(3), size));
  for (const double distance : {1e6, 1e9, 1e15})
    all.emplace_back(numbered("sphere_moved", distance),
                     translated(icosphere(3), {distance, 0, 0}));
  all.emplace_back("torus_moved_1e9", translated(torus(40, 20, 1, 0.3), {1e9, -1e9, 1e9}));
  all.emplace_back("cube_moved_1e9", translated(long_box(1, 1, 1), {1e9, 1e9, 1e9}));
  all.emplace_back("wedge_1_moved_1e6", translated(wedge(1), {1e6, 1e6, 1e6}));
}

/// All of them.
inline Named_shapes hard_shapes()
{
  Named_shapes all;
  add_sharp_shapes(all);
  add_pointed_shapes(all);
  add_thin_and_open_shapes(all);
  add_knotted_and_touching_shapes(all);
  add_far_and_scaled_shapes(all);
  return all;
}

} // namespace shapes

#endif // CGAL_POWER_RTF_TEST_HARD_SHAPES_H
