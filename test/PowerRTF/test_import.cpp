// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Soups as they become surfaces: cleaned, triangulated, oriented, scaled to the unit box, or
// refused.
#include "shapes.h"
#include "sound_surface.h"

#include <CGAL/PowerRTF/geometry/degenerate_facets.h>
#include <CGAL/PowerRTF/geometry/surface_geometry.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace PRTF = CGAL::PowerRTF;
using PRTF::import_soup;
using PRTF::Repair_counts;
using PRTF::Surface;
using PRTF::Triangle;
using PRTF::Vec3d;
using sound_surface::check_is_sound;
using sound_surface::euler_characteristic;
using sound_surface::reason;
using Polygons = std::vector<std::vector<long>>;

namespace {

std::string soup_reason(const std::vector<Vec3d>& points, const Polygons& polygons)
{
  Repair_counts repairs;
  return reason([&] { import_soup(points, polygons, repairs); });
}

/// Positive when oriented outwards.
double signed_volume(const Surface& s)
{
  double sum = 0;
  for (const Triangle& t : s.triangles)
    sum += dot(s.points[t[0]], cross(s.points[t[1]], s.points[t[2]]));
  return sum / 6;
}

} // namespace

TEST_CASE("closed shapes keep their topology, area and orientation")
{
  struct Case {
    shapes::Soup soup;
    long euler;
  };
  const Case cases[] = {{shapes::tetrahedron(), 2},
                        {shapes::octahedron(), 2},
                        {shapes::icosphere(2), 2},
                        {shapes::torus(30, 20, 2, 1), 0},
                        {shapes::box(5), 2},
                        {shapes::ellipsoid(3, 2, 1, 2), 2},
                        {shapes::thin_disc(0.01), 2},
                        {shapes::two_spheres(1), 4},
                        {shapes::plane_patch(4, 7), 1},
                        {shapes::open_cylinder(20, 6, 1, 2), 0}};
  for (const Case& c : cases) {
    Repair_counts repairs;
    const Surface s = import_soup(c.soup.points, c.soup.triangles, repairs);
    check_is_sound(s);
    CHECK(s.points.size() == c.soup.points.size());
    CHECK(s.triangles.size() == c.soup.triangles.size());
    CHECK(euler_characteristic(s) == c.euler);
    CHECK(repairs.duplicate_vertices + repairs.unused_vertices + repairs.degenerate_facets +
              repairs.triangulated_polygons + repairs.duplicate_facets +
              repairs.reoriented_facets ==
          0);
    if (c.euler % 2 == 0 && &c != &cases[9]) CHECK(signed_volume(s) > 0);
  }
}

TEST_CASE("large surfaces are in spatial order, whatever the order of the input")
{
  const auto import = [](const shapes::Soup& soup) {
    Repair_counts repairs;
    return import_soup(soup.points, soup.triangles, repairs);
  };
  const auto mean_leap = [](const Surface& s) { // between the numbers of neighbors
    double sum = 0;
    for (const auto& [a, b, c] : s.triangles) sum += std::abs(a - b) + std::abs(b - c);
    return sum / (2 * double(s.triangles.size()));
  };
  const shapes::Soup ball = shapes::permuted(shapes::icosphere(6), 1); // 81920 facets
  const Surface s = import(ball);
  check_is_sound(s);
  CHECK(mean_leap(s) < 0.02 * double(s.points.size())); // at random: 1/3 of it
  for (std::size_t v = 0; v < s.points.size(); ++v)
    CHECK(length(s.normalization.to_outside(s.points[v]) - ball.points[s.input_vertices[v]]) <
          1e-15);
  std::vector<int> inputs = s.input_vertices;
  std::sort(inputs.begin(), inputs.end());
  for (std::size_t v = 0; v < inputs.size(); ++v) CHECK(inputs[v] == int(v));
  const Surface other = import(shapes::permuted(ball, 2));
  CHECK(other.points == s.points);
  CHECK(shapes::sorted(other.triangles) == shapes::sorted(s.triangles));

  std::iota(inputs.begin(), inputs.end(), 0);
  const shapes::Soup small = shapes::permuted(shapes::icosphere(5), 1); // 20480 facets
  inputs.resize(small.points.size());
  CHECK(import(small).input_vertices == inputs); // these keep their order
}

TEST_CASE("areas and normals")
{
  const Surface box = shapes::make_surface(shapes::box(3));
  CHECK(box.normalization.scale == 0.5);
  CHECK(box.area / (0.5 * 0.5) == doctest::Approx(24));
  double sum = 0;
  for (const double a : box.facet_areas) sum += a;
  CHECK(sum == doctest::Approx(box.area));
  const shapes::Soup soup = shapes::box(1);
  const Surface cube = shapes::make_surface(soup);
  for (std::size_t v = 0; v < cube.points.size(); ++v) // whatever the diagonals of the squares
    CHECK(length(cube.vertex_normals[v] - normalized(cube.points[v])) < 1e-12);
  const Surface sphere = shapes::make_surface(shapes::icosphere(4));
  for (std::size_t v = 0; v < sphere.points.size(); ++v)
    CHECK(dot(sphere.vertex_normals[v], normalized(sphere.points[v])) > 0.9999);
}

TEST_CASE("the unit box: any size, any place")
{
  const shapes::Soup torus = shapes::torus(20, 10, 2, 0.7);
  const Surface reference = shapes::make_surface(torus);
  for (const double factor : {1e-12, 1e-3, 0.25, 1024., 1e12, 1e100, 1e-100}) {
    const Surface s = shapes::make_surface(shapes::scaled(torus, factor));
    check_is_sound(s);
    const double relative = s.normalization.scale * factor / reference.normalization.scale;
    CHECK(s.triangles == reference.triangles);
    for (std::size_t v = 0; v < s.points.size(); ++v)
      CHECK(length(s.points[v] - relative * reference.points[v]) < 1e-14);
  }
  const Surface power_of_two = shapes::make_surface(shapes::scaled(torus, 1024));
  CHECK(power_of_two.points == reference.points);
  CHECK(power_of_two.vertex_normals == reference.vertex_normals);

  const Surface far = shapes::make_surface(shapes::translated(torus, {1e6, -1e6, 3e6}));
  check_is_sound(far);
  for (std::size_t v = 0; v < far.points.size(); ++v) {
    CHECK(length(far.points[v] - reference.points[v]) < 1e-9);
    const Vec3d back = far.normalization.to_outside(far.points[v]);
    CHECK(length(back - (torus.points[v] + Vec3d{1e6, -1e6, 3e6})) < 1e-9);
  }
}

TEST_CASE("soups: duplicate and unused vertices, repeated and degenerate polygons, orientation")
{
  const shapes::Soup sphere = shapes::icosphere(2);
  shapes::Soup cut; // every facet with its own three vertices
  for (const Triangle& t : sphere.triangles) {
    const int k = static_cast<int>(cut.points.size());
    for (const int v : t) cut.points.push_back(sphere.points[v]);
    cut.triangles.push_back({k, k + 1, k + 2});
  }
  cut.points.push_back({9, 9, 9}); // outside the box of the rest, unused
  cut.points.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  cut.triangles.push_back({0, 0, 1});
  cut.triangles.push_back({4, 5, 3}); // repeats the second facet
  std::swap(cut.triangles[3][0], cut.triangles[3][1]);
  std::swap(cut.triangles[40][0], cut.triangles[40][1]);
  Repair_counts repairs;
  const Surface s = import_soup(cut.points, cut.triangles, repairs);
  check_is_sound(s);
  CHECK(s.points.size() == sphere.points.size());
  CHECK(s.triangles.size() == sphere.triangles.size());
  CHECK(euler_characteristic(s) == 2);
  CHECK(signed_volume(s) > 0);
  CHECK(repairs.duplicate_vertices == 3 * sphere.triangles.size() - sphere.points.size());
  CHECK(repairs.unused_vertices == 2);
  CHECK(repairs.degenerate_facets == 1);
  CHECK(repairs.duplicate_facets == 1);
  CHECK(repairs.reoriented_facets == 2);
}

TEST_CASE("a component that is inside out stays so")
{
  shapes::Soup soup = shapes::two_spheres(1);
  for (std::size_t f = soup.triangles.size() / 2; f < soup.triangles.size(); ++f)
    std::swap(soup.triangles[f][0], soup.triangles[f][1]);
  Repair_counts repairs;
  const Surface s = import_soup(soup.points, soup.triangles, repairs);
  CHECK(repairs.reoriented_facets == 0);
  CHECK(std::abs(signed_volume(s)) < 1e-9);
}

TEST_CASE("negative zero is zero")
{
  const std::vector<Vec3d> points = {{0, 0, 0},     {1, 0, 0},   {0, 1, 0},
                                     {-0., -0., 0}, {1, -0., 0}, {0, -1, 0}};
  Repair_counts repairs;
  const Surface s = import_soup(points, Polygons{{0, 1, 2}, {4, 3, 5}}, repairs);
  CHECK(s.points.size() == 4);
  CHECK(repairs.duplicate_vertices == 2);
}

TEST_CASE("closed sheets that touch in a point stay apart")
{
  const shapes::Soup two =
      shapes::joined(shapes::octahedron(), shapes::translated(shapes::octahedron(), {2, 0, 0}));
  Repair_counts repairs;
  const Surface s = import_soup(two.points, two.triangles, repairs);
  check_is_sound(s);
  CHECK(s.points.size() == 12);
  CHECK(repairs.duplicate_vertices == 0);
}

TEST_CASE("polygons")
{
  Repair_counts repairs;
  SUBCASE("a cube of squares")
  {
    const std::vector<Vec3d> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                       {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const Polygons squares = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                              {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    const Surface s = import_soup(points, squares, repairs);
    check_is_sound(s);
    CHECK(s.triangles.size() == 12);
    CHECK(s.area == doctest::Approx(6));
    CHECK(repairs.triangulated_polygons == 6);
  }
  SUBCASE("not convex: a comb with collinear vertices; the cut does not depend on place and size")
  {
    std::vector<Vec3d> points;
    const int teeth = 30;
    for (int i = 0; i <= 2 * teeth; ++i) points.push_back({double(i), 0, 0});
    for (int i = 2 * teeth; i >= 0; --i) points.push_back({double(i), i % 2 ? 1. : 9., 0});
    std::vector<long> polygon(points.size());
    std::iota(polygon.begin(), polygon.end(), 0);
    const double scale = 1. / 64; // power of two; sides up to 60
    const Surface s = import_soup(points, Polygons{polygon}, repairs);
    check_is_sound(s);
    CHECK(s.triangles.size() == points.size() - 2);
    CHECK(s.area / (scale * scale) == doctest::Approx(5. * 2 * teeth));
    for (const Vec3d& n : s.facet_normals) CHECK(n.z == doctest::Approx(1));
    CHECK(euler_characteristic(s) == 1);
    for (Vec3d& p : points) p = 1000. / 3 * (p + Vec3d{1, 2, 3});
    const Surface moved = import_soup(points, Polygons{polygon}, repairs);
    CHECK(moved.triangles == s.triangles);
  }
  SUBCASE("repeated corners")
  {
    const std::vector<Vec3d> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Surface s = import_soup(points, Polygons{{0, 1, 1, 2, 3, 0}, {0, 0, 1}}, repairs);
    CHECK(s.triangles.size() == 2);
    CHECK(repairs.degenerate_facets == 1);
  }
}

TEST_CASE("facets without area are removed and the surface stays closed")
{
  Repair_counts repairs;
  SUBCASE("caps: vertices on the edges of an octahedron, split on one side only")
  {
    shapes::Soup s = shapes::octahedron();
    // Two points on the edge 0-2 of the facet 0 2 4; the sliver 0 .. 2 closes the gap.
    s.points.push_back({2. / 3, 1. / 3, 0});
    s.points.push_back({1. / 3, 2. / 3, 0});
    s.triangles[0] = {0, 6, 4};
    s.triangles.push_back({6, 7, 4});
    s.triangles.push_back({7, 2, 4});
    s.triangles.push_back({6, 0, 2});
    s.triangles.push_back({7, 6, 2});
    for (const double angle : {0., 0.3, 1.1, 2.5}) {
      repairs = {};
      const shapes::Soup r = shapes::rotated(s, angle);
      const Surface surface = import_soup(r.points, r.triangles, repairs);
      check_is_sound(surface);
      CHECK(repairs.degenerate_facets == 2);
      CHECK(PRTF::degenerate_facets(surface.points, surface.triangles).empty());
      CHECK(surface.points.size() == 8);
      CHECK(euler_characteristic(surface) == 2);
      const double scale = surface.normalization.scale;
      CHECK(surface.area / (scale * scale) == doctest::Approx(8 * std::sqrt(3.) / 2));
    }
  }
  SUBCASE("at a border")
  {
    const std::vector<Vec3d> points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}};
    const Surface s = import_soup(points, Polygons{{0, 1, 3}, {1, 2, 3}, {1, 0, 2}}, repairs);
    check_is_sound(s);
    CHECK(s.triangles.size() == 2);
    CHECK(repairs.degenerate_facets == 1);
  }
}

TEST_CASE("normals of a facet without area that cannot be removed are still of length 1")
{
  // All edges that a flip could make exist already: a flat double tetrahedron.
  Surface s;
  s.points = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {0.5, 1, 0}};
  s.triangles = {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}, {0, 3, 2}};
  s.adjacency = PRTF::facet_adjacency(s.triangles, s.points.size());
  PRTF::compute_geometry(s);
  for (const Vec3d& n : s.facet_normals) CHECK(length(n) == doctest::Approx(1));
  for (const Vec3d& n : s.vertex_normals) CHECK(length(n) == doctest::Approx(1));
}

TEST_CASE("what cannot be used is refused with a reason")
{
  const auto mentions = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  const std::vector<Vec3d> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();

  CHECK(mentions(soup_reason({}, {}), "no facet"));
  CHECK(mentions(soup_reason(points, {}), "no facet"));
  CHECK(mentions(soup_reason(points, {{0, 1, 5}}), "vertex 5"));
  CHECK(mentions(soup_reason(points, {{0, 1, 2}, {0, -1, 2}}), "facet 1"));
  CHECK(mentions(soup_reason({{0, 0, 0}, {1, nan, 0}, {0, 1, 0}}, {{0, 1, 2}}), "vertex 1"));
  CHECK(mentions(soup_reason({{0, 0, 0}, {1, 0, 0}, {0, infinity, 0}}, {{0, 1, 2}}), "vertex 2"));
  CHECK(mentions(soup_reason({{-1e308, 0, 0}, {1e308, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), "large"));
  CHECK(mentions(soup_reason({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}), "no area"));
  CHECK(mentions(soup_reason({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, {{0, 1, 2}}), "no area"));
  CHECK(mentions(soup_reason(points, {{0, 1}}), "no area"));
  CHECK(mentions(soup_reason(points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), "1 edge"));
  const shapes::Soup touching = shapes::joined(
      shapes::plane_patch(1, 1), shapes::translated(shapes::plane_patch(1, 1), {1, 1, 0}));
  Repair_counts repairs;
  CHECK(mentions(
      reason([&] { import_soup(touching.points, touching.triangles, repairs, PRTF::Repair::no); }),
      "1 vertex"));
  CHECK(repairs.duplicate_vertices == 0); // nothing was mended
}
