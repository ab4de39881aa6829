// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The CPU engine as a whole.
#include "engine_comparison.h"

#include <CGAL/PowerRTF/PowerRTF_traits_3.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

using namespace CGAL::PowerRTF;
using CGAL::Sequential_tag;
using doctest::Approx;

namespace {

Remeshing_options options_for(std::size_t n)
{
  Remeshing_options options;
  options.number_of_samples = n;
  return options;
}

} // namespace

TEST_CASE("cells at tips do not keep the others from equal capacities")
{
  engine_comparison::check_tips<Cpu_engine<Sequential_tag>>();
}

TEST_CASE("both ways of weighting make the capacities equal")
{
  for (double power : {0., 1.})
    for (unsigned seed : {1u, 2u}) {
      CAPTURE(power);
      CAPTURE(seed);
      Surface surface = shapes::make_surface(shapes::icosphere(4));
      for (std::size_t v = 0; v < surface.points.size(); ++v)
        surface.vertex_density[v] = std::exp(power * surface.points[v].z);
      Remeshing_options options = options_for(300);
      options.random_seed = seed;
      Remeshing_options strict = options;
      strict.capacity_tolerance = 1e-6;
      const Samples samples = sample_surface(surface, options);
      Cpu_engine<Sequential_tag> newton(surface, strict);
      newton.set_samples(samples);
      newton.build_cells();
      const std::vector<Vec3d> points = newton.samples().points;
      CHECK(newton.capacity().rms > 0.02);
      double before = newton.capacity().rms;
      for (int pass = 0; pass < 12 && newton.capacity().inside_interval < 1; ++pass) {
        REQUIRE(newton.newton_weights());
        CHECK(newton.capacity().rms < before);
        before = newton.capacity().rms;
      }
      CHECK(newton.capacity().largest_deviation <= 1e-6);
      CHECK(newton.capacity().inside_interval == 1);
      CHECK(newton.samples().points == points); // weights move no sample
      const std::vector<double> weights = newton.samples().weights;
      CHECK(std::abs(std::accumulate(weights.begin(), weights.end(), 0.)) < 1e-9);
      for (const Cell_polygon& cell : newton.cells())
        CHECK(cell.mass == Approx(newton.cells()[0].mass).epsilon(1e-5));

      Cpu_engine<Sequential_tag> rule(surface, options);
      rule.set_samples(samples);
      rule.build_cells();
      CHECK(rule.optimize_weights(300));
      CHECK(rule.capacity().inside_interval == 1);
      const std::size_t constructions = rule.constructions();
      rule.clear_weights();
      CHECK(rule.samples().weights == std::vector<double>(300, 0));
      CHECK(rule.capacity().rms > 0.02); // of cells without weights
      CHECK(rule.constructions() == constructions + 1);
    }
}

TEST_CASE("the engine: cells of the surface, Lloyd's steps, statistics")
{
  const Surface surface = shapes::make_surface(shapes::icosphere(4));
  Remeshing_options options = options_for(400);
  options.sampling = Sampling::random;
  Cpu_engine<Sequential_tag> engine(surface, options);
  engine.set_samples(sample_surface(surface, options));
  engine.build_cells();
  CHECK(engine.constructions() == 1);
  const double first = engine.displacement();
  for (int k = 0; k < 60; ++k) {
    engine.move_samples(Position_method::lloyd);
    engine.build_cells();
  }
  CHECK(engine.constructions() == 61);
  CHECK(engine.displacement() < 0.15 * first);
  CHECK(engine.cell_counts().ok == 400);

  const Samples samples = engine.samples();
  const std::vector<Cell_polygon> cells = engine.cells();
  REQUIRE(cells.size() == 400);
  double area = 0;
  for (int i = 0; i < 400; ++i) {
    area += cells[i].area;
    CHECK(cells[i].weight == samples.weights[i]);
    CHECK(cells[i].mass == Approx(cells[i].area * cells[i].density));
    CHECK(cells[i].vertices.size() == cells[i].neighbors.size());
    for (const Vec3d& p : cells[i].vertices) // in the tangent plane
      CHECK(std::abs(dot(p - samples.points[i], samples.normals[i])) < 1e-12);
    // On the facet that carries the sample.
    const Triangle& t = surface.triangles[samples.facets[i]];
    const Vec3d q = nearest_point_on_triangle(samples.points[i], surface.points[t[0]],
                                              surface.points[t[1]], surface.points[t[2]]);
    CHECK(length(q - samples.points[i]) < 1e-12);
  }
  CHECK(area == Approx(surface.area).epsilon(0.03)); // tangent planes lie outside of the sphere
}

TEST_CASE("what has been released is made anew where it is asked for")
{
  for (const bool paper : {false, true}) {
    CAPTURE(paper);
    const engine_comparison::Case c{"", shapes::icosphere(4),
                                    engine_comparison::options_of(paper, Density::uniform, 300)};
    const engine_comparison::Start start(c);
    Cpu_engine<Sequential_tag> engine(start.patches->surface(), c.options),
        kept(start.patches->surface(), c.options);
    const auto step = [&](auto& e) {
      e.build_cells();
      e.optimize_weights(3);
      e.move_samples(Position_method::lloyd);
    };
    for (auto* const e : {&engine, &kept}) {
      e->set_samples(start.samples);
      step(*e);
      e->build_cells();
      e->optimize_weights(3);
    }
    constexpr double rounding = 1e-12; // another one: cells are cut in another order
    const auto cycle = [](std::vector<int> around) {
      std::rotate(around.begin(), std::min_element(around.begin(), around.end()), around.end());
      return around;
    };
    engine.release_memory();
    const std::vector<Cell_polygon> cells = engine.cells(), expected = kept.cells();
    REQUIRE(cells.size() == 300);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      CHECK(cells[i].weight == expected[i].weight);
      CHECK(cycle(cells[i].neighbors) == cycle(expected[i].neighbors));
      CHECK(std::abs(cells[i].area - expected[i].area) < rounding);
    }
    engine.release_memory();
    const Neighbor_cycles neighbors = engine.neighbors(), as_kept = kept.neighbors();
    const auto around = [&](const Neighbor_cycles& all, int i) {
      return cycle(std::vector<int>(all[i].begin(), all[i].end()));
    };
    for (int i = 0; i < 300; ++i) CHECK(around(neighbors, i) == around(as_kept, i));
    engine.release_memory();
    for (auto* const e : {&engine, &kept}) step(*e);
    const std::vector<Vec3d> points = engine.samples().points, with_kept = kept.samples().points;
    for (int i = 0; i < 300; ++i) CHECK(length(points[i] - with_kept[i]) < 1000 * rounding);
    CHECK(length(points[0] - start.samples.points[0]) > 1e-6);
  }
}

TEST_CASE("L-BFGS gets nearer to centroidal samples than Lloyd's method does in as many steps")
{
  const Surface surface = shapes::make_surface(shapes::torus(60, 30, 1, 0.4));
  Remeshing_options options = options_for(400);
  options.sampling = Sampling::stratified; // far from centroidal
  const auto displacement_after = [&](Position_method method) {
    Cpu_engine<Sequential_tag> engine(surface, options);
    engine.set_samples(sample_surface(surface, options));
    engine.build_cells();
    for (int k = 0; k < 80; ++k) {
      engine.move_samples(k < 10 ? Position_method::lloyd : method);
      engine.build_cells();
    }
    engine.restore_best();
    return engine.displacement();
  };
  double lbfgs = 0, lloyd = 0;
  for (options.random_seed = 0; options.random_seed < 5; ++options.random_seed) {
    lbfgs += displacement_after(Position_method::lbfgs);
    lloyd += displacement_after(Position_method::lloyd);
  }
  CHECK(lbfgs < 0.5 * lloyd);
}
