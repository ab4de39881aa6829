// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles from cells: they are those of insertion and decimation, and the guarantees hold
// whatever the cells are.
#include "creased_surface.h"
#include "hard_shapes.h"

#include <CGAL/PowerRTF/PowerRTF_traits_3.h>
#include <CGAL/PowerRTF/engines/sound_stars.h>
#include <CGAL/PowerRTF/extraction/Cell_stars.h>
#include <CGAL/PowerRTF/extraction/Surface_piece.h>
#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/extraction/extract_from_cells.h>
#include <CGAL/PowerRTF/extraction/fan_topology.h>
#include <CGAL/PowerRTF/features/Surface_patches.h>
#include <CGAL/PowerRTF/geometry/self_intersections.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/quality/topology.h>
#include <CGAL/PowerRTF/quality/triangle_quality.h>
#include <CGAL/PowerRTF/sampling/random_source.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using CGAL::Parallel_if_available_tag;
using CGAL::Sequential_tag;

namespace {

using Neighbors = std::vector<std::vector<int>>;

Remeshing_options options_for(std::size_t n, unsigned seed)
{
  Remeshing_options options;
  options.number_of_samples = n;
  options.random_seed = seed;
  return options;
}

// Samples after some steps of the optimization, with the neighbors of their cells.
struct Sampled {
  Surface surface;
  Surface_patches patches;
  Samples samples;
  Neighbors neighbors;

  Sampled(const Surface& s, std::size_t n, int steps = 20, unsigned seed = 0)
      : surface(s), patches(surface, options_for(n, seed))
  {
    const Remeshing_options options = options_for(n, seed);
    Cpu_engine<Sequential_tag> engine(patches.surface(), options);
    const Feature_samples& features = patches.features();
    engine.set_samples(sample_surface(patches.surface(), options, features, &engine.facet_tree()),
                       features);
    for (int step = 0; step < steps; ++step) {
      engine.build_cells();
      engine.move_samples(Position_method::lbfgs);
    }
    samples = joined(patches.on_whole(engine.samples()), features.samples);
    const Neighbor_cycles cycles = engine.neighbors();
    for (std::size_t i = 0; i < cycles.size(); ++i)
      neighbors.emplace_back(cycles[i].begin(), cycles[i].end());
  }
  Sampled(const Sampled&) = delete;

  template <class ConcurrencyTag = Sequential_tag>
  Extracted_mesh extract(Cell_extraction_statistics* statistics = nullptr,
                         const Find_sound_stars& find_sound = {}) const
  {
    return extract_from_cells<ConcurrencyTag>(
        surface, samples, patches.features(),
        Neighbor_cycles(int(neighbors.size()),
                        [&](int i) {
                          const auto& cycle = neighbors[i];
                          return Neighbor_cycles::Cycle(cycle.data(), cycle.data() + cycle.size());
                        }),
        statistics, {}, find_sound);
  }
  Extracted_mesh insert() const
  {
    return extract_by_insertion(surface, samples, patches.features());
  }
};

void check_guarantees(const Sampled& s, const Extracted_mesh& mesh)
{
  const Topology_statistics in = topology(s.surface.triangles), out = topology(mesh.triangles);
  CHECK(mesh.points.size() >= s.samples.size());
  CHECK(out.vertices == mesh.points.size());
  CHECK(out.euler_characteristic == in.euler_characteristic);
  CHECK(out.components == in.components);
  CHECK(out.border_loops == in.border_loops);
  CHECK(out.non_manifold_edges == 0);
  CHECK(out.non_manifold_vertices == 0);
  CHECK(out.oriented);
  CHECK(std::is_sorted(mesh.triangles.begin(), mesh.triangles.end()));
  const std::vector<Edge> edges = edges_of(mesh.triangles);
  for (const Edge& e : mesh.feature_edges) CHECK(std::binary_search(edges.begin(), edges.end(), e));
}

bool are_equal(const Extracted_mesh& a, const Extracted_mesh& b)
{
  return a.points == b.points && a.triangles == b.triangles && a.feature_edges == b.feature_edges;
}

std::size_t count_differences(const Extracted_mesh& a, const Extracted_mesh& b)
{
  std::vector<Triangle> only_one;
  std::set_symmetric_difference(a.triangles.begin(), a.triangles.end(), b.triangles.begin(),
                                b.triangles.end(), std::back_inserter(only_one));
  return only_one.size();
}

struct Shape {
  std::string name;
  Surface surface;
};

std::vector<Shape> plain_shapes()
{
  using namespace shapes;
  std::vector<Shape> all;
  const std::pair<const char*, Soup> soups[] = {
      {"tetrahedron", tetrahedron()},
      {"fine cube", box(8)},
      {"sphere", icosphere(3)},
      {"torus", torus(30, 12, 1, .4)},
      {"thin torus", torus(60, 8, 1, .05)},
      {"plane", plane_patch(10, 10)},
      {"cylinder", open_cylinder(20, 10, .5, 2)},
      {"thin disc", thin_disc(.01)},
      {"two spheres", two_spheres(2)},
      {"sphere and patch", joined(icosphere(2), translated(plane_patch(6, 6), {3, 0, 0}))}};
  for (const auto& [name, soup] : soups) all.push_back({name, make_surface(soup)});
  return all;
}

} // namespace

TEST_CASE("where samples are dense the cells agree, and their triangles are the known ones")
{
  for (const auto& soup : {shapes::icosphere(5), shapes::torus(120, 50, 1, .4)})
    for (const unsigned seed : {0u, 1u}) {
      const Sampled s(shapes::make_surface(soup), 2000, 40, seed);
      Cell_extraction_statistics statistics;
      const Extracted_mesh mesh = s.extract(&statistics);
      check_guarantees(s, mesh);
      CHECK(self_intersections(mesh.points, mesh.triangles) == 0);
      CHECK_FALSE(statistics.is_from_insertion);
      CHECK(statistics.open_samples < 20);
      CHECK(count_differences(mesh, s.insert()) <= 20); // nearly cocircular
    }
}

TEST_CASE("the guarantees hold for every shape and any number of samples")
{
  for (const Shape& shape : plain_shapes())
    for (const std::size_t n : {12, 30, 500, 3000}) {
      CAPTURE(shape.name);
      CAPTURE(n);
      std::size_t least = 0;
      try {
        const Sampled s(shape.surface, n, 10);
        least = s.samples.size();
        const Extracted_mesh mesh = s.extract();
        check_guarantees(s, mesh);
        if (self_intersections(mesh.points, mesh.triangles) > 0) CHECK(are_equal(mesh, s.insert()));
      } catch (const Invalid_input_error&) { // too few samples for the borders
        CHECK(least == 0);
      }
    }
}

TEST_CASE("creases and borders stay")
{
  for (const auto& soup :
       {shapes::box(6), shapes::can(30, 8), shapes::open_cylinder(30, 12, .5, 2)})
    for (const std::size_t n : {200, 1000}) {
      CAPTURE(n);
      const Sampled s(shapes::with_creases(soup, n), n);
      Cell_extraction_statistics statistics;
      const Extracted_mesh mesh = s.extract(&statistics);
      check_guarantees(s, mesh);
      CHECK(mesh.feature_edges.size() == s.patches.features().edges.size());
      CHECK(mesh.feature_edges == s.insert().feature_edges);
      CHECK_FALSE(statistics.is_from_insertion);
      CHECK(self_intersections(mesh.points, mesh.triangles) == 0);
    }
}

TEST_CASE("a patch without cells is no hole")
{
  // Thin rods: each end is a square between four samples.
  for (const std::size_t n : {400, 1000}) {
    const Sampled s(shapes::with_creases(shapes::long_box(1, .02, .02), n), n, 5);
    CHECK(s.patches.features().size() > 0);
    check_guarantees(s, s.extract());
  }
}

/// On the host; counts what it finds.
Find_sound_stars find_sound_stars(std::size_t& sound)
{
  return
      [&sound](const Surface& surface, const Cell_triangles& triangles, unsigned char* is_sound) {
        Host_backend<Sequential_tag> host;
        REQUIRE(internal::find_sound_stars(host, surface, triangles, is_sound));
        sound = std::count(is_sound, is_sound + triangles.cells, 1);
        return true;
      };
}

TEST_CASE("the same for any number of threads, and with sound triangles found elsewhere")
{
  for (const Shape& shape : plain_shapes()) {
    CAPTURE(shape.name);
    const Sampled s(shape.surface, 800, 5);
    const Extracted_mesh mesh = s.extract<Sequential_tag>();
    CHECK(are_equal(mesh, s.extract<Parallel_if_available_tag>()));
    std::size_t sound = 0;
    CHECK(are_equal(mesh, s.extract(nullptr, find_sound_stars(sound))));
    CHECK(sound > s.neighbors.size() / 2);
  }
}

TEST_CASE("whatever the cells say, the guarantees hold")
{
  const auto spoiled = [](Neighbors neighbors, int samples, double share, unsigned seed) {
    Random_source random(seed);
    const auto pick = [&](std::size_t n) { return std::min(n - 1, std::size_t(random() * n)); };
    for (std::vector<int>& around : neighbors) {
      if (random() > share || around.empty()) continue;
      switch (pick(6)) {
      case 0:
        around.clear();
        break;
      case 1:
        std::reverse(around.begin(), around.end());
        break;
      case 2:
        std::swap(around[pick(around.size())], around[pick(around.size())]);
        break;
      case 3:
        around[pick(around.size())] = int(pick(samples));
        break;
      case 4:
        around.erase(around.begin() + pick(around.size()));
        break;
      default:
        around[pick(around.size())] = -1;
      }
    }
    return neighbors;
  };
  for (const auto& soup : {shapes::icosphere(4), shapes::open_cylinder(40, 20, .5, 2)})
    for (const double share : {.002, .02, 1.}) {
      Sampled s(shapes::make_surface(soup), 1000);
      const Neighbors neighbors = s.neighbors;
      for (unsigned seed = 0; seed < 5; ++seed) {
        CAPTURE(share);
        CAPTURE(seed);
        s.neighbors = spoiled(neighbors, int(neighbors.size()), share, seed);
        Cell_extraction_statistics statistics;
        const Extracted_mesh mesh = s.extract(&statistics);
        check_guarantees(s, mesh);
        CHECK(self_intersections(mesh.points, mesh.triangles) == 0);
        CHECK(mesh.points.size() == s.samples.size());
        if (share < .01) CHECK_FALSE(statistics.is_from_insertion);
        if (share == 1) CHECK(are_equal(mesh, s.insert()));
        std::size_t sound = 0;
        CHECK(are_equal(mesh, s.extract(nullptr, find_sound_stars(sound))));
        if (share < 1) CHECK(sound > (1 - 8 * share) * double(neighbors.size() / 2));
      }
    }
}

TEST_CASE("two samples at one place stay two vertices")
{
  Sampled s(shapes::make_surface(shapes::icosphere(4)), 500);
  s.samples.points[7] = s.samples.points[8];
  s.samples.facets[7] = s.samples.facets[8];
  check_guarantees(s, s.extract());
}

TEST_CASE("the topology of a surface is the known one")
{
  for (const Shape& shape : plain_shapes()) {
    CAPTURE(shape.name);
    const Topology_statistics expected = topology(shape.surface.triangles);
    Surface surface = shape.surface;
    const auto found = internal::known_topology(surface, Parallel_if_available_tag());
    CHECK(found->size() == int(expected.components));
    CHECK(found->component == facet_components(shape.surface.adjacency).first);
    surface.topology.value = found;
    CHECK(internal::known_topology(surface, Sequential_tag()) == found);
    CHECK(internal::known_topology(Surface(surface), Sequential_tag()) != found);
    long sum = 0, loops = 0;
    for (const Component_topology& c : found->components) {
      sum += c.euler_characteristic;
      loops += c.border_loops;
    }
    CHECK(sum == expected.euler_characteristic);
    CHECK(loops == long(expected.border_loops));
  }
  CHECK(internal::known_topology(Surface(), Sequential_tag())->size() == 0);
}

TEST_CASE("a piece of a surface is a 2-manifold with the samples on it")
{
  for (const Shape& shape : plain_shapes()) {
    CAPTURE(shape.name);
    const Sampled s(shape.surface, 300, 2);
    const internal::Sample_places places(s.surface, s.samples, s.patches.features(),
                                         Sequential_tag());
    Random_source random(3);
    for (const double share : {.05, .5, 1.}) {
      std::vector<int> facets;
      for (int f = 0; f < int(s.surface.triangles.size()); ++f)
        if (random() < share) facets.push_back(f);
      const internal::Surface_piece piece(s.surface, s.samples, places, facets);
      CHECK(piece.surface.triangles.size() == facets.size());
      CHECK(topology(piece.surface.triangles).non_manifold_vertices == 0);
      std::set<int> expected, found;
      for (std::size_t v = 0; v < s.neighbors.size(); ++v)
        if (std::binary_search(facets.begin(), facets.end(), s.samples.facets[v]))
          expected.insert(int(v));
      for (const int v : piece.names)
        if (v >= 0) CHECK(found.insert(v).second);
      CHECK(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
      for (std::size_t v = 0; v < piece.names.size(); ++v)
        if (piece.names[v] >= 0) CHECK(piece.samples.points[v] == s.samples.points[piece.names[v]]);
      if (share == 1) CHECK(found.size() == s.samples.size());
      const std::size_t kept = std::size_t(std::count(piece.names.begin(), piece.names.end(), -1));
      CHECK((kept > 0) == (share < 1 && !facets.empty()));
    }
  }
}

TEST_CASE("stacked sheets that are nearer than the samples are not joined")
{
  for (const auto& soup : {shapes::accordion(10, .02), shapes::two_sheets(20, .01)})
    for (const std::size_t n : {300, 1000}) {
      CAPTURE(n);
      const Sampled s(shapes::make_surface(soup), n, 10);
      const auto area = [](const Extracted_mesh& mesh) {
        double sum = 0;
        for (const auto& [a, b, c] : mesh.triangles)
          sum +=
              length(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a])) / 2;
        return sum;
      };
      const Extracted_mesh mesh = s.extract();
      check_guarantees(s, mesh);
      CHECK(area(mesh) == doctest::Approx(area(s.insert())).epsilon(.02));
    }
}
