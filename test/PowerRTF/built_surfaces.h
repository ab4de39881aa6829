// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a `Build_surface` makes, against what the host makes.
#ifndef CGAL_POWER_RTF_TEST_BUILT_SURFACES_H
#define CGAL_POWER_RTF_TEST_BUILT_SURFACES_H

#include "dirty_shapes.h"
#include "odd_shapes.h"
#include "shapes.h"

#include <CGAL/PowerRTF/geometry/Build_surface.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/component_topology.h>
#include <CGAL/PowerRTF/input/clean_surface.h>
#include <CGAL/PowerRTF/input/read_mesh.h>

#include <CGAL/tags.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

namespace built_surfaces {

using namespace CGAL::PowerRTF;

inline Surface cleaned(const shapes::Soup& soup, const Build_surface& build = {})
{
  Repair_counts repairs;
  return internal::clean_surface(internal::soup_of_ranges(soup.points, soup.triangles), Repair::yes,
                                 Non_manifold::split, repairs, CGAL::Parallel_if_available_tag(),
                                 build);
}

/// Normals and areas within some roundings, all else equal.
inline void check_equal(const Surface& s, const Surface& expected)
{
  constexpr double roundings = 1e-14;
  CHECK(s.points == expected.points);
  CHECK(s.triangles == expected.triangles);
  CHECK(s.input_vertices == expected.input_vertices);
  CHECK(s.adjacency.opposite == expected.adjacency.opposite);
  CHECK(s.adjacency.corners.first == expected.adjacency.corners.first);
  CHECK(s.adjacency.corners.entries == expected.adjacency.corners.entries);
  CHECK(s.adjacency.border_edges == expected.adjacency.border_edges);
  CHECK(s.facet_areas == expected.facet_areas);
  CHECK(s.facet_normals == expected.facet_normals);
  CHECK(s.vertex_density == expected.vertex_density);
  CHECK(s.normalization.center == expected.normalization.center);
  const auto topology = internal::known_topology(s, CGAL::Sequential_tag()),
             known = internal::known_topology(expected, CGAL::Sequential_tag());
  CHECK(topology->component == known->component);
  CHECK(topology->components == known->components);
  CHECK(s.area == doctest::Approx(expected.area).epsilon(1e-12));
  REQUIRE(s.vertex_normals.size() == expected.vertex_normals.size());
  double most = 0;
  for (std::size_t v = 0; v < s.vertex_normals.size(); ++v)
    most = std::max(most, length(s.vertex_normals[v] - expected.vertex_normals[v]));
  CHECK(most < roundings);
}

/// The triangles around the ends of an axis.
inline shapes::Soup bipyramid(int sides)
{
  shapes::Soup s{{{0, 0, 1}, {0, 0, -1}}, {}};
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * shapes::pi * k / sides;
    s.points.push_back({std::cos(angle), std::sin(angle), 0});
    const int a = 2 + k, b = 2 + (k + 1) % sides;
    s.triangles.insert(s.triangles.end(), {{0, a, b}, {1, b, a}});
  }
  return s;
}

/// Whether `build` makes the surface; else the host does.
inline bool check(const shapes::Soup& soup, const Build_surface& build)
{
  CAPTURE(soup.triangles.size());
  bool is_built = false;
  int times = 0;
  const Surface surface = cleaned(soup, [&](const auto& points, const auto& triangles, Surface& s) {
    const bool is_now = build(points, triangles, s);
    if (!is_now) CHECK(s.points.empty());
    is_built = is_now;
    ++times;
    return is_now;
  });
  CHECK(times <= 1); // what needs repair is tried in several ways
  check_equal(surface, cleaned(soup));
  return is_built;
}

inline void check(const Build_surface& build)
{
  using namespace shapes;
  for (const Soup& soup :
       {tetrahedron(), box(5), two_spheres(3), permuted(icosphere(4), 1), bipyramid(64),
        ball_with_needles(), scaled(rotated(torus(30, 20, 1, .3), 1), 1e-150),
        permuted(torus(300, 150, 1, .3), 2), rotated(permuted(icosphere(7), 3), 1),
        joined(permuted(torus(600, 400, 2, 1), 4), translated(icosphere(3), {5, 0, 0})),
        Soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, plane_patch(3, 2),
        permuted(plane_patch(250, 300), 1),
        joined(open_cylinder(20, 5, 1, 2), translated(icosphere(2), {5, 0, 0}))})
    CHECK(check(soup, build));

  Soup unused = octahedron(), turned = icosphere(2), twice = icosphere(2);
  unused.points.push_back({0, 0, 0});
  turned = some_reversed(turned, 3);
  twice.triangles.push_back(twice.triangles[5]);
  for (const Soup& soup :
       {unused, turned, twice, bipyramid(65), with_slivers(icosphere(3), 4, 0),
        touching_cubes(3, {1, 1, 1}), touching_cubes(60, {1, 1, 0}), moebius_strip(20)})
    CHECK_FALSE(check(soup, build));
  // Its cracks are the host's.
  CHECK(cleaned(shaken(cut_into_facets(icosphere(3)), 1e-9, 1), build).adjacency.border_edges == 0);
}

inline void check_trees(const Arrange_facets& arrange)
{
  using namespace shapes;
  for (const Soup& soup :
       {Soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, octahedron(), plane_patch(3, 3),
        two_spheres(4), permuted(torus(300, 150, 1, .3), 1)}) {
    CAPTURE(soup.triangles.size());
    Surface surface = make_surface(soup);
    surface.facet_patches.assign(surface.triangles.size(), 7);
    bool is_arranged = false;
    const CGAL::Parallel_if_available_tag parallel;
    const Facet_tree tree(
        surface, parallel,
        [&](const auto&... arguments) { return is_arranged = arrange(arguments...); }),
        expected(surface.points, surface.triangles, surface.facet_patches, parallel);
    CHECK(is_arranged);
    CHECK(tree.order() == expected.order());
    CHECK(tree.places() == expected.places());
    const auto is_equal = [](const auto& a, const auto& b) {
      return a.size() == b.size() &&
             std::memcmp(a.data(), b.data(), a.size() * sizeof(*a.data())) == 0;
    };
    CHECK(is_equal(tree.nodes(), expected.nodes()));
    CHECK(tree.nearest({0.3, 0.1, 0.2}).facet == expected.nearest({0.3, 0.1, 0.2}).facet);
  }
}

} // namespace built_surfaces

#endif // CGAL_POWER_RTF_TEST_BUILT_SURFACES_H
