// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is done with whole meshes on a GPU beside the samples, against the host.
#include "../built_surfaces.h"
#include "../dirty_shapes.h"
#include "../engine_comparison.h"
#include "../topology_counts.h"
#include "../unknown_mesh.h"

#ifdef CGAL_POWER_RTF_WITH_CUDA

#include "../flips_case.h"

#include <CGAL/PowerRTF/engines/Cuda_engine.h>
#include <CGAL/PowerRTF/engines/sound_stars.h>
#include <CGAL/PowerRTF/extraction/connect_halfedges.h>
#include <CGAL/PowerRTF/fields/smooth_normals.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/quality/topology.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

using namespace engine_comparison;

namespace {

/// The triangles around one vertex.
shapes::Soup wheel(int triangles)
{
  shapes::Soup s;
  s.points.resize(triangles + 1);
  for (int k = 1; k <= triangles; ++k) s.triangles.push_back({0, k, k % triangles + 1});
  return s;
}

} // namespace

TEST_CASE("the topology of meshes is what the host counts")
{
  using namespace shapes;
  const Case c = cases()[0];
  const Start start(c);
  Cuda_engine<float> engine(start.patches->surface(), c.options);
  engine.set_samples(start.samples, start.patches->features());
  const Bring_mesh bring = engine.mesh_bringer();
  Triangle_links links;
  const auto count = [&](const Soup& s) {
    links = {};
    return bring(arrays(s))->topology(&links);
  };
  for (const Soup& s :
       {icosphere(3), permuted(open_cylinder(9, 4, 1, 2), 1), two_spheres(2),
        joined(permuted(torus(600, 400, 1, .4), 2), plane_patch(300, 400)), wheel(16),
        Soup{{{}, {}, {}}, {{0, 1, 2}}}, Soup{{{}, {}, {}, {}}, {{0, 1, 3}, {3, 1, 0}}}}) {
    CAPTURE(s.triangles.size());
    const Topology_statistics expected = topology(s.triangles, CGAL::Parallel_if_available_tag());
    const auto t = count(s);
    REQUIRE(t);
    check_counts(*t, expected);
    const Triangle_links known = internal::triangle_links(s.triangles, int(s.points.size()),
                                                          CGAL::Parallel_if_available_tag());
    CHECK(links.opposite == known.opposite);
    CHECK(links.last_corner == known.last_corner);
  }
  const std::vector<Vec3d> five(5);
  for (const Soup& s :
       {Soup{five, {{0, 1, 2}, {0, 3, 4}}}, Soup{five, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}},
        Soup{five, {{0, 1, 2}, {0, 1, 3}}}, Soup{five, {{0, 1, 1}}}, moebius_strip(20), wheel(17)})
    CHECK_FALSE((count(s) || links.are_known()));
  CHECK(count(Soup{five, {}})->vertices == 0);
}

TEST_CASE("edges that may be worth a flip are found")
{
  for (const auto& [soup, n] : {std::pair(shapes::ellipsoid(1, 0.7, 0.4, 4), 2000),
                                std::pair(shapes::open_cylinder(40, 10, .5, 2), 400),
                                std::pair(shapes::ellipsoid(1, 0.7, 0.4, 6), 40000)})
    flips_case::check(soup, n, [](const Surface& surface) {
      return std::make_unique<Cuda_engine<float>>(surface, Remeshing_options());
    });
}

TEST_CASE("cells whose triangles are sound are those that the host finds")
{
  const Case large{"large", shapes::torus(300, 150, 1, 0.3),
                   options_of(false, Density::uniform, 40000)};
  std::vector<Case> all = cases();
  all.push_back(large);
  for (const Case& c : all) {
    CAPTURE(c.name);
    const Start start(c);
    const Surface& surface = start.patches->surface();
    Cuda_engine<float> engine(surface, c.options);
    engine.set_samples(start.samples, start.patches->features());
    for (int k = 0; k < 4; ++k) {
      engine.build_cells();
      engine.move_samples(Position_method::lloyd);
    }
    engine.build_cells();
    const Samples sites = engine.sites();
    const Neighbor_cycles neighbors = engine.neighbors();
    const Cell_triangles triangles{int(neighbors.size()),  int(sites.size()),
                                   neighbors.first.data(), neighbors.neighbors.data(),
                                   sites.points.data(),    sites.normals.data(),
                                   sites.facets.data()};
    Host_backend<CGAL::Parallel_if_available_tag> host;
    std::vector<unsigned char> found(triangles.cells), expected(triangles.cells);
    REQUIRE(internal::find_sound_stars(host, surface, triangles, expected.data()));
    REQUIRE(engine.sound_star_finder()(surface, triangles, found.data()));
    CHECK(found == expected);
    CHECK(std::count(found.begin(), found.end(), 1) > triangles.cells / 2);
  }
}

TEST_CASE("clean triangles become the surface and the tree that the host makes")
{
  built_surfaces::check(Cuda_engine<float>::surface_work({}).build);
  built_surfaces::check_trees(Cuda_engine<float>::surface_work({}).arrange_facets);
}

TEST_CASE("facets that are on the GPU are those that would go up")
{
  const Surface_work work = Cuda_engine<float>::surface_work({});
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const Start start(c);
    const Surface& surface = start.patches->surface();
    Surface resident = surface;
    REQUIRE(work.bring_facets(resident));
    const auto there = resident.resident.value;
    REQUIRE(there);
    CHECK(there->bytes >= resident.triangles.size() * 60);
    CHECK(work.bring_facets(resident));
    CHECK(resident.resident.value == there);
    Remeshing_options elsewhere;
    elsewhere.device = 1000; // there is none
    CHECK_FALSE(Cuda_engine<float>::surface_work(elsewhere).bring_facets(resident));
    CHECK(resident.resident.value == there);

    const auto run = [&](const Surface& s) {
      Cuda_engine<float> engine(s, c.options);
      engine.set_samples(start.samples, start.patches->features());
      for (int k = 0; k < 3; ++k) {
        engine.build_cells();
        engine.move_samples(Position_method::lloyd);
      }
      Two_sided_distances distances;
      const shapes::Soup sphere = shapes::icosphere(3);
      REQUIRE(engine.mesh_bringer()(shapes::arrays(sphere))->find_distances(1000, distances));
      return std::make_tuple(engine.samples().points, engine.samples().density,
                             distances.from_surface.sum, distances.from_mesh.sum);
    };
    CHECK(run(resident) == run(surface));
    const Surface moved = std::move(resident); // keeps them
    CHECK(run(moved) == run(surface));
    std::vector<double> density, expected;
    CHECK(work.compute_density(moved, c.options, density) ==
          work.compute_density(surface, c.options, expected));
    CHECK(density == expected);
  }
}

TEST_CASE("normals are smoothed as on the host")
{
  const auto smooth = [](const Surface& surface, double variance, Vec3d* normals) {
    REQUIRE(Cuda_engine<float>::surface_work({}).diffuse_normals(surface, variance, normals));
    return true; // not the host
  };
  for (const shapes::Soup& soup : {shapes::octahedron(), shapes::icosphere(4),
                                   shapes::plane_patch(30, 7), shapes::torus(500, 300, 1, .3)})
    for (const double width : {0.5, 3.}) {
      Surface rough = shapes::make_surface(soup);
      CAPTURE(rough.points.size());
      std::mt19937 random(5);
      std::uniform_real_distribution<double> off(-1, 1);
      for (Vec3d& n : rough.vertex_normals)
        n = normalized(n + Vec3d{off(random), off(random), off(random)});
      rough.vertex_normals[0] = {0, 0, 1};
      const std::size_t n = std::max<std::size_t>(8, rough.points.size() / 20);
      Surface there = rough, again = rough, here = rough;
      smooth_normals(there, n, width, CGAL::Parallel_if_available_tag(), smooth);
      smooth_normals(again, n, width, CGAL::Parallel_if_available_tag(), smooth);
      smooth_normals(here, n, width, CGAL::Parallel_if_available_tag());
      double most = 0, moved = 0;
      for (std::size_t v = 0; v < rough.points.size(); ++v) {
        most = std::max(most, length(there.vertex_normals[v] - here.vertex_normals[v]));
        moved = std::max(moved, length(rough.vertex_normals[v] - here.vertex_normals[v]));
      }
      CHECK(there.vertex_normals == again.vertex_normals);
      CHECK(most < 1e-12);
      CHECK(moved > 0.1);
    }
}

#endif // CGAL_POWER_RTF_WITH_CUDA
