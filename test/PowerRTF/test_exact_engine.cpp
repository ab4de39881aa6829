// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole remesher on the exact traits, and the comparison of cells with the oracle.
#include <doctest/doctest.h>

#include "shapes.h"

#include <CGAL/PowerRTF/PowerRTF_exact_traits_3.h>
#include <CGAL/PowerRTF/exact/check_cells.h>
#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF_remesher.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <limits>
#include <utility>

using namespace CGAL::PowerRTF;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Fast = CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<Kernel, CGAL::Sequential_tag>>;
using Exact = CGAL::PowerRTF_remesher<CGAL::PowerRTF_exact_traits_3<Kernel, CGAL::Sequential_tag>>;

namespace {

Surface with_density(const shapes::Soup& soup, const Remeshing_options& options)
{
  Surface surface = shapes::make_surface(soup);
  set_creases(surface, options);
  set_density(surface, options);
  return surface;
}

void compare_traits(const shapes::Soup& soup, Remeshing_options options)
{
  options.max_iterations = 30;
  options.certified_combinatorics = true;
  // The triangles on the samples: the improvement is the same code for all engines, and on shapes
  // with symmetries it may turn the last bits of the positions into other, equally good triangles.
  options.improvement = Improvement::no;
  const Surface surface = with_density(soup, options);
  Fast fast(surface, options);
  Exact exact(surface, options);
  Remeshing_default_visitor visitor;
  REQUIRE(fast.optimize(visitor));
  REQUIRE(exact.optimize(visitor));
  const Cell_counts a = fast.report().cells, b = exact.report().cells;
  CHECK(a.ok == b.ok);
  CHECK(a.guarded == b.guarded);
  CHECK(a.empty == b.empty);
  CHECK(fast.report().constructions == exact.report().constructions);
  const Extracted_mesh m = fast.extract(visitor), n = exact.extract(visitor);
  CHECK(m.triangles.size() > options.number_of_samples);
  CHECK(shapes::sorted(m.triangles) == shapes::sorted(n.triangles));
  CHECK(exact.report().quality.q_avg > 0.5);
  CHECK(exact.report().missed_guarantees().empty());
  const Cell_comparison c = check_cells<CGAL::Sequential_tag>(
      fast.sites(), fast.cells(), compatibility_cosine(options.normal_angle),
      internal::epsilon<double>(), options.guard_factor);
  CHECK(c.cells == fast.cells().size());
  CHECK(c.passed());
  CHECK(c.equal_cycles == c.cells);
}

/// Evenly sampled: some samples and their cells.
std::pair<Samples, std::vector<Cell_polygon>> some_cells(double& cos_angle)
{
  Remeshing_options options;
  options.number_of_samples = 200;
  options.max_iterations = 3;
  cos_angle = compatibility_cosine(options.normal_angle);
  Fast fast(with_density(shapes::icosphere(3), options), options);
  Remeshing_default_visitor visitor;
  fast.optimize(visitor);
  return {fast.samples(), fast.cells()};
}

} // namespace

TEST_CASE("the exact traits give the mesh of the fast ones with certified combinatorics")
{
  Remeshing_options options;
  options.number_of_samples = 200;
  for (Density density : {Density::uniform, Density::curvature}) {
    options.density = density;
    for (unsigned seed : {0u, 1u}) {
      options.random_seed = seed;
      CAPTURE(seed);
      compare_traits(shapes::torus(40, 20, 3, 1), options);
      compare_traits(shapes::ellipsoid(1, 0.6, 0.3, 3), options);
    }
  }
}

TEST_CASE("guarded cells at borders, and the paper's weights")
{
  Remeshing_options options = Remeshing_options::paper_preset();
  options.number_of_samples = 150;
  options.density = Density::uniform;
  options.relaxation_iterations = 3;
  options.max_weight_iterations = 5;
  compare_traits(shapes::open_cylinder(40, 10, 1, 2), options);
}

TEST_CASE("samples exactly in a plane, cocircular by construction of the surface")
{
  Remeshing_options options;
  options.number_of_samples = 100;
  options.density = Density::uniform;
  options.feature_angle = 180;
  compare_traits(shapes::box(10), options);
}

TEST_CASE("creases, borders and several components")
{
  Remeshing_options options;
  options.number_of_samples = 200;
  options.density = Density::uniform;
  compare_traits(shapes::box(5), options);
  compare_traits(shapes::plane_patch(9, 9), options);
  compare_traits(
      shapes::joined(shapes::box(4), shapes::translated(shapes::icosphere(2), {0, 0, 2.01})),
      options);
}

TEST_CASE("corners and points on creases alone have no cells")
{
  Remeshing_options options;
  options.density = Density::uniform;
  options.max_iterations = 3;
  for (const std::size_t n : {8, 20}) {
    CAPTURE(n);
    options.number_of_samples = n;
    Fast fast(with_density(shapes::box(5), options), options);
    Exact exact(with_density(shapes::box(5), options), options);
    Remeshing_default_visitor visitor;
    for (const bool is_extracted : {false, true}) {
      CAPTURE(is_extracted);
      if (is_extracted) {
        CHECK(fast.extract(visitor).triangles.size() == 2 * n - 4);
        CHECK(exact.extract(visitor).triangles.size() == 2 * n - 4);
      } else {
        REQUIRE(fast.optimize(visitor));
        REQUIRE(exact.optimize(visitor));
      }
      CHECK(fast.cells().empty());
      CHECK(exact.cells().empty());
      CHECK(fast.sites().size() > n);
    }
  }
}

TEST_CASE("the comparison sees what is wrong")
{
  double cos_angle;
  const auto some = some_cells(cos_angle);
  const auto& samples = some.first;
  const auto& cells = some.second;
  const auto check = [&](const std::vector<Cell_polygon>& c) {
    return check_cells<CGAL::Sequential_tag>(samples, c, cos_angle);
  };
  const Cell_comparison right = check(cells);
  CHECK(right.cells == cells.size());
  CHECK(right.equal_cycles == cells.size());
  CHECK(right.passed());
  CHECK(right.area.max < 1e-12);
  CHECK(right.centroid.max < 1e-12);
  CHECK(right.predicates.filtered > 10 * cells.size());

  auto wrong = cells;
  wrong[7].neighbors.erase(wrong[7].neighbors.begin()); // an edge is missing
  wrong[7].vertices.erase(wrong[7].vertices.begin());
  std::swap(wrong[11].neighbors[0], wrong[11].neighbors[1]);
  wrong[13] = Cell_polygon(); // ok, but nothing there
  wrong[17].status = Cell_status::guarded;
  wrong[19] = Cell_polygon();
  wrong[19].status = Cell_status::empty;
  Cell_comparison c = check(wrong);
  CHECK_FALSE(c.passed());
  CHECK(c.wrong == std::vector<int>{7, 11, 13, 17, 19});

  wrong = cells;
  wrong[3].status = wrong[5].status = Cell_status::incomplete;
  wrong[5].neighbors.pop_back();
  wrong[5].vertices.pop_back();
  c = check(wrong);
  CHECK(c.passed());
  CHECK(c.uncertified_right == 1);
  CHECK(c.uncertified_wrong == 1);

  wrong = cells;
  wrong[23].area *= 1.01;
  for (Vec3d& v : wrong[29].vertices) v += (wrong[29].vertices[0] - samples.points[29]) * 0.01;
  c = check(wrong);
  CHECK(c.passed());
  CHECK(c.area.max == doctest::Approx(0.01));
  CHECK(c.centroid.max > 0.004);
  CHECK(c.centroid.max < 0.02);

  wrong.resize(20); // the other samples are fixed sites
  CHECK(check(wrong).cells == 20);
  wrong.resize(samples.size() + 1);
  CHECK_THROWS_AS(check(wrong), Invalid_input_error);
}

TEST_CASE("an edge that differs is forgiven only below the rounding bound")
{
  // Four sites around one at the origin; a fifth cuts a corner off, by `depth`.
  for (const double depth : {1e-15, 1e-12, 1e-6}) {
    Samples samples;
    for (const Vec3d& p : {Vec3d{0, 0, 0}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{-1, 0, 0},
                           Vec3d{0, -1, 0}, Vec3d{1, 1, 0}, Vec3d{-2, 0, 0}, Vec3d{2, 0, 0}}) {
      samples.points.push_back(p);
      samples.normals.push_back({0, 0, 1});
      samples.weights.push_back(0);
    }
    samples.weights[5] = 4 * depth; // x + y <= 1 - 2 depth
    std::vector<Cell_polygon> cells(samples.size());
    for (Cell_polygon& c : cells) c.status = Cell_status::incomplete;
    Cell_polygon& square = cells[0];
    square.status = Cell_status::ok;
    square.vertices = {{.5, -.5, 0}, {.5, .5, 0}, {-.5, .5, 0}, {-.5, -.5, 0}};
    square.neighbors = {1, 2, 3, 4};
    square.area = 1;
    const Cell_comparison c = check_cells<CGAL::Sequential_tag>(samples, cells, -2);
    CAPTURE(depth);
    CHECK(c.passed() == (depth < 1e-13));
    const Cell_comparison in_float = check_cells<CGAL::Sequential_tag>(
        samples, cells, -2, std::numeric_limits<float>::epsilon());
    CHECK(in_float.passed());
  }
}
