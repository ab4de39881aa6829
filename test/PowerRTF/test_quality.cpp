// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quality, lengths, topology and capacities against closed forms.
#include "dirty_shapes.h"
#include "shapes.h"

#include <CGAL/PowerRTF/quality/assess.h>
#include <CGAL/PowerRTF/quality/surface_distance.h>
#include <CGAL/PowerRTF/quality/topology.h>
#include <CGAL/PowerRTF/quality/triangle_quality.h>

#include <CGAL/tags.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using shapes::Soup;

namespace {

/// The flat ring 1 <= |p| <= 2 in z = 0.
Soup annulus(int n)
{
  Soup s;
  for (int i = 0; i < n; ++i) {
    const double u = 2 * shapes::pi * i / n;
    s.points.push_back({std::cos(u), std::sin(u), 0});
    s.points.push_back({2 * std::cos(u), 2 * std::sin(u), 0});
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    shapes::add_quad(s, 2 * i, 2 * i + 1, 2 * j + 1, 2 * j);
  }
  return s;
}

Soup without_last(Soup s)
{
  s.triangles.pop_back();
  return s;
}

} // namespace

TEST_CASE("triangle quality: equilateral triangles are perfect")
{
  for (const Soup& s : {shapes::tetrahedron(), shapes::octahedron(), shapes::icosahedron(),
                        shapes::scaled(shapes::icosahedron(), 1e-6)}) {
    const Quality_statistics q = triangle_quality(s.points, s.triangles);
    CHECK(q.q_min == Approx(1));
    CHECK(q.q_avg == Approx(1));
    CHECK(q.theta_min == Approx(60));
    CHECK(q.theta_min_avg == Approx(60));
    CHECK(q.theta_max == Approx(60));
    CHECK(q.below_30 == 0);
    CHECK(q.above_90 == 0);
  }
}

TEST_CASE("triangle quality: known angles")
{
  // 3-4-5: Q = 6/sqrt(3) * 6 / (6 * 5)
  Soup s = Soup{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{{0, 1, 2}}}};
  Quality_statistics q = triangle_quality(s.points, s.triangles);
  CHECK(q.q_min == Approx(6 / std::sqrt(3.) / 5));
  CHECK(q.theta_min == Approx(std::atan2(3, 4) * 180 / shapes::pi));
  CHECK(q.theta_max == Approx(90));
  CHECK(q.above_90 == 0);
  CHECK(q.below_30 == 0);

  // with a facet of 20, 20, 140 degrees and one of 60, 60, 60: means over the three
  const double u = 20 * shapes::pi / 180;
  s.points.insert(s.points.end(),
                  {{1, 0, 0}, {2, 0, 0}, {1.5, 0.5 * std::tan(u), 0}, {1.5, std::sqrt(3.) / 2, 0}});
  s.triangles.insert(s.triangles.end(), {{{3, 4, 5}}, {{3, 4, 6}}});
  q = triangle_quality(s.points, s.triangles);
  CHECK(q.theta_min == Approx(20));
  CHECK(q.theta_max == Approx(140));
  CHECK(q.theta_min_avg == Approx((20 + 60 + std::atan2(3, 4) * 180 / shapes::pi) / 3));
  CHECK(q.below_30 == Approx(1. / 3));
  CHECK(q.above_90 == Approx(1. / 3));
  CHECK(q.q_min < 0.4);
}

TEST_CASE("angles that are asked for are guarantees: met up to the bound, missed beyond it")
{
  Remeshing_report report;
  report.quality.theta_min = 40;
  report.quality.theta_max = 85;
  const auto missed = [&](double min_angle, double max_angle) {
    report.min_angle = min_angle;
    report.max_angle = max_angle;
    return report.missed_guarantees();
  };
  using Words = std::vector<std::string>;
  CHECK(missed(0, 180).empty());
  CHECK(missed(40, 85).empty());
  CHECK(missed(40.5, 85) == Words{"smallest angle: 40 instead of 40.5"});
  CHECK(missed(40, 84.5) == Words{"largest angle: 85 instead of 84.5"});
  CHECK(missed(45, 80).size() == 2);
}

TEST_CASE("triangle quality: angles are found only where they count, the numbers are those of all")
{
  std::mt19937 random(5);
  const auto unit = [&] { return random() / 4294967296.; };
  for (const double height : {1., 1e-3, 1e-9, 0.}) { // up to needles and flat ones
    Soup s = shapes::icosphere(1);
    for (Vec3d& p : s.points) p.z *= height;
    for (int k = 0; k < 3000; ++k) {
      const int first = int(s.points.size());
      for (int c = 0; c < 3; ++c) s.points.push_back({unit(), height * unit(), height * unit()});
      s.points.back() += s.points[first] * double(k % 2);
      s.triangles.push_back({first, first + 1, first + 2});
    }
    const double degrees = 45 / std::atan(1.0);
    double least = 60, most = 60, sum = 0, below = 0, above = 0, part = 0;
    for (std::size_t f = 0; f < s.triangles.size(); ++f) {
      double smallest = 180, largest = 0;
      for (int k = 0; k < 3; ++k) {
        const Vec3d &a = s.points[s.triangles[f][0]], &b = s.points[s.triangles[f][1]],
                    &c = s.points[s.triangles[f][2]];
        const Vec3d e[3] = {c - b, a - c, b - a};
        const double angle =
            std::atan2(length(cross(e[0], e[1])), -dot(e[(k + 1) % 3], e[(k + 2) % 3])) * degrees;
        smallest = std::min(smallest, angle);
        largest = std::max(largest, angle);
        if (!(length(cross(e[0], e[1])) > 0)) smallest = 0, largest = 180;
      }
      least = std::min(least, smallest);
      most = std::max(most, largest);
      part += smallest;
      below += smallest < 30;
      above += largest > 90 && smallest > 0;
      if (f % 1024 < 1023 && f + 1 < s.triangles.size()) continue; // the chunks of a reduction
      sum += part;
      part = 0;
    }
    const auto n = double(s.triangles.size());
    const Quality_statistics q = triangle_quality(s.points, s.triangles);
    CHECK(q.theta_min == least);
    CHECK(q.theta_max == most);
    CHECK(q.theta_min_avg == sum / n);
    CHECK(q.below_30 == below / n);
    CHECK(q.above_90 == above / n);
  }
}

TEST_CASE("triangle quality: no triangle, no area")
{
  CHECK(triangle_quality({}, {}).q_avg == 0);
  CHECK(triangle_quality({}, {}).theta_max == 0);
  const Soup s =
      Soup{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}, {{0, 0, 0}}, {{0, 1, 3}}}};
  const Quality_statistics q = triangle_quality(s.points, s.triangles);
  CHECK(q.q_min == 0);
  CHECK(q.theta_min == 0);
  CHECK(q.theta_min_avg == Approx(15));
  CHECK(q.theta_max == 180);
  CHECK(q.above_90 == 0);
  CHECK(q.below_30 == Approx(2. / 3));
}

TEST_CASE("edge lengths: every edge once")
{
  // a square of side 1 and its diagonal, which is an edge of both triangles
  const Soup square = shapes::plane_patch(1, 1);
  const Edge_length_statistics s = edge_lengths(square.points, square.triangles);
  CHECK(s.mean == Approx((4 + std::sqrt(2.)) / 5));
  CHECK(s.min == Approx(1));
  CHECK(s.max == Approx(std::sqrt(2.)));

  // whichever way round their facets are
  const Soup octahedron = shapes::octahedron();
  for (unsigned seed = 0; seed < 3; ++seed) {
    Soup turned = shapes::permuted(octahedron, seed);
    std::swap(turned.triangles[seed][0], turned.triangles[seed][1]);
    const Edge_length_statistics o = edge_lengths(turned.points, turned.triangles);
    CHECK(o.mean == Approx(std::sqrt(2.)));
    CHECK(o.min == Approx(std::sqrt(2.)));
    CHECK(o.max == Approx(std::sqrt(2.)));
  }
  const Soup sphere = shapes::ellipsoid(1, 0.7, 0.4, 3); // closed: each edge from one of its facets
  const Edge_length_statistics any = edge_lengths(sphere.points, sphere.triangles),
                               closed = edge_lengths(sphere.points, sphere.triangles,
                                                     CGAL::Sequential_tag(), true);
  CHECK(closed.mean == Approx(any.mean));
  CHECK(closed.median == any.median);
  CHECK(closed.min == any.min);
  CHECK(closed.max == any.max);
  CHECK(edge_lengths({}, {}).mean == 0);
  CHECK(edge_lengths({}, {}).min == 0);
}

TEST_CASE("topology: closed surfaces")
{
  struct Case {
    Soup soup;
    long euler;
    std::size_t components;
  };
  for (const Case& c : {Case{shapes::tetrahedron(), 2, 1}, Case{shapes::icosphere(3), 2, 1},
                        Case{shapes::torus(30, 12, 3, 1), 0, 1}, Case{shapes::box(4), 2, 1},
                        Case{shapes::two_spheres(2), 4, 2}}) {
    for (unsigned seed = 0; seed < 3; ++seed) {
      const Topology_statistics t = topology(shapes::permuted(c.soup, seed).triangles);
      CHECK(t.vertices == c.soup.points.size());
      CHECK(t.faces == c.soup.triangles.size());
      CHECK(t.edges == 3 * t.faces / 2);
      CHECK(t.euler_characteristic == c.euler);
      CHECK(t.components == c.components);
      CHECK(t.border_edges == 0);
      CHECK(t.border_loops == 0);
      CHECK(t.non_manifold_edges == 0);
      CHECK(t.non_manifold_vertices == 0);
      CHECK(t.oriented);
    }
  }
}

TEST_CASE("topology: borders")
{
  const Topology_statistics ring = topology(annulus(17).triangles);
  CHECK(ring.euler_characteristic == 0);
  CHECK(ring.border_edges == 34);
  CHECK(ring.border_loops == 2);
  CHECK(ring.non_manifold_vertices == 0);

  const Topology_statistics patch =
      topology(shapes::permuted(shapes::plane_patch(5, 3), 1).triangles);
  CHECK(patch.euler_characteristic == 1);
  CHECK(patch.border_edges == 16);
  CHECK(patch.border_loops == 1);

  const Topology_statistics tube = topology(shapes::open_cylinder(9, 4, 1, 2).triangles);
  CHECK(tube.border_loops == 2);
  CHECK(tube.border_edges == 18);

  const Topology_statistics one = topology({{{0, 1, 2}}});
  CHECK(one.border_edges == 3);
  CHECK(one.border_loops == 1);
  CHECK(one.non_manifold_vertices == 0);
  CHECK(topology({}).faces == 0);
  CHECK(topology({}).components == 0);
}

TEST_CASE("topology: that of an oriented manifold is what is counted of any triangles")
{
  using namespace shapes;
  const auto vertices = [](const Soup& s) { return int(s.points.size()); };
  const Soup with_gaps = [] { // unused vertices
    Soup s = permuted(joined(torus(20, 9, 1, .4), plane_patch(3, 4)), 2);
    for (Triangle& t : s.triangles)
      for (int& v : t) v *= 2;
    s.points.resize(2 * s.points.size());
    return s;
  }();
  for (const Soup& s :
       {icosphere(3), annulus(17), permuted(open_cylinder(9, 4, 1, 2), 1), two_spheres(2),
        with_gaps, without_last(box(3)), without_last(torus(5, 4, 1, .3)),
        Soup{{{}, {}, {}}, {{0, 1, 2}}}, Soup{{{}, {}, {}}, {{0, 1, 2}, {2, 1, 0}}}}) {
    const Topology_statistics expected =
        internal::soup_topology(s.triangles, vertices(s), CGAL::Sequential_tag());
    const auto t =
        internal::oriented_topology(s.triangles, vertices(s), CGAL::Parallel_if_available_tag());
    REQUIRE(t);
    CHECK(t->vertices == expected.vertices);
    CHECK(t->edges == expected.edges);
    CHECK(t->faces == expected.faces);
    CHECK(t->components == expected.components);
    CHECK(t->border_edges == expected.border_edges);
    CHECK(t->border_loops == expected.border_loops);
    CHECK(t->euler_characteristic == expected.euler_characteristic);
    CHECK(expected.non_manifold_edges + expected.non_manifold_vertices == 0);
    CHECK(expected.oriented);
  }
  using Triangles = std::vector<Triangle>;
  for (const Triangles& defective :
       {Triangles{{0, 1, 2}, {0, 3, 4}}, Triangles{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}},
        Triangles{{0, 1, 2}, {0, 1, 3}}, Triangles{{0, 1, 2}, {0, 1, 2}}, Triangles{{0, 1, 1}},
        Triangles{{0, 1, 2}, {2, 3, 2}}, permuted(moebius_strip(20), 1).triangles,
        Triangles{{0, 1, 2}, {0, 2, 1}, {0, 3, 4}, {0, 4, 3}}})
    CHECK_FALSE(internal::oriented_topology(defective, 100, CGAL::Sequential_tag()));
  Triangles fan; // at a vertex of many facets
  for (int k = 1; k < 200; ++k) fan.push_back({0, k, k + 1});
  CHECK_FALSE(internal::oriented_topology(fan, 201, CGAL::Sequential_tag()));
  CHECK(topology(fan).border_edges == 201);
  CHECK(topology(fan).border_loops == 1);
}

TEST_CASE("the topology of a surface is that of its triangles")
{
  using namespace shapes;
  const auto far = [](const Soup& soup) { return translated(soup, {9, 0, 0}); };
  for (const Soup& soup :
       {icosphere(2), torus(12, 8, 1, .4), open_cylinder(9, 4, .5, 2), plane_patch(5, 3),
        moebius_strip(20), joined(open_cylinder(9, 4, .5, 2), far(torus(12, 8, 1, .4)))}) {
    const Surface surface = make_surface(permuted(soup, 1));
    const Topology_statistics t =
        internal::manifold_topology(surface, CGAL::Parallel_if_available_tag());
    const Topology_statistics expected = topology(surface.triangles);
    CHECK(t.vertices == expected.vertices);
    CHECK(t.edges == expected.edges);
    CHECK(t.faces == expected.faces);
    CHECK(t.components == expected.components);
    CHECK(t.border_edges == expected.border_edges);
    CHECK(t.border_loops == expected.border_loops);
    CHECK(t.non_manifold_edges == 0);
    CHECK(t.non_manifold_vertices == 0);
    CHECK(t.euler_characteristic == expected.euler_characteristic);
    CHECK(t.oriented == expected.oriented);
  }
}

TEST_CASE("the same numbers in all threads")
{
  std::mt19937 random(3);
  std::vector<std::vector<Triangle>> soups{
      {}, shapes::permuted(shapes::torus(60, 40, 3, 1), 1).triangles, annulus(999).triangles};
  for (const int vertices : {5, 60, 3000}) { // with all sorts of defects
    std::vector<Triangle> soup;
    while (soup.size() < 4000) {
      Triangle t;
      for (int& v : t) v = int(random() % vertices);
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) soup.push_back(t);
    }
    soups.push_back(soup);
  }
  const CGAL::Parallel_if_available_tag at_once;
  for (const std::vector<Triangle>& triangles : soups) {
    const Topology_statistics s = topology(triangles), p = topology(triangles, at_once);
    CHECK(p.vertices == s.vertices);
    CHECK(p.edges == s.edges);
    CHECK(p.faces == s.faces);
    CHECK(p.components == s.components);
    CHECK(p.border_edges == s.border_edges);
    CHECK(p.border_loops == s.border_loops);
    CHECK(p.non_manifold_edges == s.non_manifold_edges);
    CHECK(p.non_manifold_vertices == s.non_manifold_vertices);
    CHECK(p.euler_characteristic == s.euler_characteristic);
    CHECK(p.oriented == s.oriented);
    const Facet_adjacency a = facet_adjacency(triangles, 4000),
                          b = facet_adjacency(triangles, 4000, at_once);
    CHECK(a.opposite == b.opposite);
    CHECK(a.border_edges == b.border_edges);
    CHECK(a.non_manifold_edges == b.non_manifold_edges);
    CHECK(a.same_direction == b.same_direction);
    CHECK(a.repeated_facets == b.repeated_facets);
    if (!a.same_direction)
      CHECK(count_non_manifold_vertices(triangles, a, 4000) ==
            count_non_manifold_vertices(triangles, b, 4000, at_once));
  }

  const Soup soup = shapes::permuted(shapes::ellipsoid(1, 0.7, 0.4, 4), 2);
  const Quality_statistics q = triangle_quality(soup.points, soup.triangles),
                           r = triangle_quality(soup.points, soup.triangles, at_once);
  CHECK(r.q_avg == q.q_avg);
  CHECK(r.q_min == q.q_min);
  CHECK(r.theta_min_avg == q.theta_min_avg);
  CHECK(r.below_30 == q.below_30);
  const Edge_length_statistics l = edge_lengths(soup.points, soup.triangles),
                               k = edge_lengths(soup.points, soup.triangles, at_once);
  CHECK(k.mean == l.mean);
  CHECK(k.min == l.min);
  CHECK(k.max == l.max);
}

TEST_CASE("topology: defects")
{
  SUBCASE("a bow-tie: two facets at a vertex")
  {
    const Topology_statistics t = topology({{{0, 1, 2}}, {{0, 3, 4}}});
    CHECK(t.non_manifold_vertices == 1);
    CHECK(t.non_manifold_edges == 0);
    CHECK(t.components == 1);
    CHECK(t.border_loops == 2);
    CHECK(t.oriented);
  }
  SUBCASE("two closed surfaces at a vertex")
  {
    Soup s = shapes::joined(shapes::tetrahedron(), shapes::tetrahedron());
    for (Triangle& t : s.triangles)
      for (int& v : t)
        if (v == 4) v = 0;
    const Topology_statistics t = topology(s.triangles);
    CHECK(t.vertices == 7);
    CHECK(t.non_manifold_vertices == 1);
    CHECK(t.border_edges == 0);
    CHECK(t.euler_characteristic == 3);
  }
  SUBCASE("three facets on an edge")
  {
    const Topology_statistics t = topology({{{0, 1, 2}}, {{1, 0, 3}}, {{0, 1, 4}}});
    CHECK(t.non_manifold_edges == 1);
    CHECK(t.non_manifold_vertices == 2);
    CHECK(t.edges == 7);
    CHECK(t.border_edges == 6);
    CHECK_FALSE(t.oriented);
  }
  SUBCASE("an edge traversed twice in the same direction")
  {
    const Topology_statistics t = topology({{{0, 1, 2}}, {{0, 1, 3}}});
    CHECK(t.non_manifold_edges == 0);
    CHECK(t.non_manifold_vertices == 0);
    CHECK(t.border_loops == 1);
    CHECK_FALSE(t.oriented);
    Soup s = shapes::icosphere(1);
    std::swap(s.triangles[7][0], s.triangles[7][1]);
    CHECK_FALSE(topology(s.triangles).oriented);
    CHECK(topology(s.triangles).non_manifold_vertices == 0);
  }
  SUBCASE("unused vertices and facets with a repeated vertex do not count")
  {
    const Topology_statistics t = topology({{{2, 5, 9}}, {{5, 5, 7}}});
    CHECK(t.vertices == 3);
    CHECK(t.edges == 3);
    CHECK(t.faces == 2);
  }
}

TEST_CASE("assess: a surface against itself has no distance, and its own topology")
{
  const Surface surface = shapes::make_surface(shapes::torus(40, 20, 3, 1));
  Remeshing_report report;
  report.samples_asked = surface.points.size();
  assess(surface, {surface.points, surface.triangles, {}}, report);
  CHECK(report.distance.max < 1e-6);
  CHECK(report.topology.euler_characteristic == 0);
  CHECK(report.diagonal == Approx(std::sqrt(8. * 8 + 8 * 8 + 2 * 2))); // in the torus's own unit
  // the shortest edges are chords of 1/20 of the tube
  CHECK(report.edge_length.min == Approx(2 * std::sin(shapes::pi / 20)));
  CHECK(report.missed_guarantees().empty());

  const Soup open = without_last({surface.points, surface.triangles});
  assess(surface, {open.points, open.triangles, {}}, report);
  CHECK(report.missed_guarantees().size() == 2); // Euler characteristic, borders
}
