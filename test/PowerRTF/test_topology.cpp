// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Topology against what is known.
#include "dirty_shapes.h"
#include "shapes.h"
#include "topology_counts.h"

#include <CGAL/PowerRTF/extraction/connect_halfedges.h>
#include <CGAL/PowerRTF/quality/topology.h>

#include <CGAL/tags.h>

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
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
    Triangle_links links;
    const auto t = internal::oriented_topology(s.triangles, vertices(s),
                                               CGAL::Parallel_if_available_tag(), &links);
    REQUIRE(t);
    const Triangle_links known =
        internal::triangle_links(s.triangles, vertices(s), CGAL::Sequential_tag());
    CHECK(links.opposite == known.opposite);
    CHECK(links.last_corner == known.last_corner);
    check_counts(*t, expected);
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
    check_counts(t, expected);
    CHECK(t.non_manifold_edges == 0);
    CHECK(t.non_manifold_vertices == 0);
  }
}

TEST_CASE("topology: the same in all threads")
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
    check_counts(topology(triangles, at_once), topology(triangles));
    const Facet_adjacency a = facet_adjacency(triangles, 4000),
                          b = facet_adjacency(triangles, 4000, at_once);
    CHECK(a.opposite == b.opposite);
    CHECK(a.border_edges == b.border_edges);
    CHECK(a.non_manifold_edges == b.non_manifold_edges);
    CHECK(a.same_direction == b.same_direction);
    CHECK(a.repeated_facets == b.repeated_facets);
    if (!a.same_direction)
      CHECK(count_non_manifold_vertices(a) == count_non_manifold_vertices(b, at_once));
  }
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
