// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sheets that meet in edges of more than two facets are remeshed as one network; inputs that
// intersect themselves become such networks, or closed surfaces around them.
#include "dirty_shapes.h"

#include <CGAL/PowerRTF/geometry/halve_edges.h>
#include <CGAL/PowerRTF/geometry/self_intersections.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF/quality/topology.h>
#include <CGAL/PowerRTF_remesher.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using shapes::Soup;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// How many edges have so many facets, for each such number above 2.
std::map<std::size_t, std::size_t> crowded_edges(const std::vector<Triangle>& triangles)
{
  std::map<Edge, std::size_t> facets;
  for (const Triangle& t : triangles)
    for (int i = 0; i < 3; ++i) ++facets[sorted_edge(t[i], t[(i + 1) % 3])];
  std::map<std::size_t, std::size_t> result;
  for (const auto& [edge, count] : facets)
    if (count > 2) ++result[count];
  return result;
}

struct Run {
  Surface surface;
  Extracted_mesh mesh;
  Remeshing_report report;
};

Remeshing_options options_for(Intersections intersections, std::size_t n = 600)
{
  Remeshing_options options = Remeshing_options::fast_preset();
  options.number_of_samples = n;
  options.density = Density::uniform;
  options.intersections = intersections;
  return options;
}

Run remeshed(const Soup& soup, const Remeshing_options& options)
{
  Run run;
  run.surface = prepare_surface(soup.points, soup.triangles, options, run.report);
  CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<Kernel>> remesher(run.surface, options,
                                                                    run.report);
  Remeshing_default_visitor visitor;
  REQUIRE(remesher.optimize(visitor));
  run.mesh = remesher.extract(visitor);
  run.report = remesher.report();
  return run;
}

/// A square that stands on the middle of another one, upon vertices that both have.
Soup fin()
{
  const Soup floor = shapes::plane_patch(4, 4);
  Soup wall = shapes::plane_patch(4, 4);
  for (Vec3d& p : wall.points) p = {0.5, p.y, p.x};
  return shapes::joined(floor, wall);
}

/// Two squares through each other.
Soup crossing_squares()
{
  Soup wall = shapes::plane_patch(5, 5);
  for (Vec3d& p : wall.points) p = {0.43, 0.9 * p.y + 0.03, p.x - 0.51};
  return shapes::joined(shapes::plane_patch(5, 5), wall);
}

Soup crossing_spheres()
{
  return shapes::joined(shapes::icosphere(2),
                        shapes::translated(shapes::icosphere(2), {0.9, 0.3, 0.2}));
}

double area(const Soup& soup)
{
  double sum = 0;
  for (const Triangle& t : soup.triangles)
    sum += length(cross(soup.points[t[1]] - soup.points[t[0]],
                        soup.points[t[2]] - soup.points[t[0]])) /
           2;
  return sum;
}

std::string refusal(const Soup& soup, const Remeshing_options& options)
{
  Remeshing_report report;
  try {
    prepare_surface(soup.points, soup.triangles, options, report);
  } catch (const Invalid_input_error& e) {
    return e.what();
  }
  return {};
}

} // namespace

TEST_CASE("sheets that meet in edges still meet there, and in nothing else")
{
  struct Case {
    const char* name;
    Soup soup;
    std::size_t sheets, facets_at_edge;
    long euler_characteristic;
  };
  const Soup cubes = shapes::touching_cubes(3, {1, 1, 0});
  for (const Case& c : {Case{"a fin on a floor", fin(), 3, 3, 1},
                        Case{"cubes with a common edge", cubes, 2, 4, 3}}) {
    CAPTURE(std::string(c.name));
    const Run run = remeshed(c.soup, options_for(Intersections::keep));
    for (const std::string& missed : run.report.missed_guarantees()) FAIL_CHECK(missed);
    CHECK(run.report.self_intersections == 0);
    CHECK(run.report.topology.sheets == c.sheets);
    CHECK(run.report.topology.junctions == 1);
    CHECK(run.report.topology.euler_characteristic == c.euler_characteristic);
    const auto crowded = crowded_edges(run.mesh.triangles);
    REQUIRE(crowded.size() == 1);
    CHECK(crowded.begin()->first == c.facets_at_edge);
    // Every sheet has a component of its own once the mesh is cut there.
    CHECK(std::size_t(facet_components(facet_adjacency(run.mesh.triangles, 600)).second) ==
          c.sheets);
  }
}

TEST_CASE("edges in which sheets meet are halved for all of them")
{
  const Soup soup = fin();
  for (const bool all : {false, true}) {
    CAPTURE(all);
    Remeshing_report report;
    Surface surface =
        prepare_surface(soup.points, soup.triangles, options_for(Intersections::keep), report);
    REQUIRE(surface.seams.size() == 4);
    std::map<Edge, std::vector<int>> at_seams;
    for (int h = 0; h < int(3 * surface.triangles.size()); ++h) {
      const Edge edge =
          sorted_edge(halfedge_source(surface.triangles, h), halfedge_target(surface.triangles, h));
      if (std::binary_search(surface.seams.begin(), surface.seams.end(), edge))
        at_seams[edge].push_back(h);
    }
    std::vector<int> halfedges; // of each edge one, or one of each facet
    for (const auto& [edge, own] : at_seams)
      halfedges.insert(halfedges.end(), own.begin(), all ? own.end() : own.begin() + 1);
    const std::size_t vertices = surface.points.size();
    halve_edges(surface, halfedges);
    CHECK(surface.points.size() == vertices + 4);
    CHECK(surface.seams.size() == 8);
    CHECK(crowded_edges(surface.triangles) == std::map<std::size_t, std::size_t>{{3, 8}});
  }
}

TEST_CASE("sheets that touch in a vertex still touch there, and in nothing else")
{
  Soup open = fin(); // whose wall's far corner another square touches
  open = shapes::joined(open, shapes::translated(shapes::plane_patch(3, 3), {0.5, 1, 1}));
  struct Case {
    const char* name;
    Soup soup;
    std::size_t touching; // 0: it has seams, too
    long euler_characteristic;
  };
  for (const Case& c :
       {Case{"cubes with a common vertex", shapes::touching_cubes(3, {1, 1, 1}), 1, 3},
        Case{"a fin that a square touches", open, 0, 1}}) {
    CAPTURE(std::string(c.name));
    const Run run = remeshed(c.soup, options_for(Intersections::keep));
    for (const std::string& missed : run.report.missed_guarantees()) FAIL_CHECK(missed);
    CHECK(run.report.self_intersections == 0);
    CHECK(run.report.topology.vertices == 600);
    CHECK(run.report.topology.components == 1);
    CHECK(run.report.topology.euler_characteristic == c.euler_characteristic);
    if (c.touching > 0) CHECK(run.report.topology.non_manifold_vertices == c.touching);
    CHECK(run.report.quality.q_min > 0.3);
  }
}

TEST_CASE("a closed sheet that touches itself is one as it was given, several are a network")
{
  // Two opposite neighbors of a vertex meet above it: two edges are one for who merges vertices.
  Soup pinched = shapes::icosphere(3);
  const int middle = 500;
  std::map<int, int> ring;
  for (const Triangle& t : pinched.triangles)
    for (int k = 0; k < 3; ++k)
      if (t[k] == middle) ring[t[(k + 1) % 3]] = t[(k + 2) % 3];
  REQUIRE(ring.size() == 6);
  const int a = ring.begin()->first, b = ring[ring[ring[a]]];
  pinched.points[a] = pinched.points[b] = 1.2 * pinched.points[middle];
  REQUIRE(crowded_edges(shapes::merged(pinched).triangles).size() == 1);

  const auto prepared = [](const Soup& soup, Remeshing_report& report) {
    return prepare_surface(soup.points, soup.triangles, options_for(Intersections::keep), report);
  };
  Remeshing_report one, two;
  CHECK(prepared(pinched, one).points.size() == pinched.points.size());
  CHECK(one.repairs.duplicate_vertices == 0);
  const Soup cubes = shapes::joined(shapes::box(3), shapes::translated(shapes::box(3), {2, 2, 0}));
  CHECK(prepared(cubes, two).seams.size() > 0);
  CHECK(two.repairs.duplicate_vertices == 4);
}

TEST_CASE("sheets nearer to each other than their triangles' edges do not intersect")
{
  Soup edge = shapes::rotated(shapes::box(3), 0.7); // one that a square cuts off a little below it
  double top = 0;
  for (const Vec3d& p : edge.points) top = (std::max)(top, p.y);
  Soup floor = shapes::plane_patch(4, 4);
  for (Vec3d& p : floor.points) p = {6 * p.x - 3, top - 0.02, 6 * p.y - 3};
  const Run run = remeshed(shapes::joined(edge, floor), options_for(Intersections::resolve, 400));
  REQUIRE(run.report.cure.resolved_pairs > 0);
  for (const std::string& missed : run.report.missed_guarantees()) FAIL_CHECK(missed);
  CHECK(run.report.self_intersections == 0);
}

TEST_CASE("triangles at a seam are as good as others")
{
  for (const Soup& soup : {fin(), crossing_squares(), shapes::touching_cubes(3, {1, 1, 0})}) {
    const Run run = remeshed(soup, options_for(Intersections::resolve, 1000));
    CHECK(run.report.quality.q_min > 0.5);
  }
}

TEST_CASE("a network that is none in the result misses a guarantee")
{
  Remeshing_report report;
  report.topology = report.input_topology = topology(shapes::merged(fin()).triangles);
  REQUIRE(report.input_topology.non_manifold_edges == 4);
  CHECK(report.input_topology.sheets == 3);
  CHECK(report.input_topology.junctions == 1);
  CHECK(report.input_topology.sheets_characteristic == 3);
  report.samples_asked = report.topology.vertices;
  CHECK(report.missed_guarantees().empty());
  report.topology.sheets = 2;
  CHECK(report.missed_guarantees().size() == 1);
}

TEST_CASE("edges of more than two facets are parted or refused on request")
{
  Remeshing_options options = options_for(Intersections::keep);
  options.non_manifold = Non_manifold::split;
  CHECK(refusal(fin(), options).find("non_manifold = keep") != std::string::npos);
  Remeshing_report report;
  const Soup cubes = shapes::touching_cubes(3, {1, 1, 0});
  CHECK(prepare_surface(cubes.points, cubes.triangles, options, report).seams.empty());
  CHECK(report.repairs.non_manifold_edges == 3);
  options.non_manifold = Non_manifold::refuse;
  CHECK(refusal(cubes, options).find("more than two facets") != std::string::npos);
}

TEST_CASE("intersections that are resolved leave all sheets where they were, and none in the mesh")
{
  struct Case {
    Soup soup;
    std::size_t sheets;
    long euler_characteristic;
  };
  for (const auto& [soup, sheets, characteristic] :
       {Case{crossing_squares(), 3, 1}, Case{crossing_spheres(), 4, 4},
        Case{shapes::rotated(crossing_spheres(), 0.7), 4, 4}}) {
    REQUIRE(self_intersections(soup.points, soup.triangles) > 0);
    const Run run = remeshed(soup, options_for(Intersections::resolve));
    const Surface& s = run.surface;
    CHECK(run.report.cure.resolved_pairs == self_intersections(soup.points, soup.triangles));
    CHECK(self_intersections(s.points, s.triangles) == 0);
    CHECK(s.area / (s.normalization.scale * s.normalization.scale) == Approx(area(soup)));
    CHECK(run.report.topology.sheets == sheets);
    CHECK(run.report.topology.euler_characteristic == characteristic);
    for (const std::string& missed : run.report.missed_guarantees()) FAIL_CHECK(missed);
    const auto crowded = crowded_edges(run.mesh.triangles);
    REQUIRE(crowded.size() == 1);
    CHECK(crowded.begin()->first == 4);
  }
}

TEST_CASE("cuts that would meet in one point, but for rounding, are resolved")
{
  const Soup spindle = shapes::rotated(shapes::torus(24, 12, 0.5, 1), 0.7);
  REQUIRE(self_intersections(spindle.points, spindle.triangles) > 0);
  Remeshing_report report;
  const Surface s = prepare_surface(spindle.points, spindle.triangles,
                                    options_for(Intersections::resolve), report);
  CHECK(self_intersections(s.points, s.triangles) == 0);
}

TEST_CASE("overlapping facets in one plane are resolved to one sheet")
{
  const Soup soup = shapes::joined(shapes::plane_patch(3, 3),
                                   shapes::translated(shapes::plane_patch(3, 3), {0.5, 0.25, 0}));
  Remeshing_report report;
  const Surface s =
      prepare_surface(soup.points, soup.triangles, options_for(Intersections::resolve), report);
  CHECK(self_intersections(s.points, s.triangles) == 0);
  CHECK(s.area / (s.normalization.scale * s.normalization.scale) == Approx(2 - 0.5 * 0.75));
  CHECK(s.seams.empty() == (s.adjacency.non_manifold_edges == 0));
}

TEST_CASE("what is resolved is scaled with the input")
{
  const Soup soup = crossing_spheres();
  const double factor = 0x1p40;
  const Soup large = shapes::scaled(soup, factor);
  const Remeshing_options options = options_for(Intersections::resolve);
  Remeshing_report report;
  const Surface a = prepare_surface(soup.points, soup.triangles, options, report);
  const Surface b = prepare_surface(large.points, large.triangles, options, report);
  CHECK(a.points == b.points);
  CHECK(a.triangles == b.triangles);
}

TEST_CASE("a wrap is closed, near the input, and does not intersect itself")
{
  Soup soup = crossing_spheres(); // with holes of three facets, turned at random
  for (const std::size_t f : {300, 100, 10}) soup.triangles.erase(soup.triangles.begin() + f);
  soup = shapes::some_reversed(soup, 3);
  Remeshing_options options = options_for(Intersections::wrap);
  options.wrap_radius = 0.15;
  const Run run = remeshed(soup, options);
  for (const std::string& missed : run.report.missed_guarantees()) FAIL_CHECK(missed);
  CHECK(run.report.topology.border_edges == 0);
  CHECK(run.report.topology.euler_characteristic == 2);
  CHECK(run.report.topology.components == 1);
  const Intersection_cure& cure = run.report.cure;
  CHECK(cure.wrap_radius == 0.15);
  CHECK(cure.wrap_offset > 0);
  const Surface& s = run.surface;
  CHECK(self_intersections(s.points, s.triangles) == 0);
  // Its vertices lie outside both spheres, at the offset.
  for (const Vec3d& inside : s.points) {
    const Vec3d p = s.normalization.to_outside(inside);
    const double r = (std::min)(length(p), length(p - Vec3d{0.9, 0.3, 0.2}));
    CHECK(r > 0.94);
    CHECK(r < 1 + 2 * cure.wrap_offset + 0.01);
  }
}

TEST_CASE("vertices on edges are joined with them within the tolerance")
{
  // A square beside two halves: a T-junction, torn by a crack.
  const double crack = 1e-3;
  const Soup soup{{{0, 0, 0},
                   {1, 0, 0},
                   {1, 1, 0},
                   {0, 1, 0},
                   {1 + crack, 0, 0},
                   {2, 0, 0},
                   {2, 0.5, 0},
                   {1 + crack, 0.5, 0},
                   {1 + crack, 1, 0},
                   {2, 1, 0}},
                  {{{0, 1, 2}}, {{0, 2, 3}}, {{4, 5, 6}}, {{4, 6, 7}}, {{7, 6, 9}}, {{7, 9, 8}}}};
  for (const double factor : {1., 1e200, 1e-200}) {
    const Soup scaled = shapes::scaled(soup, factor);
    Remeshing_options options = options_for(Intersections::keep, 200);
    Remeshing_report apart, joined;
    CHECK(prepare_surface(scaled.points, scaled.triangles, options, apart).adjacency.border_edges ==
          4 + 6);
    options.merge_distance = 2 * crack * factor;
    const Surface s = prepare_surface(scaled.points, scaled.triangles, options, joined);
    CHECK(joined.repairs.duplicate_vertices == 2);
    CHECK(joined.repairs.inserted_vertices == 1);
    CHECK(s.adjacency.border_edges == 3 + 4);
    CHECK(s.points.size() == 8);
    CHECK(self_intersections(s.points, s.triangles) == 0);
    CHECK(s.area / (s.normalization.scale * factor) / (s.normalization.scale * factor) ==
          Approx(2).epsilon(1e-3));
    options.merge_distance = crack / 2 * factor;
    prepare_surface(scaled.points, scaled.triangles, options, apart = {});
    CHECK(apart.repairs.duplicate_vertices == 0);
  }
}

TEST_CASE("a doubled layer is one within the tolerance")
{
  const Soup layer = shapes::plane_patch(4, 4);
  const Soup soup =
      shapes::joined(layer, shapes::shaken(shapes::translated(layer, {0, 0, 1e-3}), 1e-4, 1));
  Remeshing_options options = options_for(Intersections::keep, 200);
  options.merge_distance = 2e-3;
  const Run run = remeshed(soup, options);
  CHECK(run.report.repairs.duplicate_facets == layer.triangles.size());
  CHECK(run.report.repairs.duplicate_vertices == layer.points.size());
  CHECK(run.report.topology.components == 1);
  for (const std::string& missed : run.report.missed_guarantees()) FAIL_CHECK(missed);
}

TEST_CASE("facets without area are refused, however they are to be cured")
{
  const Soup line{{{0, 3, -1}, {0, 1, 1}, {0, 2, 0}}, {{0, 1, 2}}};
  Remeshing_report report;
  for (const Intersections intersections :
       {Intersections::keep, Intersections::resolve, Intersections::wrap})
    CHECK_THROWS_AS(
        prepare_surface(line.points, line.triangles, options_for(intersections), report),
        Invalid_input_error);
}

TEST_CASE("what cannot be had of a cured input is refused")
{
  Remeshing_options options = options_for(Intersections::wrap);
  options.max_distance = 0.1;
  CHECK_THROWS_AS(validate(options), Invalid_input_error);
  const Soup soup = crossing_spheres();
  Remeshing_report report;
  Surface_fields fields;
  fields.densities.emplace(soup.points.size(), 1);
  CHECK_THROWS_AS(prepare_surface(internal::soup_of_ranges(soup.points, soup.triangles), fields,
                                  options_for(Intersections::resolve), report),
                  Invalid_input_error);
}
