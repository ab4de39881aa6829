// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cad_shapes.h"
#include "odd_shapes.h"
#include "remeshed_shape.h"

#include <CGAL/PowerRTF/features/refine_narrow_patches.h>
#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/fields/thin_parts.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace CGAL::PowerRTF;
using namespace remeshed_shape;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> thickness(const Surface& s, double most = infinity)
{
  std::vector<double> result(s.triangles.size(), -1);
  find_thickness(
      s, 100000, [most](int) { return most; }, result, CGAL::Parallel_tag());
  return result;
}

Vec3d center(const Surface& s, std::size_t f)
{
  const auto [a, b, c] = s.triangles[f];
  return s.normalization.to_outside((s.points[a] + s.points[b] + s.points[c]) * (1. / 3));
}

double spacing_at(const Surface& s, std::size_t n, int v)
{
  return spacing_constant(s, n) / std::sqrt(s.vertex_density[v]);
}

} // namespace

TEST_CASE("thickness: the diameter of a finger")
{
  const double diameter = 0.1;
  const Surface s = shapes::make_surface(shapes::ball_with_finger(diameter));
  const double unit = s.normalization.scale;
  const std::vector<double> found = thickness(s, 0.5 * unit);
  for (std::size_t f = 0; f < found.size(); ++f) {
    const Vec3d p = center(s, f);
    if (p.z > 1.1 && p.z < 1.95) CHECK(found[f] == doctest::Approx(diameter * unit).epsilon(0.01));
    if (p.z < 0.5) CHECK(found[f] == infinity);
  }
}

TEST_CASE("thickness: that of a plate near its rim, none far from it")
{
  const double gap = 0.05;
  const Surface s = shapes::make_surface(shapes::thin_disc(gap, 60));
  const double unit = s.normalization.scale;
  const std::vector<double> found = thickness(s);
  int at_rim = 0;
  for (std::size_t f = 0; f < found.size(); ++f) {
    const Vec3d p = center(s, f);
    const double inside = 1 - std::hypot(p.x, p.y);
    const bool is_flat = std::abs(s.facet_normals[f].z) > 0.99;
    if (is_flat && inside < 0.5 * gap) {
      ++at_rim;
      CHECK(found[f] == doctest::Approx(gap * unit).epsilon(0.01));
    }
    if (inside > 2 * gap && inside < 0.9) CHECK(found[f] == infinity);
  }
  CHECK(at_rim > 100);
}

TEST_CASE("thickness: none at a border, at convex edges of 20 to 90 degrees, on a ball")
{
  for (const double degrees : {20., 45., 90.}) {
    const Surface s = shapes::make_surface(shapes::wedge(degrees));
    const double most = 0.15 * s.normalization.scale; // at the blunt end it is as thick as that
    for (const double d : thickness(s, most)) CHECK(d == infinity);
  }
  const Surface patch = shapes::make_surface(shapes::plane_patch(10, 10)),
                ball = shapes::make_surface(shapes::icosphere(3));
  for (const double d : thickness(patch)) CHECK(d == infinity);
  for (const double d : thickness(ball, ball.normalization.scale)) CHECK(d == infinity);
}

TEST_CASE("thin parts: a surface that is nowhere thin stays as it is")
{
  for (const Soup& soup : {shapes::icosphere(4), shapes::box(4), torus()}) {
    const Surface before = shapes::make_surface(soup);
    Surface after = before;
    refine_thin_parts(after, 1000);
    CHECK(after.triangles == before.triangles);
    CHECK(after.vertex_density == before.vertex_density);
    CHECK(thin_parts(before, 1000).places == 0);
  }
}

TEST_CASE("thin parts: the spacing is within 1.25 times the thickness, elsewhere at most 1.6 times "
          "as large")
{
  const std::size_t n = 1000;
  const double diameter = 0.03;
  Surface s = shapes::make_surface(shapes::ball_with_finger(diameter));
  const double before = spacing_at(s, n, 0), unit = s.normalization.scale;
  REQUIRE(before > 2 * 1.25 * diameter * unit);
  const Thin_parts thin = thin_parts(s, n);
  CHECK(thin.places == 1);
  CHECK(thin.thickness == doctest::Approx(diameter).epsilon(0.02));
  CHECK(thin.thinnest[2] > 1);
  CHECK(thin.area_share == doctest::Approx(diameter / 4).epsilon(0.1)); // pi d / (4 pi)
  CHECK(thin.samples > n);
  refine_thin_parts(s, n);
  double largest = 0;
  for (int v = 0; v < static_cast<int>(s.points.size()); ++v) {
    const double h = spacing_at(s, n, v);
    largest = std::max(largest, h);
    const double z = s.normalization.to_outside(s.points[v]).z;
    if (z > 1.1 && z < 1.95) CHECK(h < 1.02 * 1.25 * diameter * unit);
  }
  CHECK(largest > before);
  CHECK(largest < 1.62 * before);
  CHECK(thin_parts(s, n).area_share < 0.1 * thin.area_share);
}

TEST_CASE("thin parts: with as many samples as they ask for, the spacing elsewhere stays")
{
  Surface s = shapes::make_surface(shapes::ball_with_finger(0.03));
  const std::size_t n = 1000, more = thin_parts(s, n).samples;
  const double before = spacing_at(s, n, 0);
  refine_thin_parts(s, more);
  CHECK(spacing_at(s, more, 0) == doctest::Approx(before).epsilon(0.02));
}

TEST_CASE("thin parts: the same for a scaled surface, and for any number of threads")
{
  Surface one = shapes::make_surface(shapes::ball_with_finger(0.03)),
          big = shapes::make_surface(scaled(shapes::ball_with_finger(0.03), 1024)), parallel = one;
  const Thin_parts a = thin_parts(one, 1000), b = thin_parts(big, 1000);
  CHECK(a.samples == b.samples);
  CHECK(1024 * a.thickness == b.thickness);
  refine_thin_parts(one, 1000);
  refine_thin_parts(big, 1000);
  refine_thin_parts(parallel, 1000, CGAL::Parallel_tag());
  CHECK(one.triangles == big.triangles);
  CHECK(one.vertex_density == big.vertex_density);
  CHECK(one.vertex_density == parallel.vertex_density);
}

TEST_CASE("thin parts: none where creases part the sides")
{
  Surface s = shapes::make_surface(shapes::long_box(10, 0.2, 0.2));
  CHECK(thin_parts(s, 100).places == 1);
  CHECK(thin_parts(s, 1000).places == 0); // by the spacing
  for (int h = 0; h < static_cast<int>(s.adjacency.opposite.size()); ++h)
    if (dot(s.facet_normals[h / 3], s.facet_normals[s.adjacency.opposite[h] / 3]) < 0.5)
      s.creases.push_back(
          sorted_edge(halfedge_source(s.triangles, h), halfedge_target(s.triangles, h)));
  sort_uniquely(s.creases);
  const Surface before = s;
  refine_thin_parts(s, 100);
  CHECK(s.triangles == before.triangles);
  CHECK(s.vertex_density == before.vertex_density);
}

TEST_CASE("thin parts: large facets are split, the surface stays where it is")
{
  const std::size_t n = 1500;
  Surface s = shapes::make_surface(
      shapes::joined(shapes::icosphere(4), translated(shapes::long_box(1, 0.04, 0.04), {3, 0, 0})));
  const std::size_t facets = s.triangles.size();
  const double area = s.area;
  REQUIRE(thin_parts(s, n).places == 1);
  refine_thin_parts(s, n);
  CHECK(s.triangles.size() > facets);
  CHECK(s.area == doctest::Approx(area).epsilon(1e-12));
  CHECK(thin_parts(s, n).places == 0);
}

TEST_CASE("narrow strips between creases: the spacing follows their width, gradually")
{
  const std::size_t n = 3000;
  for (const Density density : {Density::uniform, Density::curvature}) {
    Surface s = shapes::make_surface(shapes::gear(0.5));
    Remeshing_options o;
    o.density = density;
    o.number_of_samples = n;
    set_creases(s, o);
    set_density(s, o);
    const double unit = s.normalization.scale, area = s.area;
    const double width = std::sqrt(0.5) * unit; // of the chamfers
    const auto chamfer_spacings = [&] {
      std::vector<double> result;
      for (int v = 0; v < static_cast<int>(s.points.size()); ++v) {
        const double z = s.normalization.to_outside(s.points[v]).z;
        if (std::min(z, 8 - z) > 0.01 && std::min(z, 8 - z) < 0.501)
          result.push_back(spacing_at(s, n, v));
      }
      return result;
    };
    for (const double before : chamfer_spacings()) CHECK(1.4 * width < 0.9 * before);
    std::vector<double> before;
    for (int v = 0; v < static_cast<int>(s.points.size()); ++v)
      before.push_back(spacing_at(s, n, v));
    refine_narrow_patches(s, n, o.gradation);
    CHECK(s.area == doctest::Approx(area));
    for (const double after : chamfer_spacings()) {
      CHECK(after <= 1.401 * width);
      CHECK(after >= 1.3 * width); // the rectangles like its trapezoids are less wide
    }
    double widest = 0;
    for (int v = 0; v < static_cast<int>(s.points.size()); ++v)
      widest = std::max(widest, spacing_at(s, n, v));
    CHECK(widest > 1.6 * width);
    // vertices keep their numbers
    for (std::size_t v = 0; v < before.size(); ++v)
      CHECK(spacing_at(s, n, int(v)) <= (density == Density::uniform ? 1.3 : 2.001) * before[v]);
    const Surface_edges edges = surface_edges(s);
    for (int v = 0; v < static_cast<int>(s.points.size()); ++v)
      for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
        CHECK(spacing_at(s, n, edges.neighbor[e]) <=
              spacing_at(s, n, v) + 1.01 * o.gradation * edges.length[e]);
  }
}

TEST_CASE("narrow strips: a surface that has none stays as it is")
{
  for (const bool is_creased : {false, true}) {
    Surface s = shapes::make_surface(is_creased ? shapes::box(4) : torus());
    Remeshing_options o = uniform();
    o.number_of_samples = 1000;
    set_creases(s, o);
    CHECK(s.creases.empty() != is_creased);
    const std::vector<double> density = s.vertex_density;
    const std::vector<Triangle> triangles = s.triangles;
    refine_narrow_patches(s, 1000, o.gradation);
    CHECK(s.vertex_density == density);
    CHECK(s.triangles == triangles);
  }
}
