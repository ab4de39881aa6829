// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program on every hard shape: no failure is silent. `test_hard_shapes --write FOLDER` writes
// the shapes as OFF files, to be looked at.
#include "hard_shapes.h"
#include "judged_run.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace {

using judged_run::mesh_of;

judge::Topology topology_of(const shapes::Soup& soup) { return judge::topology(mesh_of(soup)); }

} // namespace

TEST_CASE("the judge knows closed, open and one-sided surfaces")
{
  const judge::Topology sphere = topology_of(shapes::icosphere(2));
  CHECK(sphere.vertices == 162);
  CHECK(sphere.euler_characteristic == 2);
  CHECK(sphere.components == 1);
  CHECK(sphere.border_loops == 0);
  CHECK(sphere.is_manifold());
  CHECK(sphere.oriented);
  const judge::Topology plate = topology_of(shapes::plate_with_holes(3, 2));
  CHECK(plate.euler_characteristic == -4);
  const judge::Topology tubes =
      topology_of(shapes::joined(shapes::open_cylinder(8, 2, 1, 1),
                                 shapes::translated(shapes::open_cylinder(8, 2, 1, 1), {5, 0, 0})));
  CHECK(tubes.components == 2);
  CHECK(tubes.border_loops == 4);
  const judge::Topology strip = topology_of(shapes::moebius_strip(20));
  CHECK(strip.border_loops == 1);
  CHECK_FALSE(strip.orientable);
  const judge::Topology bottle = topology_of(shapes::klein_bottle(20, 12));
  CHECK(bottle.euler_characteristic == 0);
  CHECK(bottle.border_loops == 0);
  CHECK(bottle.is_manifold());
  CHECK_FALSE(bottle.orientable);
}

TEST_CASE("the judge sees what is not a 2-manifold, and what is turned round")
{
  CHECK(topology_of(shapes::touching_cubes(1, {1, 1, 0})).non_manifold_edges == 1);
  CHECK(topology_of(shapes::touching_cubes(1, {1, 1, 1})).non_manifold_vertices == 1);
  const judge::Topology turned = topology_of(shapes::some_reversed(shapes::icosphere(1), 9));
  CHECK_FALSE(turned.oriented);
  CHECK(turned.orientable);
  shapes::Soup more = shapes::icosphere(1);
  more.points.push_back({5, 5, 5});
  CHECK(topology_of(more).unused_vertices == 1);
}

TEST_CASE("the judge sees every kind of self-intersection")
{
  using shapes::Soup;
  const auto pairs = [](const Soup& soup) { return judge::self_intersections(mesh_of(soup)); };
  CHECK(pairs(shapes::icosphere(2)) == 0);
  CHECK(pairs(shapes::box(3)) == 0); // coplanar neighbors
  CHECK(pairs(shapes::klein_bottle(20, 12)) > 0);
  const std::vector<CGAL::PowerRTF::Vec3d> base = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  const auto with = [&](const std::vector<CGAL::PowerRTF::Vec3d>& points,
                        const CGAL::PowerRTF::Triangle& triangle) {
    Soup soup{base, {{{0, 1, 2}}, triangle}};
    soup.points.insert(soup.points.end(), points.begin(), points.end());
    return soup;
  };
  CHECK(pairs(with({{0.5, 0.5, -1}, {0.5, 0.5, 1}, {5, 5, 0}}, {3, 4, 5})) == 1); // crosses
  CHECK(pairs(with({{0.5, 0.5, 0}, {0.5, 0.5, 1}, {5, 5, 1}}, {3, 4, 5})) == 1);  // touches
  CHECK(pairs(with({{0.5, 0.5, 1e-300}, {0.5, 0.5, 1}, {5, 5, 1}}, {3, 4, 5})) == 0);
  CHECK(pairs(with({{1, 1, -1}, {1, 1, 1}}, {0, 3, 4})) == 1); // from a common vertex
  CHECK(pairs(with({{-1, -1, -1}, {-1, -1, 1}}, {0, 3, 4})) == 0);
  CHECK(pairs(with({{1, 1, 0}}, {1, 0, 3})) == 1);  // folded onto its neighbor
  CHECK(pairs(with({{1, -1, 0}}, {1, 0, 3})) == 0); // beside it, in its plane
  CHECK(pairs(with({}, {0, 2, 1})) == 1);           // the same again
  CHECK(judge::degenerate_facets(mesh_of(with({{1, 0, 0}}, {1, 0, 3}))) == 1);
}

TEST_CASE("the catalog holds what it names")
{
  std::set<std::string> names;
  for (const auto& [name, soup] : shapes::hard_shapes()) names.insert(name);
  CHECK(names.size() == shapes::hard_shapes().size());
  CHECK(names.size() >= 89);
  CHECK(topology_of(shapes::bracket(3, 16)).euler_characteristic == -2);
  CHECK(topology_of(shapes::bracket(3, 16)).oriented);
  CHECK(judge::self_intersections(mesh_of(shapes::bracket(3, 16))) == 0);
  CHECK(topology_of(shapes::gear(0.5)).euler_characteristic == 0);
  CHECK(judge::self_intersections(mesh_of(shapes::gear(0.5))) == 0);
  CHECK(topology_of(shapes::menger_sponge(2)).is_manifold());
  CHECK_FALSE(topology_of(shapes::random_voxels(6, 0.5, 1)).is_manifold());
}

TEST_CASE("the judge reads what is written, to the last bit")
{
  const judged_run::Scratch_folder folder;
  for (const double size : {1e-20, 1. / 3, 1e15}) {
    const judge::Mesh sphere = mesh_of(shapes::scaled(shapes::icosphere(2), size));
    for (const std::string format : {"off", "obj", "stl"}) {
      CAPTURE(size);
      CAPTURE(format);
      const std::string file = folder / ("sphere." + format);
      judged_run::write(file, shapes::scaled(shapes::icosphere(2), size));
      const judge::Mesh mesh = judge::read(file);
      REQUIRE(mesh.points.size() == sphere.points.size());
      CHECK(judge::is_clean(mesh));
      if (format != "stl") CHECK(mesh.points == sphere.points);
      for (std::size_t f = 0; format == "stl" && f < mesh.facets.size(); ++f)
        for (int i = 0; i < 3; ++i)
          CHECK(mesh.triangle(f)[i].x() == double(float(sphere.triangle(f)[i].x())));
    }
  }
}

TEST_CASE("thin shapes without self-intersections get none")
{
  const judged_run::Scratch_folder folder;
  for (const auto& wanted :
       {std::pair<std::string, std::size_t>{"tetrahedron_drawn_out_askew", 300},
        {"icosahedron_drawn_out_1024", 300},
        {"needle_1_to_1e4", 1000}}) {
    const std::string& name = wanted.first;
    const std::size_t samples = wanted.second;
    CAPTURE(name);
    const auto all = shapes::hard_shapes();
    const auto shape =
        std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.first == name; });
    REQUIRE(shape != all.end());
    const judged_run::Run run = judged_run::run(folder, name, shape->second, {samples});
    CHECK(judged_run::failure(run) == "");
    CHECK(run.exit_code == 0);
  }
}

TEST_CASE("no run on a hard shape fails silently")
{
  const judged_run::Scratch_folder folder;
  const std::string formats[] = {"off", "off", "stl", "off", "obj"};
  std::size_t number = 0;
  for (const auto& shape : shapes::hard_shapes()) {
    const std::string name = shape.first;
    const std::string format = formats[number++ % 5];
    CAPTURE(name);
    CAPTURE(format);
    const judged_run::Run run =
        judged_run::run(folder, name, shape.second, {300, "uniform", format});
    CHECK(judged_run::failure(run) == "");
    // Only what is no clean surface may be refused, and what coordinates cannot hold.
    const bool is_too_far = run.message.find("coordinates") != std::string::npos;
    if (run.exit_code == 1 && !is_too_far)
      CHECK_FALSE(judge::is_clean(judge::merged(judge::read(run.input))));
  }
}

TEST_CASE("drawn-out shapes with vertices of thousands of edges take no minutes")
{
  const judged_run::Scratch_folder folder;
  const std::set<std::string> names{"box_1_1e-4_1e-4", "icosahedron_drawn_out_65536",
                                    "tetrahedron_drawn_out_1e4", "star_prism_flat"};
  std::size_t runs = 0;
  for (const auto& shape : shapes::hard_shapes()) {
    const std::string name = shape.first;
    if (names.count(name) == 0) continue;
    ++runs;
    CAPTURE(name);
    const judged_run::Run run =
        judged_run::run(folder, name, shape.second, {3000, "uniform", "off"});
    CHECK(judged_run::failure(run) == "");
  }
  CHECK(runs == names.size());
}

int main(int argc, char** argv)
{
  if (argc == 3 && std::string(argv[1]) == "--write") {
    for (const auto& [name, soup] : shapes::hard_shapes())
      judged_run::write(std::string(argv[2]) + '/' + name + ".off", soup);
    return 0;
  }
  return judged_run::run_tests(argc, argv);
}
