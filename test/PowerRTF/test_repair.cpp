// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dirty_shapes.h"

#include <CGAL/PowerRTF/geometry/component_topology.h>
#include <CGAL/PowerRTF/geometry/cut_surface.h>
#include <CGAL/PowerRTF/geometry/degenerate_facets.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF/quality/topology.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <doctest/doctest.h>

#include <cmath>
#include <string>

namespace PRTF = CGAL::PowerRTF;
using PRTF::import_soup;
using PRTF::Repair;
using PRTF::Repair_counts;
using PRTF::Surface;
using PRTF::Triangle;
using PRTF::Vec3d;

namespace {

struct Expected {
  std::size_t components;
  long euler_characteristic;
  std::size_t border_loops;
};

/// The imported surface is a sound one of that topology.
Surface check(const shapes::Soup& soup, const Expected& expected, Repair_counts& repairs)
{
  const Surface s = import_soup(soup.points, soup.triangles, repairs);
  const PRTF::Topology_statistics t = PRTF::topology(s.triangles);
  CHECK(t.non_manifold_edges == 0);
  CHECK(t.non_manifold_vertices == 0);
  CHECK(t.oriented);
  CHECK(t.vertices == s.points.size());
  CHECK(t.components == expected.components);
  CHECK(t.euler_characteristic == expected.euler_characteristic);
  CHECK(t.border_loops == expected.border_loops);
  const PRTF::Facet_adjacency adjacency = PRTF::facet_adjacency(s.triangles, s.points.size());
  CHECK(s.adjacency.opposite == adjacency.opposite);
  CHECK(s.adjacency.border_edges == adjacency.border_edges);
  CHECK(s.adjacency.same_direction == adjacency.same_direction);
  return s;
}

double outside_area(const Surface& s)
{
  return s.area / (s.normalization.scale * s.normalization.scale);
}

std::string refusal(const shapes::Soup& soup, Repair repair)
{
  Repair_counts repairs;
  try {
    import_soup(soup.points, soup.triangles, repairs, repair);
  } catch (const PRTF::Invalid_input_error& e) {
    return e.what();
  }
  return "";
}

bool mentions(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}

double signed_volume(const Surface& s)
{
  double sum = 0;
  for (const Triangle& t : s.triangles)
    sum += dot(s.points[t[0]], cross(s.points[t[1]], s.points[t[2]])) / 6;
  return sum / std::pow(s.normalization.scale, 3);
}

} // namespace

TEST_CASE("cubes that touch in a face, an edge or a vertex are parted, nothing moves")
{
  for (const int divisions : {1, 3})
    for (const Vec3d& shift : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{1, 1, 0}, Vec3d{0, 1, 1},
                               Vec3d{1, 1, 1}, Vec3d{-1, 1, 0}}) {
      CAPTURE(divisions);
      CAPTURE(shift.x + 10 * shift.y + 100 * shift.z);
      const shapes::Soup cubes = shapes::touching_cubes(divisions, shift);
      const int common = 3 - int(std::abs(shift.x) + std::abs(shift.y) + std::abs(shift.z));
      for (const double angle : {0., 0.4}) {
        Repair_counts repairs;
        const Surface s = check(shapes::rotated(cubes, angle), {2, 4, 0}, repairs);
        CHECK(outside_area(s) == doctest::Approx(48));
        CHECK(signed_volume(s) == doctest::Approx(16));
        const std::size_t d = std::size_t(divisions);
        const std::size_t vertices[] = {1, d + 1, (d + 1) * (d + 1)};
        CHECK(repairs.non_manifold_vertices == vertices[common]);
        CHECK((repairs.non_manifold_edges > 0) == (common > 0));
        CHECK(repairs.reoriented_facets == 0);
        CHECK(s.points.size() == cubes.points.size() + vertices[common]);
        for (std::size_t v = 0; v < s.points.size(); ++v) // copies are where their vertex is
          CHECK(length(s.normalization.to_outside(s.points[v]) -
                       shapes::rotated(cubes, angle).points[s.input_vertices[v]]) < 1e-12);
      }
      CHECK(mentions(refusal(cubes, Repair::no), "not a 2-manifold"));
    }
}

TEST_CASE("touching cubes whose facets are turned at random are oriented, too")
{
  for (const Vec3d& shift : {Vec3d{1, 1, 0}, Vec3d{1, 1, 1}}) {
    const shapes::Soup cubes = shapes::some_reversed(shapes::touching_cubes(3, shift), 5);
    Repair_counts repairs;
    const Surface s = check(cubes, {2, 4, 0}, repairs);
    CHECK(std::abs(signed_volume(s)) == doctest::Approx(16));
    CHECK(repairs.reoriented_facets > 0);
  }
}

TEST_CASE("a sheet that touches another one along a single edge gets a vertex in its middle")
{
  // Two tetrahedra with a common edge, whose other vertices differ.
  const shapes::Soup tetrahedra{
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}},
      {{{0, 2, 1}},
       {{0, 1, 3}},
       {{0, 3, 2}},
       {{1, 2, 3}},
       {{0, 4, 1}},
       {{0, 1, 5}},
       {{0, 5, 4}},
       {{1, 4, 5}}}};
  Repair_counts repairs;
  const Surface parted = check(tetrahedra, {2, 4, 0}, repairs);
  CHECK(repairs.non_manifold_edges == 1);
  CHECK(parted.points.size() == 8);

  // A torus pinched along an edge: its ends cannot be parted.
  shapes::Soup pinched = shapes::torus(12, 8, 2, 1);
  const auto replace = [&](int a, int b) {
    for (Triangle& t : pinched.triangles)
      for (int& v : t)
        if (v == b) v = a;
  };
  replace(4, 6 * 8 + 4);
  replace(5, 6 * 8 + 5);
  repairs = {};
  const Surface s = check(pinched, {1, 0, 0}, repairs);
  CHECK(repairs.non_manifold_edges == 1);
}

TEST_CASE("two sheets that cross in edges are made to touch there")
{
  const shapes::Soup sheet = shapes::plane_patch(4, 4);
  shapes::Soup other = shapes::translated(sheet, {-0.5, -0.5, 0});
  for (Vec3d& p : other.points) p = {p.x + 0.5, 0.5, p.y};
  Repair_counts repairs;
  const Surface s = check(shapes::merged(shapes::joined(sheet, other)), {2, 2, 2}, repairs);
  CHECK(outside_area(s) == doctest::Approx(2));
  CHECK(repairs.non_manifold_edges == 4);
}

TEST_CASE("what would change its shape is refused")
{
  SUBCASE("a wall inside a box: three facets at its edges")
  {
    shapes::Soup cubes = shapes::touching_cubes(1, {1, 0, 0});
    const auto is_wall = [&](const Triangle& t) {
      return cubes.points[t[0]].x == 1 && cubes.points[t[1]].x == 1 && cubes.points[t[2]].x == 1;
    };
    std::size_t seen = 0;
    std::vector<Triangle> kept;
    for (const Triangle& t : cubes.triangles)
      if (!is_wall(t) || ++seen <= 2) kept.push_back(t);
    cubes.triangles = kept;
    const std::string text = refusal(cubes, Repair::yes);
    CHECK(mentions(text, "4 edge(s) with more than two facets"));
    CHECK(mentions(text, "shape"));
  }
  SUBCASE("a Moebius strip that is not to be touched")
  {
    CHECK(mentions(refusal(shapes::moebius_strip(30), Repair::no), "oriented"));
  }
}

TEST_CASE("spheres with a defect are the sphere again")
{
  for (const auto& [title, soup] : shapes::dirty_spheres()) {
    const std::string& name = title;
    CAPTURE(name);
    Repair_counts repairs;
    const Surface s = check(soup, {1, 2, 0}, repairs);
    CHECK(signed_volume(s) > 0);
    if (name != "facets of very different sizes" && name != "slivers" && name != "finer slivers" &&
        name != "facets without area")
      CHECK(s.triangles.size() == 320);
    CHECK(PRTF::degenerate_facets(s.points, s.triangles).empty());
    const bool is_dirty = name == "facets the wrong way round" || name == "facets without area" ||
                          mentions(name, "repeated facets");
    CHECK(refusal(soup, Repair::no).empty() != is_dirty);
  }
}

TEST_CASE("cracks are closed where they are narrow, and only there")
{
  const shapes::Soup torn = shapes::shaken(shapes::cut_into_facets(shapes::box(4)), 1e-6, 3);
  Repair_counts repairs;
  const Surface closed = check(torn, {1, 2, 0}, repairs);
  CHECK(closed.points.size() == shapes::box(4).points.size());
  CHECK(repairs.duplicate_vertices == torn.points.size() - closed.points.size());

  const shapes::Soup patch = shapes::plane_patch(4, 4); // two patches with a gap that is meant
  for (const double gap : {1e-3, 1e-2}) {
    repairs = {};
    check(shapes::joined(patch, shapes::translated(patch, {1 + gap, 0, 0})), {2, 2, 2}, repairs);
    CHECK(repairs.duplicate_vertices == 0);
  }
}

TEST_CASE("a mesh may touch itself in a vertex; its vertices are known by their own places")
{
  using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;
  Mesh mesh;
  const auto v = [&](double x, double y) { return mesh.add_vertex({x, y, x * y}); };
  const auto a = v(0, 0), b = v(1, 0), c = v(1, 1), d = v(-1, 0), e = v(-1, -1);
  mesh.add_face(a, b, c);
  mesh.add_face(a, d, e);
  Repair_counts repairs;
  const Surface s = PRTF::import_surface(mesh, CGAL::parameters::default_values(), repairs);
  CHECK(s.points.size() == 6);
  CHECK(repairs.non_manifold_vertices == 1);
  CHECK(std::count(s.input_vertices.begin(), s.input_vertices.end(), 0) == 2);
  CHECK_THROWS_AS(
      PRTF::import_surface(mesh, CGAL::parameters::default_values(), repairs, Repair::no),
      PRTF::Invalid_input_error);
}

TEST_CASE("vertices that no facet has stand for none at the same point")
{
  shapes::Soup cube = shapes::box(1);
  std::vector<Vec3d> points = cube.points; // unused
  const int unused = static_cast<int>(points.size());
  points.insert(points.end(), cube.points.begin(), cube.points.end());
  points[1] = {1e9, 0, 0}; // and this one somewhere else
  for (Triangle& t : cube.triangles)
    for (int& v : t) v += unused;
  Repair_counts repairs;
  const Surface s = PRTF::import_soup(points, cube.triangles, repairs);
  CHECK(s.triangles.size() == cube.triangles.size());
  CHECK(s.points.size() == 8);
  CHECK(repairs.unused_vertices == std::size_t(unused));
  CHECK(repairs.degenerate_facets == 0);
  for (const int v : s.input_vertices) CHECK(v >= unused);
}

TEST_CASE("lines may have vertices of their own, before those of the facets or after them")
{
  const shapes::Soup patch = shapes::plane_patch(4, 4);
  const std::vector<Vec3d> own = {{0.5, 0.25, 0}, {0.5, 0.5, 0}}; // an edge of two facets
  for (const bool is_before : {true, false}) {
    std::vector<Vec3d> points = is_before ? own : patch.points;
    const int first_facet_point = is_before ? 2 : 0;
    const std::vector<Vec3d>& others = is_before ? patch.points : own;
    const int first_own = is_before ? 0 : static_cast<int>(points.size());
    points.insert(points.end(), others.begin(), others.end());
    std::vector<Triangle> triangles = patch.triangles;
    for (Triangle& t : triangles)
      for (int& v : t) v += first_facet_point;
    PRTF::Surface_fields fields;
    fields.lines = {{first_own, first_own + 1}};
    PRTF::Remeshing_options options;
    options.number_of_samples = 100;
    PRTF::Remeshing_report report;
    const Surface s = PRTF::prepare_surface(PRTF::internal::soup_of_ranges(points, triangles),
                                            fields, options, report);
    REQUIRE(s.creases.size() == 1);
    for (int k = 0; k < 2; ++k) {
      const Vec3d p = s.normalization.to_outside(s.points[s.creases[0][k]]);
      CHECK((p == own[0] || p == own[1]));
    }
  }
}

TEST_CASE("the fewest vertices of a surface of given topology")
{
  CHECK(PRTF::least_vertices(2, 0) == 4);   // tetrahedron
  CHECK(PRTF::least_vertices(0, 0) == 7);   // Csaszar's torus
  CHECK(PRTF::least_vertices(-2, 0) <= 10); // the bound, 9, is not reached for genus 2
  CHECK(PRTF::least_vertices(-4, 0) == 10);
  CHECK(PRTF::least_vertices(1, 1) == 3); // a triangle
  CHECK(PRTF::least_vertices(0, 2) == 6); // a prism's side
}

TEST_CASE("topology of the components; too few samples for it are refused with the number needed")
{
  const shapes::Soup torus = shapes::translated(shapes::torus(12, 8, 2, 1), {9, 0, 0});
  const shapes::Soup soup =
      shapes::joined(shapes::joined(shapes::icosphere(1), torus),
                     shapes::translated(shapes::open_cylinder(8, 3, 1, 1), {0, 9, 0}));
  Repair_counts repairs;
  const Surface s = check(soup, {3, 2, 2}, repairs);
  const auto [component, count] = PRTF::facet_components(s.adjacency);
  const auto components = PRTF::component_topologies(s, component, count);
  REQUIRE(components.size() == 3);
  CHECK(components[0].euler_characteristic == 2);
  CHECK(components[1].euler_characteristic == 0);
  CHECK(components[1].border_loops == 0);
  CHECK(components[2].euler_characteristic == 0);
  CHECK(components[2].border_loops == 2);
  CHECK_NOTHROW(PRTF::require_enough_samples(s, 4 + 7 + 6));
  try {
    PRTF::require_enough_samples(s, 16);
    FAIL("16 samples are too few");
  } catch (const PRTF::Invalid_input_error& e) {
    CHECK(mentions(e.what(), "at least 17 are needed for its 3 components"));
    CHECK(mentions(e.what(), "7 of them for the one at vertex"));
    CHECK(mentions(e.what(), "genus 1 with 0 border loops"));
  }
}

TEST_CASE("a seam inside of a sheet that cutting would leave closed gets a vertex in the middle")
{
  shapes::Soup soup = shapes::plane_patch(3, 3);
  const std::size_t before = soup.points.size();
  soup.points.push_back({0.5, 1. / 3, 1});
  soup.triangles.push_back({5, 6, static_cast<int>(before)}); // stands on an edge of the square
  Repair_counts repairs;
  const Surface s =
      import_soup(soup.points, soup.triangles, repairs, Repair::yes, PRTF::Non_manifold::keep);
  CHECK(s.seams.size() == 2);
  CHECK(s.points.size() == before + 2);
  CHECK(PRTF::topology(s.triangles).junctions == 1);
  // Once it is cut, the middle is there twice in the square, and all three in the triangle.
  CHECK(PRTF::cut_along_creases(s).surface.points.size() == s.points.size() + 4);
  CHECK(PRTF::cut_along_creases(s).surface.adjacency.non_manifold_edges == 0);
}
