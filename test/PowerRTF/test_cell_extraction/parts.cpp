// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of the extraction from cells: fans, topologies, ways along the surface.
#include "../hard_shapes.h"

#include <CGAL/PowerRTF/extraction/Fan.h>
#include <CGAL/PowerRTF/extraction/Surface_piece.h>
#include <CGAL/PowerRTF/extraction/fan_topology.h>
#include <CGAL/PowerRTF/geometry/Surface_walk.h>
#include <CGAL/PowerRTF/sampling/random_source.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using CGAL::Parallel_if_available_tag;
using CGAL::Sequential_tag;

TEST_CASE("a star is put in order exactly if it is one fan")
{
  using internal::Fan;
  using internal::is_closed;
  using internal::sort_around;
  Fan closed{{3, 1}, {1, 2}, {2, 3}};
  CHECK(sort_around(closed));
  CHECK(is_closed(closed));
  Fan open{{2, 3}, {1, 2}, {3, 4}};
  CHECK(sort_around(open));
  CHECK_FALSE(is_closed(open));
  CHECK(open == Fan{{1, 2}, {2, 3}, {3, 4}});
  Fan single{{1, 2}};
  CHECK(sort_around(single));
  for (Fan bad : {Fan{}, Fan{{1, 2}, {3, 4}}, Fan{{1, 2}, {1, 3}}, Fan{{1, 3}, {2, 3}},
                  Fan{{1, 2}, {2, 3}, {3, 1}, {3, 4}}, Fan{{1, 2}, {2, 3}, {3, 2}},
                  Fan{{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}}})
    CHECK_FALSE(sort_around(bad));
}

TEST_CASE("the topology of components is compared one by one")
{
  const auto is_homeomorphic = [](const shapes::Soup& surface, const shapes::Soup& mesh) {
    const Surface s = shapes::make_surface(surface);
    std::vector<int> facets; // the component by the side of x = 1.5
    for (const Vec3d& p : mesh.points) {
      int facet = 0;
      while (facet + 1 < int(s.triangles.size()) &&
             (surface.points[surface.triangles[facet][0]].x > 1.5) != (p.x > 1.5))
        ++facet;
      facets.push_back(facet);
    }
    const auto star = [&](int v) {
      internal::Fan star;
      for (const auto& [a, b, c] : mesh.triangles) {
        if (v == a) star.push_back({b, c});
        if (v == b) star.push_back({c, a});
        if (v == c) star.push_back({a, b});
      }
      CHECK(internal::sort_around(star));
      return star;
    };
    return internal::are_homeomorphic(
        *internal::known_topology(s, Parallel_if_available_tag()),
        internal::fan_topology(int(mesh.points.size()), star, Sequential_tag()), facets,
        Parallel_if_available_tag());
  };
  using namespace shapes;
  const Soup ball = icosphere(1), ring = torus(12, 8, 1, .4), tube = open_cylinder(8, 4, .5, 2);
  const auto far = [](const Soup& soup) { return translated(soup, {4, 0, 0}); };
  CHECK(is_homeomorphic(ball, octahedron()));
  CHECK(is_homeomorphic(ring, torus(5, 4, 1, .4)));
  CHECK(is_homeomorphic(joined(ball, far(ring)), joined(octahedron(), far(ring))));
  CHECK(is_homeomorphic(tube, open_cylinder(5, 2, .5, 2)));
  CHECK_FALSE(is_homeomorphic(ball, ring));
  CHECK_FALSE(is_homeomorphic(tube, ring)); // the same Euler characteristic
  CHECK_FALSE(is_homeomorphic(tube, ball));
  CHECK_FALSE(is_homeomorphic(joined(ball, far(ring)), joined(ring, far(ball))));
  CHECK_FALSE(is_homeomorphic(joined(ball, far(ball)), ball));
  CHECK_FALSE(is_homeomorphic(joined(ball, far(ball)), joined(ball, translated(ball, {0, 3, 0}))));
}

TEST_CASE("a walk along the surface comes to the points straight ahead, and to no other sheet")
{
  const Surface sheets = shapes::make_surface(shapes::accordion(10, .02));
  Random_source random(5);
  const auto pick = [&] {
    return std::min(int(sheets.triangles.size()) - 1,
                    int(random() * double(sheets.triangles.size())));
  };
  const auto point = [&](int f) {
    const Triangle& t = sheets.triangles[f];
    const double u = .1 + .2 * random(), v = .1 + .2 * random();
    return u * sheets.points[t[0]] + v * sheets.points[t[1]] + (1 - u - v) * sheets.points[t[2]];
  };
  for (int k = 0; k < 1000; ++k) {
    const int f = pick(), o = sheets.adjacency.opposite[3 * f + k % 3], far = pick();
    const int g = o == Facet_adjacency::none ? f : o / 3;
    const auto leads = [&](int from, int to) {
      return internal::Surface_walk(sheets, point(from), point(to),
                                    sheets.facet_normals[from] + sheets.facet_normals[to])
          .leads_to(from, [&](int facet) { return facet == to; });
    };
    CHECK(leads(f, f));
    // A point beside that of a facet on the same plane is seen, one on another sheet is not.
    const double cosine = dot(sheets.facet_normals[f], sheets.facet_normals[g]);
    if (cosine > .9999) {
      const Vec3d a = point(f), b = point(g);
      const internal::Surface_walk walk(sheets, a, b, sheets.facet_normals[f]);
      const bool arrives = walk.leads_to(f, [&](int facet) { return facet == g; });
      const int h = 3 * f + k % 3; // whether the straight way passes the edge between them
      const Vec3d p = sheets.points[halfedge_source(sheets.triangles, h)],
                  q = sheets.points[halfedge_target(sheets.triangles, h)];
      const Vec3d n = sheets.facet_normals[f];
      const bool passes = dot(cross(b - a, p - a), n) * dot(cross(b - a, q - a), n) < 0;
      if (passes) CHECK(arrives);
    }
    const double height = dot(point(far) - point(f), sheets.facet_normals[f]);
    if (dot(sheets.facet_normals[far], sheets.facet_normals[f]) > .9999 &&
        std::abs(height) > 1e-6 && squared_length(point(far) - point(f)) < 4 * height * height)
      CHECK_FALSE(leads(f, far));
  }
}

TEST_CASE("a way around a tip ends")
{
  const Surface s = shapes::make_surface(shapes::octahedron());
  for (int f = 0; f < int(s.triangles.size()); ++f)
    for (const int v : s.triangles[f]) {
      const Vec3d tip = s.points[v], n = s.vertex_normals[v];
      const Vec3d way = cross(n, std::fabs(n.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0});
      const internal::Surface_walk walk(s, tip, tip + way, cross(n, way)); // below its plane: all
      int facets = 0;
      CHECK_FALSE(walk.leads_to(f, [&](int) { return ++facets > 100; }));
      CHECK(facets == 5); // those at the tip, the first one at both ends of the way
    }
}

TEST_CASE("the facets near a point hang together")
{
  const Surface disc = shapes::make_surface(shapes::thin_disc(.01));
  const Vec3d p = disc.points[0];
  const auto near = internal::facets_near(disc, p, 0, .1 * length(disc.points[0]) + .1);
  CHECK(std::is_sorted(near.begin(), near.end()));
  CHECK(std::binary_search(near.begin(), near.end(), 0));
  CHECK(near.size() < disc.triangles.size());
  CHECK(internal::facets_near(disc, p, 0, 10).size() == disc.triangles.size());
  CHECK(internal::facets_near(disc, p, 0, 0) == std::vector<int>{0});
}
