// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The memory that a run takes on a device, as it is told before, against what an engine on the host
// takes whose arrays are counted; and what goes up. (On a device: test_cuda_device/memory.cpp.)
#include "counting_backend.h"
#include "engine_comparison.h"
#include "sweeps_case.h"

#include <CGAL/PowerRTF/geometry/Surface_facets.h>
#include <CGAL/PowerRTF/geometry/halve_edges.h>
#include <CGAL/PowerRTF/geometry/make_surface_in_tree.h>
#include <CGAL/PowerRTF/geometry/split_at_centers.h>
#include <CGAL/PowerRTF/quality/surface_distance.h>

#include <cstddef>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

using namespace engine_comparison;

namespace {

using Backend = counting::Backend<CGAL::Sequential_tag>;
using Counted = counting::Engine_of<float, CGAL::Sequential_tag>;

std::vector<Case> larger_cases()
{
  const shapes::Soup torus = shapes::torus(48, 24, 1, 0.3);
  std::vector<Case> all{
      {"quality, even", torus, options_of(false, Density::uniform, 2000)},
      {"quality, adaptive", torus, options_of(false, Density::curvature, 2000)},
      {"quality, two components", shapes::two_spheres(3),
       options_of(false, Density::uniform, 2000)},
      {"quality, creases", shapes::box(8), options_of(false, Density::uniform, 8000)},
      {"paper, even", torus, options_of(true, Density::uniform, 1000)},
      {"paper, adaptive", torus, options_of(true, Density::curvature, 1000)},
      {"stratified", torus, options_of(false, Density::uniform, 2000)},
      {"stratified, long memory", torus, options_of(false, Density::uniform, 2000)},
      {"stratified, no weights", torus, options_of(false, Density::uniform, 2000)}};
  for (std::size_t k = all.size() - 3; k < all.size(); ++k)
    all[k].options.sampling = Sampling::stratified; // else the lattice takes most
  all[all.size() - 2].options.lbfgs_memory = 10;
  all.back().options.weight_method = Weight_method::none;
  return all;
}

} // namespace

TEST_CASE("a run takes the memory that was told before, but for some per cent")
{
  for (const Case& c : larger_cases()) {
    CAPTURE(c.name);
    const Start start(c);
    const std::size_t taken = memory_of_run<counting::Counted_engine<float>>(c, start);
    const std::size_t told = Counted::bytes(sizes_of(c, start), c.options);
    const double ratio = double(taken) / double(told);
    std::cout << c.name << ": " << taken << " bytes, told " << told << ", ratio " << ratio << '\n';
    const bool has_features = start.patches->features().size() > 0; // some samples have no cell
    CHECK(ratio >= (has_features ? 0.95 : 0.99));
    CHECK(ratio <= 1.05);
  }
}

TEST_CASE("points of a lattice become samples where they are, the same as those that go up")
{
  using Tag = CGAL::Parallel_if_available_tag;
  for (const Case& c : lattice_cases()) {
    CAPTURE(c.name);
    const Start start(c);
    const bool has_border = start.patches->features().size() > 0;
    Lattice_start starts[2];
    std::size_t uploaded[2];
    for (const bool is_placed : {false, true}) {
      const std::size_t before = counting::Backend<Tag>::uploaded;
      starts[is_placed] = lattice_start<counting::Counted_engine<double, Tag>>(c, start, is_placed);
      uploaded[is_placed] = counting::Backend<Tag>::uploaded - before;
    }
    const auto& [given, placed] = starts;
    const std::size_t n = c.options.number_of_samples - start.patches->features().size();
    REQUIRE(given.samples.size() == n);
    REQUIRE(placed.samples.size() == n);
    CHECK(uploaded[false] - uploaded[true] == n * (sizeof(Site<double>) + sizeof(int)));
    CHECK(placed.off_lattice == given.off_lattice);
    CHECK((placed.off_lattice > 0) == !has_border); // the plane has a perfect one
    const Pairing pairing = paired(given.samples, placed.samples, start.patches->surface().area);
    CHECK(pairing.distance < 1e-12);
    for (std::size_t i = 0; i < n; ++i)
      CHECK(placed.samples.facets[pairing.of_first[i]] == given.samples.facets[i]);
  }
}

TEST_CASE("the facets of a surface go up once, or not at all where they are there")
{
  const improvement_case::Sweeps_case mesh(shapes::ellipsoid(1, 0.7, 0.4, 4), 500);
  const Surface& surface = mesh.surface();
  const Facet_tree tree(surface.points, surface.triangles);
  const auto uploaded_by = [](const auto& f) {
    const std::size_t before = Backend::uploaded;
    f();
    return Backend::uploaded - before;
  };
  const auto here = std::make_shared<Resident_surface>();
  here->facets = surface;
  const std::size_t facets = internal::bytes_of_listed<internal::Facet_buffers<Backend>>(
      surface.points.size(), surface.triangles.size());
  std::optional<std::size_t> least; // to make an engine
  for (const int device : {Backend::device, 0}) {
    here->device = device;
    Surface_in_tree in_tree = internal::make_surface_in_tree(surface, tree);
    in_tree.resident = here;
    std::optional<Counted> engine;
    const std::size_t uploaded = uploaded_by([&] { engine.emplace(in_tree, Remeshing_options()); });
    if (!least) least = uploaded;
    CHECK(uploaded == *least + (device == Backend::device ? 0 : facets));

    std::unique_ptr<Star_sweeps_base> sweeps;
    CHECK(uploaded_by([&] { sweeps = mesh.sweeps(engine->star_sweeps_maker()); }) == 0);
    const auto host = mesh.host_sweeps(CGAL::Sequential_tag());
    const auto stars = mesh.smoothed(*sweeps, 2), on_host = mesh.smoothed(*host, 2);
    REQUIRE(stars.size() == int(mesh.mesh().size()));
    CHECK(stars.points == on_host.points);
    CHECK(stars.facets == on_host.facets);

    const shapes::Soup other = shapes::icosphere(2);
    const Extracted_mesh sphere{other.points, other.triangles};
    Distance_statistics distances;
    CHECK(uploaded_by([&] {
            distances = surface_distance(surface.points, surface.triangles, tree, other.points,
                                         other.triangles, CGAL::Sequential_tag(), false,
                                         sphere.there(engine->mesh_bringer()).get());
          }) == sizeof(Vec3d) * other.points.size() + sizeof(Triangle) * other.triangles.size());
    CHECK(distances.mean ==
          surface_distance(surface.points, surface.triangles, tree, other.points, other.triangles)
              .mean);
  }
}

TEST_CASE("what is known of a surface's facets is forgotten when they change, and by a copy")
{
  Surface surface = shapes::make_surface(shapes::octahedron());
  const auto here = std::make_shared<Resident_surface>();
  surface.resident.value = here;
  CHECK(!Surface(surface).resident.value);
  Surface moved = std::move(surface);
  CHECK(moved.resident.value == here);
  SUBCASE("edges are halved") { halve_edges(moved, {0}); }
  SUBCASE("facets are split") { split_at_centers(moved, {0}); }
  CHECK(!moved.resident.value);
}

TEST_CASE("more samples and facets take more memory")
{
  const Case c = larger_cases().front();
  const Start start(c);
  Run_sizes sizes = sizes_of(c, start);
  std::size_t before = 0;
  for (sizes.samples = 1; sizes.samples < 1000000000; sizes.samples += sizes.samples / 5 + 1) {
    const std::size_t told = Counted::bytes(sizes, c.options);
    CHECK(told > before);
    before = told;
  }
  sizes.facets *= 2;
  CHECK(Counted::bytes(sizes, c.options) > before);
}
