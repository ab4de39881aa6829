// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The metrics against closed forms, brute force and CGAL.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include "shapes.h"

#include <CGAL/PowerRTF/optimization/capacity_statistics.h>
#include <CGAL/PowerRTF/quality/assess.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <doctest/doctest.h>

#include <iterator>
#include <limits>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using shapes::Soup;

namespace
{

Soup soup(std::vector<Vec3d> points, std::vector<Triangle> triangles)
{
  return {std::move(points), std::move(triangles)};
}

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

Soup random_triangles(int n, unsigned seed)
{
  std::mt19937 random(seed);
  const auto unit = [&random] { return random() / 4294967296.; };
  Soup s;
  for (int f = 0; f < n; ++f) {
    const Vec3d c{unit(), unit(), unit()};
    for (int k = 0; k < 3; ++k) s.points.push_back(c + 0.3 * Vec3d{unit(), unit(), unit()});
    s.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return s;
}

std::size_t cgal_self_intersections(const Soup& s)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  std::vector<Kernel::Point_3> points;
  for (const Vec3d& p : s.points) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::vector<std::size_t>> polygons;
  for (const Triangle& t : s.triangles) polygons.emplace_back(t.begin(), t.end());
  Mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}

std::size_t self_intersections(const Soup& s)
{
  return CGAL::PowerRTF::self_intersections(s.points, s.triangles);
}

Distance_statistics distance(const Soup& a, const Soup& b)
{
  return surface_distance(a.points, a.triangles, b.points, b.triangles);
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
  Soup s = soup({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{{0, 1, 2}}});
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

TEST_CASE("triangle quality: no triangle, no area")
{
  CHECK(triangle_quality({}, {}).q_avg == 0);
  CHECK(triangle_quality({}, {}).theta_max == 0);
  const Soup s =
      soup({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}, {{0, 0, 0}}, {{0, 1, 3}}});
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

TEST_CASE("self-intersections: pairs")
{
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  const auto pair = [&](std::vector<Vec3d> more, Triangle t) {
    std::vector<Vec3d> points{a, b, c};
    points.insert(points.end(), more.begin(), more.end());
    return self_intersections(soup(points, {{{0, 1, 2}}, t}));
  };
  // no shared vertex: through, beside, parallel, coplanar and overlapping, touching
  CHECK(pair({{.2, .2, -1}, {.3, .2, 1}, {.2, .3, 1}}, {3, 4, 5}) == 1);
  CHECK(pair({{.8, .8, -1}, {.9, .8, 1}, {.8, .9, 1}}, {3, 4, 5}) == 0);
  CHECK(pair({{0, 0, .1}, {1, 0, .1}, {0, 1, .1}}, {3, 4, 5}) == 0);
  CHECK(pair({{.1, .1, 0}, {2, .1, 0}, {.1, 2, 0}}, {3, 4, 5}) == 1);
  CHECK(pair({{.2, .2, 0}, {.3, .2, 1}, {.2, .3, 1}}, {3, 4, 5}) == 1);
  // a shared vertex: apart, through, overlapping
  CHECK(pair({{-1, 0, 1}, {0, -1, 1}}, {0, 3, 4}) == 0);
  CHECK(pair({{1, 1, 1}, {1, 1, -1}}, {0, 3, 4}) == 1);
  CHECK(pair({{.2, .1, 0}, {.1, .2, 0}}, {0, 3, 4}) == 1);
  // a shared edge: a fold, folded flat onto each other, flat side by side; the edge in both orders
  for (const Triangle& t : {Triangle{1, 0, 3}, Triangle{0, 1, 3}, Triangle{3, 1, 0}}) {
    CHECK(pair({{0, 1, .1}}, t) == 0);
    CHECK(pair({{0, .5, 0}}, t) == 1);
    CHECK(pair({{0, -1, 0}}, t) == 0);
  }
  CHECK(pair({}, {0, 2, 1}) == 1);          // the same facet, turned over
  CHECK(pair({{2, 0, 0}}, {0, 1, 3}) == 1); // no area: a pair with itself
}

TEST_CASE("self-intersections: what floating point proves is what exact predicates say")
{
  using internal::Epick;
  using Points = std::array<Epick::Point_3, 3>;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> digit(0, 3);
  const auto triangle = [](const Points& p) { return Epick::Triangle_3(p[0], p[1], p[2]); };
  std::size_t parted = 0, apart = 0;
  // On a small lattice all the special cases are frequent; drawn out, all triangles are slivers.
  for (const double length : {1., 1e8, 0x1p-40})
    for (int i = 0; i < 20000; ++i) {
      const bool share = i % 2 == 0;
      const auto point = [&] {
        const int x = digit(random), y = digit(random), z = digit(random);
        return Epick::Point_3(length * x + 0.1, y + 0.1 * x, z / 3.);
      };
      Points p{point(), point(), point()}, q{point(), point(), point()};
      if (share) q[1] = p[2];
      if (CGAL::collinear(p[0], p[1], p[2]) || CGAL::collinear(q[0], q[1], q[2])) continue;
      const bool expected =
          share ? CGAL::do_intersect(triangle(p), Epick::Segment_3(q[2], q[0])) ||
                      CGAL::do_intersect(triangle(q), Epick::Segment_3(p[0], p[1]))
                : CGAL::do_intersect(triangle(p), triangle(q));
      const bool is_parted =
          share ? internal::Parting_plane(p, q, 2, 1).exists() : internal::Parting_plane(p, q).exists();
      if (is_parted) CHECK_FALSE(expected);
      parted += is_parted;
      apart += !expected;
      const std::array<int, 3> s{0, 1, 2}, t{3, share ? 2 : 4, 5};
      CHECK(internal::triangles_intersect(s, p, t, q) == expected);
    }
  CHECK(parted > apart / 2); // it is worth its while
}

TEST_CASE("self-intersections: CGAL's own count")
{
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Soup s = random_triangles(60, seed);
    const std::size_t count = self_intersections(s);
    CHECK(count > 0);
    CHECK(count == cgal_self_intersections(s));
    CHECK(count == self_intersections(shapes::permuted(s, seed)));
  }
  CHECK(self_intersections(shapes::torus(40, 20, 3, 1)) == 0);
  const Soup spheres = shapes::two_spheres(2, 1.3);
  CHECK(self_intersections(spheres) > 0);
  CHECK(self_intersections(spheres) == cgal_self_intersections(spheres));
  CHECK(self_intersections(Soup()) == 0);
}

TEST_CASE("distance: parallel squares")
{
  const Soup square = shapes::plane_patch(7, 7);
  for (const double d : {0., 1e-3, 0.25}) {
    const Distance_statistics s =
        distance(square, shapes::translated(shapes::plane_patch(3, 5), {0, 0, d}));
    const double percent = 100 * d / std::sqrt(2.);
    CHECK(s.mean == Approx(percent));
    CHECK(s.rms == Approx(percent));
    CHECK(s.max == Approx(percent));
  }
}

TEST_CASE("distance: the worse direction counts")
{
  // the unit square, and its half x <= 1/2: mean over the square 1/8, RMS sqrt(1/24), maximum 1/2
  const Soup square = shapes::plane_patch(8, 8);
  Soup half = shapes::plane_patch(8, 8);
  for (Vec3d& p : half.points) p.x /= 2;
  for (const bool turned : {false, true}) {
    const Distance_statistics s = turned ? distance(half, square) : distance(square, half);
    const double percent = 100 / (turned ? std::sqrt(1.25) : std::sqrt(2.));
    CHECK(s.mean == Approx(percent / 8).epsilon(0.01));
    CHECK(s.rms == Approx(percent * std::sqrt(1. / 24)).epsilon(0.01));
    CHECK(s.max == Approx(percent / 2));
  }
}

TEST_CASE("distance: a vertex counts for the maximum, however small its facets")
{
  Soup spike = shapes::plane_patch(10, 10);
  const int tip = static_cast<int>(spike.points.size());
  spike.points.push_back({0.5, 0.5, 0.2});
  spike.points.push_back({0.5 + 1e-9, 0.5, 0});
  spike.points.push_back({0.5, 0.5 + 1e-9, 0});
  spike.triangles.push_back({tip, tip + 1, tip + 2});
  const Distance_statistics s = distance(shapes::plane_patch(10, 10), spike);
  CHECK(s.max == Approx(100 * 0.2 / std::sqrt(2.)));
  CHECK(s.mean < 1e-3);
}

TEST_CASE("distance: spheres, and invariance")
{
  const Soup fine = shapes::icosphere(5);
  Soup larger = shapes::icosphere(5);
  for (Vec3d& p : larger.points) p = 1.1 * p;
  const Distance_statistics s = distance(fine, larger);
  const double percent = 100 / (2 * std::sqrt(3.));
  CHECK(s.mean == Approx(0.1 * percent).epsilon(0.01));
  CHECK(s.max == Approx(0.1 * percent).epsilon(0.02));
  CHECK(s.rms >= s.mean);

  const auto moved = [](const Soup& t) {
    return shapes::translated(shapes::rotated(shapes::scaled(t, 1000), 0.7), {5000, -3000, 800});
  };
  const auto coarse = shapes::icosphere(3);
  const Distance_statistics before = distance(fine, coarse),
                            after = distance(moved(fine), moved(coarse));
  const auto diagonal = [](const Soup& t) {
    const Box3<double> box = internal::bounding_box(t.points, t.triangles);
    return length(box.hi - box.lo);
  };
  const double change = 1000 * diagonal(fine) / diagonal(moved(fine)); // the box turns too
  CHECK(after.mean == Approx(before.mean * change).epsilon(0.02));
  CHECK(after.rms == Approx(before.rms * change).epsilon(0.02));

  const Distance_statistics parallel = surface_distance<CGAL::Parallel_if_available_tag>(
      fine.points, fine.triangles, coarse.points, coarse.triangles);
  CHECK(parallel.mean == before.mean);
  CHECK(parallel.rms == before.rms);
  CHECK(parallel.max == before.max);
  CHECK(distance(fine, Soup()).max == 0);
  CHECK(distance(Soup(), fine).max == 0);
}

TEST_CASE("capacity: statistics against the mean")
{
  const auto of = [](const std::vector<double>& masses, double gamma,
                     const std::vector<char>& is_left_out = {}) {
    return capacity_statistics<CGAL::Sequential_tag>(
        static_cast<int>(masses.size()), [&](int i) { return masses[i]; },
        [&](int i) { return !is_left_out.empty() && is_left_out[i]; }, gamma);
  };
  const Capacity_statistics s = of({1, 1, 1.5, 0.5}, 0.1);
  CHECK(s.inside_interval == Approx(0.5));
  CHECK(s.rms == Approx(std::sqrt(0.125)));
  CHECK(s.largest_deviation == Approx(0.5));
  CHECK(of({2, 2, 2}, 0).inside_interval == 1);
  CHECK(of({2, 2, 2}, 0).rms == 0);
  CHECK(of({0, 2}, 0.04).largest_deviation == Approx(1));
  CHECK(of({}, 0.04).inside_interval == 0);
  CHECK(of({0, 0}, 0.04).rms == 0);

  const Capacity_statistics most = of({1, 9, 1.2, 0, 0.8}, 0.1, {0, 1, 0, 1, 0});
  CHECK(most.left_out == 2);
  CHECK(most.mean == Approx(1));
  CHECK(most.least == 0.8);
  CHECK(most.inside_interval == Approx(1. / 3));
  CHECK(most.rms == Approx(std::sqrt(0.08 / 3)));
  CHECK(most.largest_deviation == Approx(0.2));
  CHECK(of({1, 2}, 0.1, {1, 1}).left_out == 2);
  CHECK(of({1, 2}, 0.1, {1, 1}).inside_interval == 0);
}

TEST_CASE("assess: a surface against itself has no distance, and its own topology")
{
  const Surface surface = shapes::make_surface(shapes::torus(40, 20, 3, 1));
  Remeshing_report report;
  report.samples_asked = surface.points.size();
  assess<CGAL::Sequential_tag>(surface, {surface.points, surface.triangles, {}}, report);
  CHECK(report.distance.max < 1e-6);
  CHECK(report.topology.euler_characteristic == 0);
  CHECK(report.diagonal == Approx(std::sqrt(8. * 8 + 8 * 8 + 2 * 2))); // in the torus's own unit
  // the shortest edges are chords of 1/20 of the tube
  CHECK(report.edge_length.min == Approx(2 * std::sin(shapes::pi / 20)));
  CHECK(report.missed_guarantees().empty());

  const Soup open = without_last({surface.points, surface.triangles});
  assess<CGAL::Sequential_tag>(surface, {open.points, open.triangles, {}}, report);
  CHECK(report.missed_guarantees().size() == 2); // Euler characteristic, borders
}
