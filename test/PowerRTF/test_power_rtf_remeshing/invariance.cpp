// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scaled, moved, turned and renumbered input.
#include "../remeshed_shape.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <initializer_list>
#include <vector>

using namespace remeshed_shape;
using doctest::Approx;

namespace {

/// How far rounding may move a vertex, in units of the input: a lattice is found in single
/// precision, and the improvement decides by comparisons, which amplify it.
double rounding(const Remeshing_options& options)
{
  if (options.improvement == Improvement::yes) return 0.01;
  return options.sampling == Sampling::lattice ? 1e-3 : 1e-5;
}

std::vector<Remeshing_options> combinations(std::initializer_list<Density> densities)
{
  std::vector<Remeshing_options> all;
  for (const Sampling sampling : {Sampling::elimination, Sampling::lattice})
    for (const Density density : densities)
      for (const Improvement improvement : {Improvement::no, Improvement::yes}) {
        Remeshing_options& options = all.emplace_back();
        options.sampling = sampling;
        options.density = density;
        options.improvement = improvement;
      }
  return all;
}

} // namespace

TEST_CASE("scaling the input changes no triangle")
{
  for (const Soup& soup : {torus(), ellipsoid()})
    for (const Remeshing_options& options : combinations({Density::uniform, Density::curvature})) {
      const Soup expected = remesh(soup, 300, options).soup;
      for (double factor : {1000., 0.001}) {
        CAPTURE(factor);
        const Soup scaled = remesh(shapes::scaled(soup, factor), 300, options).soup;
        CHECK(shapes::sorted(scaled.triangles) == shapes::sorted(expected.triangles));
        CHECK(largest_distance(scaled, shapes::scaled(expected, factor)) <
              rounding(options) * factor);
      }
      for (double factor : {1024., 1 / 4096.}) { // a power of two rounds nothing
        CAPTURE(factor);
        CHECK(are_equal(remesh(shapes::scaled(soup, factor), 300, options).soup,
                        shapes::scaled(expected, factor)));
      }
    }
}

TEST_CASE("moving the input by 1000 diagonals changes the result by rounding only")
{
  for (const Soup& soup : {torus(), ellipsoid()})
    for (const Remeshing_options& options : combinations({Density::curvature})) {
      const Soup expected = remesh(soup, 300, options).soup;
      const Vec3d far = 1000 * diagonal(soup) * normalized(Vec3d{1, -2, 0.5});
      const Soup moved = remesh(shapes::translated(soup, far), 300, options).soup;
      CHECK(shapes::sorted(moved.triangles) == shapes::sorted(expected.triangles));
      CHECK(largest_distance(moved, shapes::translated(expected, far)) < rounding(options));
    }
}

TEST_CASE("turning the input or renumbering it leaves the quality as it is")
{
  for (const Soup& soup : {torus(), ellipsoid()}) {
    const Remeshing_report expected = remesh(soup, 300).report;
    for (const Soup& other : {shapes::rotated(soup, 1), shapes::rotated(soup, 2, {1, 0, 0}),
                              shapes::permuted(soup, 5)}) {
      const Remeshing_report report = remesh(other, 300).report;
      check_guarantees(report);
      CHECK(report.quality.q_avg == Approx(expected.quality.q_avg).epsilon(0.02));
      CHECK(report.quality.q_min > 0.58);
      CHECK(report.distance.mean == Approx(expected.distance.mean).epsilon(0.1));
      CHECK(report.capacity.inside_interval == 1);
    }
  }
}
