// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the result is worth: guarantees, quality, capacities, by shape and preset.
#include "../remeshed_shape.h"

#include <doctest/doctest.h>

#include <cstddef>

using namespace remeshed_shape;
using doctest::Approx;

TEST_CASE("the smallest numbers of samples")
{
  for (std::size_t n : {4, 5, 6, 12}) {
    CAPTURE(n);
    const Result result = remesh(shapes::icosphere(3), n, uniform());
    CHECK(result.soup.points.size() == n);
    CHECK(result.soup.triangles.size() == 2 * n - 4);
  }
}

TEST_CASE("a finger of a quarter of the spacing: the report tells of it, refined it is round")
{
  const std::size_t n = 1000;
  const Soup input = shapes::ball_with_finger(0.03);
  const Remeshing_report kept = remesh(input, n, uniform()).report;
  check_guarantees(kept);
  CHECK(kept.quality.q_min < 0.6);
  CHECK(kept.thin.places == 1);
  CHECK(kept.thin.thickness == Approx(0.03).epsilon(0.02));
  CHECK(kept.thin.thinnest[2] > 1);
  CHECK(kept.thin.samples > n);
  Remeshing_options options = uniform();
  options.thin = Thin::refine;
  const Result refined = remesh(input, n, options);
  check_guarantees(refined.report);
  CHECK(refined.soup.points.size() == n);
  CHECK(refined.report.quality.q_min > 0.6);
  CHECK(refined.report.quality.theta_min > 30);
  CHECK(refined.report.thin.places == 0);
  CHECK(refined.report.input_topology.faces == input.triangles.size());
}

TEST_CASE("nothing thin: the same bytes, refined or not")
{
  Remeshing_options options = uniform();
  const Result kept = remesh(torus(), 500, options);
  options.thin = Thin::refine;
  CHECK(are_equal(kept.soup, remesh(torus(), 500, options).soup));
}

TEST_CASE("closed shapes: guarantees, quality and equal capacities")
{
  struct Case {
    const char* name;
    Soup soup;
    double q_min, q_avg, theta_min;
  };
  const Case cases[] = {{"sphere", shapes::icosphere(4), 0.6, 0.91, 34},
                        {"torus", torus(), 0.58, 0.91, 33},
                        {"ellipsoid", ellipsoid(), 0.58, 0.9, 32},
                        {"two spheres", shapes::two_spheres(3), 0.58, 0.9, 33},
                        {"box", shapes::box(8), 0.4, 0.85, 22}};
  for (const Case& c : cases)
    for (Density density : {Density::uniform, Density::curvature})
      for (unsigned seed : {0u, 1u}) {
        CAPTURE(c.name);
        CAPTURE(int(density));
        CAPTURE(seed);
        Remeshing_options options;
        options.density = density;
        options.random_seed = seed;
        const Remeshing_report report = remesh(c.soup, 400, options).report;
        check_guarantees(report);
        CHECK(report.quality.q_min > c.q_min);
        CHECK(report.quality.q_avg > c.q_avg);
        CHECK(report.quality.theta_min > c.theta_min);
        CHECK(report.capacity.inside_interval == 1);
        CHECK(report.capacity.largest_deviation <= 0.04);
        CHECK(report.cells.ok + report.cells.guarded + report.feature_samples == 400);
        CHECK(report.distance.mean < 0.4);
      }
}

TEST_CASE("surfaces with borders keep them")
{
  for (const Soup& soup : {shapes::plane_patch(10, 10), shapes::open_cylinder(40, 20, 1, 2)})
    for (const Preset preset : {Preset::quality, Preset::fast, Preset::paper}) {
      Remeshing_options options = Remeshing_options::of(preset);
      options.density = Density::uniform;
      const Result result = remesh(soup, 300, options);
      check_guarantees(result.report);
      CHECK(result.report.topology.border_loops == result.report.input_topology.border_loops);
      CHECK(result.report.feature_edges > 40);
      CHECK(result.report.quality.q_avg > (preset == Preset::paper ? 0.8 : 0.9));
      CHECK(result.report.quality.q_min > 0.5);
      CHECK(result.report.distance.max <
            1); // of a diagonal's hundredths; the border is where it was
    }
  CHECK(remesh(shapes::plane_patch(10, 10), 300).report.distance.max < 1e-10);
}

TEST_CASE("creases are found and kept: polyhedra stay the same shape")
{
  const Soup cubes =
      shapes::joined(shapes::box(6), shapes::translated(shapes::box(2), {3, 0.5, 0.1}));
  const Remeshing_report report = remesh(cubes, 600).report;
  check_guarantees(report);
  CHECK(report.crease_edges == 12 * 6 + 12 * 2);
  CHECK(report.feature_edges >= 2 * 12 * 5);
  CHECK(report.lost_feature_edges == 0);
  CHECK(report.distance.max < 1e-10);
  CHECK(report.quality.q_min > 0.5);
  Remeshing_options without;
  without.feature_angle = 180;
  const Remeshing_report smooth = remesh(cubes, 600, without).report;
  CHECK(smooth.crease_edges == 0);
  CHECK(smooth.distance.max > 1);
}

TEST_CASE("the paper's preset ends with every cell inside the interval")
{
  for (Density density : {Density::uniform, Density::curvature})
    for (unsigned seed : {0u, 1u, 2u}) {
      CAPTURE(seed);
      Remeshing_options options = Remeshing_options::paper_preset();
      options.density = density;
      options.random_seed = seed;
      const Remeshing_report report = remesh(torus(), 300, options).report;
      check_guarantees(report);
      CHECK(report.capacity.inside_interval == 1);
      CHECK(report.capacity.largest_deviation <= 0.04);
      CHECK(report.constructions <= 700);
      CHECK(report.outer_iterations < 200); // it stops when it is done
      CHECK(report.quality.q_avg > 0.87);
    }
}

TEST_CASE("the paper's rule goes on until the samples rest")
{
  Remeshing_options options = Remeshing_options::paper_preset();
  options.relaxation_iterations = 10;
  options.density = Density::uniform;
  options.capacity_tolerance = 0.1;
  const Remeshing_report inside = remesh(torus(), 300, options).report;
  options.weights_end = Weights_end::rest;
  const Remeshing_report rest = remesh(torus(), 300, options).report;
  options.max_iterations = 1; // the last cells get their weights, too
  const Remeshing_report last = remesh(torus(), 300, options).report;
  for (const Remeshing_report& report : {inside, rest, last}) {
    check_guarantees(report);
    CHECK(report.capacity.inside_interval == 1);
  }
  CHECK(rest.outer_iterations > inside.outer_iterations);
  CHECK(rest.outer_iterations < 110);
  CHECK(rest.iterations.back().displacement < inside.iterations.back().displacement);
  CHECK(rest.quality.q_avg > inside.quality.q_avg);
  CHECK(last.outer_iterations == 11);
}

TEST_CASE("the paper's preset: weights that diverge begin anew")
{
  Remeshing_options options = Remeshing_options::paper_preset();
  options.relaxation_iterations = 10;
  options.max_iterations = 6;
  options.weight_step = 8; // the rule diverges beyond 2
  const Remeshing_report report = remesh(shapes::icosphere(4), 300, options).report;
  check_guarantees(report);
  const std::size_t without = 10 + 6 * (1 + 30) + 1; // constructions
  CHECK(report.constructions > without);
  for (std::size_t k = 10; k < report.iterations.size(); ++k) {
    CHECK(report.iterations[k].cells.empty == 0);
    CHECK(report.iterations[k].capacity.rms < 1.5 * report.iterations[9].capacity.rms);
  }
}

TEST_CASE("modes: RTF without weights, CCCPD with exactly equal capacities")
{
  Remeshing_options options = Remeshing_options::paper_preset();
  options.relaxation_iterations = 10;
  options.density = Density::uniform;
  options.max_iterations = 20;
  options.weight_method = Weight_method::none;
  const Remeshing_report rtf = remesh(torus(), 300, options).report;
  check_guarantees(rtf);
  CHECK(rtf.outer_iterations == 30);
  CHECK(rtf.constructions == 31);
  CHECK(rtf.capacity.inside_interval < 0.9);

  options.weight_method = Weight_method::multiplicative;
  const Remeshing_report paper = remesh(torus(), 300, options).report;
  options.capacity_tolerance = 0;
  const Remeshing_report cccpd = remesh(torus(), 300, options).report;
  check_guarantees(cccpd);
  CHECK(cccpd.outer_iterations == 30);
  CHECK(paper.capacity.rms < 0.04);
  CHECK(cccpd.capacity.rms < 0.25 * paper.capacity.rms);
  CHECK(cccpd.capacity.rms < 0.1 * rtf.capacity.rms);
  // At the first iteration with weights nothing is equal yet.
  CHECK(cccpd.capacity.rms < 0.1 * cccpd.iterations[9].capacity.rms);

  options.weight_operator = Weight_operator::floor; // as printed: cells park below two intervals
  options.capacity_tolerance = 0.04;
  const Remeshing_report printed = remesh(torus(), 300, options).report;
  check_guarantees(printed);
  CHECK(printed.capacity.inside_interval < 1);
}

TEST_CASE("angles on smooth shapes are between 42 and 84 degrees")
{
  for (const Soup& soup : {torus(), ellipsoid(), shapes::icosphere(4)})
    for (const Density density : {Density::uniform, Density::curvature})
      for (unsigned seed = 0; seed < 3; ++seed) {
        Remeshing_options options;
        options.density = density;
        options.random_seed = seed;
        const Quality_statistics quality = remesh(soup, 1500, options).report.quality;
        CHECK(quality.theta_min >= 42);
        CHECK(quality.theta_max <= 84);
        CHECK(quality.q_min > 0.76);
      }
}
