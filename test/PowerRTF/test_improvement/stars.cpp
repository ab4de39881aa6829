// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of the improvement on single stars: badness, smoothing, flips, dislocations.
#include "../improvement_case.h"
#include "../odd_shapes.h"

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/improvement/Changed_vertices.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/Surface_projector.h>
#include <CGAL/PowerRTF/improvement/Vertex_mover.h>
#include <CGAL/PowerRTF/improvement/annihilate_dislocations.h>
#include <CGAL/PowerRTF/improvement/flat_stars.h>
#include <CGAL/PowerRTF/improvement/flip_edges.h>
#include <CGAL/PowerRTF/improvement/optimize_bad_triangles.h>
#include <CGAL/PowerRTF/quality/surface_distance.h>
#include <CGAL/PowerRTF/sampling/random_source.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

using namespace improvement_case;

namespace {

// One vertex after the other, so many times.
void smooth(internal::Star_mesh& mesh, int steps)
{
  for (int step = 0; step < steps; ++step)
    for (const internal::Star_mesh::Vertex v : mesh.working().mesh.vertices())
      if (mesh.is_movable(v)) smooth_vertex(mesh, v);
}

} // namespace

TEST_CASE("triangle badness")
{
  const Vec3d a{0, 0, 0}, b{1, 0, 0};
  const double degree = std::acos(-1.) / 180;
  using internal::triangle_badness;
  const auto equilateral = triangle_badness(a, b, {0.5, std::sqrt(0.75), 0});
  CHECK(equilateral.badness == 0);
  CHECK(equilateral.inverse_mean_ratio == doctest::Approx(1));
  // isosceles: Q = sqrt(3) height / (half the perimeter * the longest edge)
  for (double apex = 1; apex < 170; apex += 0.5) {
    CAPTURE(apex);
    const double base = 2 * std::sin(apex / 2 * degree);
    const double q =
        2 * std::sqrt(3.) * std::sin(apex * degree) / ((2 + base) * std::max(1., base));
    const double smallest = std::min(apex, 90 - apex / 2), largest = std::max(apex, 90 - apex / 2);
    const double expected = 4 * std::pow(std::max(0., 0.78 - q), 2) +
                            4 * std::pow(std::max(0., 43.1 - smallest) / 60, 2) +
                            8 * std::pow(std::max(0., largest - 83.2) / 60, 2);
    const Vec3d c{std::cos(apex * degree), std::sin(apex * degree), 0};
    CHECK(triangle_badness(a, b, c).badness == doctest::Approx(expected).epsilon(0.05));
  }
  CHECK(triangle_badness(a, b, {0, 1e3, 0}).badness > 1);
  CHECK(std::isinf(triangle_badness(a, b, {2, 0, 0}).badness));
  // the same at any size
  CHECK(triangle_badness(1e-9 * a, 1e-9 * b, {0.2e-9, 0.7e-9, 0}).badness ==
        doctest::Approx(triangle_badness(a, b, {0.2, 0.7, 0}).badness));
}

TEST_CASE("smoothing finds the best place in a star, and leaves it")
{
  const Surface surface = shapes::make_surface(shapes::plane_patch(10, 10));
  const Facet_tree tree(surface.points, surface.triangles);
  const internal::Surface_projector projector(surface, tree);
  const Vec3d m = (1. / 3) * (surface.points[surface.triangles[50][0]] +
                              surface.points[surface.triangles[50][1]] +
                              surface.points[surface.triangles[50][2]]);
  const double unit = 0.1 * std::sqrt(surface.area);
  Extracted_mesh star;
  for (const auto& [x, y] : {std::pair{0.3, 0.2}, std::pair{1., 0.1}, std::pair{0.4, 1.3},
                             std::pair{-0.9, 0.7}, std::pair{-0.8, -0.6}, std::pair{0.5, -1.1}})
    star.points.push_back(m + unit * Vec3d{x, y, 0});
  for (int k = 0; k < 5; ++k) star.triangles.push_back({0, 1 + k, 1 + (k + 1) % 5});
  const auto energy = [&](const Vec3d& p) {
    double sum = 0;
    for (const Triangle& t : star.triangles)
      sum += internal::triangle_badness(p, star.points[t[1]], star.points[t[2]]).inverse_mean_ratio;
    return sum;
  };
  internal::Star_mesh mesh(star, projector);
  smooth(mesh, 10);
  const Vec3d p = mesh.point(internal::Star_mesh::Vertex(0));
  CHECK(energy(p) < energy(star.points[0]));
  for (int k = 0; k < 12; ++k) {
    const double angle = k * std::acos(-1.) / 6;
    CHECK(energy(p) < energy(p + 1e-3 * unit * Vec3d{std::cos(angle), std::sin(angle), 0}));
  }
}

TEST_CASE("a projection descends to the nearest place around")
{
  using internal::Improvement_parameters;
  constexpr double min_cosine = Improvement_parameters::Projection::min_normal_cosine;
  const std::vector<std::pair<std::string, shapes::Soup>> smooth{
      {"sphere", shapes::icosphere(3)},
      {"cylinder", shapes::open_cylinder(40, 10, .5, 2)},
      {"torus", shapes::torus(40, 20, 1, .4)},
      {"Klein bottle", shapes::klein_bottle(60, 30)}}; // with seams, and through itself
  for (const auto& shape : smooth) {
    const std::string& name = shape.first;
    CAPTURE(name);
    const bool is_convex = name == "sphere" || name == "cylinder";
    const Surface surface = shapes::make_surface(shape.second);
    const Facet_tree tree(surface.points, surface.triangles, surface.facet_patches);
    const internal::Surface_projector projector(surface, tree);
    Random_source random(1);
    const auto any_facet = [&] { return int(random() * double(surface.triangles.size())); };
    const double edge = std::sqrt(surface.area / double(surface.triangles.size()));
    for (int k = 0; k < 3000; ++k) {
      const int start = any_facet(); // two facets away, and off the surface
      const Triangle& t = surface.triangles[start];
      const Vec3d n = surface.facet_normals[start];
      const Vec3d beside = surface.points[t[k % 3]] - surface.points[t[(k + 1) % 3]];
      const Vec3d p = surface.points[t[k % 3]] + random() * beside + .4 * edge * random() * n;
      const auto found = projector.project(p, n, start);
      const auto nearest = tree.nearest(p, n, min_cosine, start);
      const double distance = length(found.point - p), least = std::sqrt(nearest.squared_distance);
      CHECK(distance >= (1 - 1e-12) * least);
      if (is_convex) CHECK(distance <= (1 + 1e-12) * least);
      CHECK(distance <=
            length(nearest_point_on_triangle(p, surface.points[t[0]], surface.points[t[1]],
                                             surface.points[t[2]]) -
                   p));
      CHECK(projector.descent().are_on_one_patch(found.facet, start));
      CHECK(dot(surface.facet_normals[found.facet], n) > min_cosine);
    }
    for (int k = 0; k < 100; ++k) { // facet `start` does not agree
      const int start = any_facet();
      const Vec3d p = surface.points[surface.triangles[start][0]],
                  n = -surface.facet_normals[start];
      const auto nearest = tree.nearest(p, n, min_cosine, start);
      const auto found = projector.project(p, n, start);
      CHECK(found.facet == nearest.facet);
      if (found.facet >= 0) CHECK(found.point == nearest.point);
    }
  }
}

TEST_CASE("a point has its place on the facet that carries it, but not on one that is far")
{
  const Surface surface = shapes::make_surface(shapes::torus(40, 20, 2, 1));
  const Facet_tree tree(surface.points, surface.triangles);
  const internal::Surface_projector projector(surface, tree);
  Random_source random(1);
  const int facets = static_cast<int>(surface.triangles.size());
  const double reach = 1e-6;
  for (int k = 0; k < 1000; ++k) {
    const int carrier = static_cast<int>(random() * facets);
    const Triangle& t = surface.triangles[carrier];
    const double r = std::sqrt(random()), u = r * (1 - random()), w = r - u;
    const Vec3d p =
        (1 - u - w) * surface.points[t[0]] + u * surface.points[t[1]] + w * surface.points[t[2]];
    const auto place = projector.on_facet(p, carrier, reach);
    CHECK(place.facet == carrier);
    CHECK(length(place.point - p) < 1e-15);
    const int other = static_cast<int>(random() * facets);
    const auto found = projector.on_facet(p, other, reach);
    CHECK(length(found.point - p) <= reach);
    const Vec3d beside = p + 1e-3 * surface.facet_normals[carrier];
    CHECK(projector.on_facet(beside, carrier, reach).facet == projector.nearest(beside).facet);
  }
}

TEST_CASE("dislocations glide to each other and annihilate")
{
  // a hexagonal lattice on a plane
  constexpr int rows = 24;
  const Surface surface = shapes::make_surface(shapes::plane_patch(10, 10));
  const Facet_tree tree(surface.points, surface.triangles);
  const internal::Surface_projector projector(surface, tree);
  const Box3<double> box = internal::bounding_box(surface.points, surface.triangles);
  const double unit = 0.9 * (box.hi.x - box.lo.x) / (1.5 * rows);
  Extracted_mesh lattice;
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < rows; ++k)
      lattice.points.push_back(
          {box.lo.x + unit * (k + 0.5 * i + 0.5), box.lo.y + unit * (0.866 * i + 0.5), box.lo.z});
  for (int i = 0; i + 1 < rows; ++i)
    for (int k = 0; k + 1 < rows; ++k) {
      const int a = i * rows + k;
      lattice.triangles.push_back({a, a + 1, a + rows});
      lattice.triangles.push_back({a + 1, a + rows + 1, a + rows});
    }
  internal::Star_mesh mesh(lattice, projector);
  const auto& m = mesh.working().mesh;
  using Vertex = internal::Star_mesh::Vertex;
  const auto irregular = [&] {
    int count = 0;
    for (const Vertex v : m.vertices()) count += mesh.is_movable(v) && m.degree(v) != 6;
    return count;
  };
  REQUIRE(irregular() == 0);

  // Flips along a row make two dislocations and move them apart.
  int length = 0;
  SUBCASE("next to each other") { length = 1; }
  SUBCASE("four edges apart") { length = 4; }
  SUBCASE("too far apart") { length = 12; }
  const int first = rows / 2 * rows + 6;
  for (int k = 0; k < length; ++k)
    mesh.flip(m.edge(m.halfedge(Vertex(first + k + 1), Vertex(first + k + rows))));
  smooth(mesh, 50);
  REQUIRE(irregular() == 4);
  const bool are_near = length < 12;
  if (length > 1) { // flips alone do not help
    internal::Shape_flipper(mesh).run();
    CHECK(irregular() == 4);
  }
  internal::Dislocation_annihilator annihilator(mesh);
  smooth(mesh, 1); // what it has found stays
  CHECK(annihilator.run() == (are_near ? 1 : 0));
  CHECK(irregular() == (are_near ? 0 : 4));
}

TEST_CASE(
    "vertices that change at once are no neighbors, and come in the same order in all threads")
{
  const Case c = make_case(shapes::ellipsoid(1, 0.7, 0.4, 3), 3000, 1);
  const Facet_tree tree(c.surface.points, c.surface.triangles);
  const internal::Surface_projector projector(c.surface, tree);
  // By vertex: how many of its neighbors have changed before it, with some flips in between.
  const auto changed_before = [&](internal::Concurrency concurrency) {
    internal::Star_mesh mesh(c.raw, projector, {}, concurrency);
    const auto& m = mesh.working().mesh;
    using Vertex = internal::Star_mesh::Vertex;
    std::vector<std::vector<int>> result;
    for (int pass = 0; pass < 4; ++pass) {
      std::vector<int> before(mesh.size(), 0), calls(mesh.size(), 0);
      for_each_movable(mesh, [&](Vertex v) {
        for (const Vertex u : m.vertices_around_target(m.halfedge(v))) before[v] += calls[u];
        ++calls[v];
      });
      CHECK(std::count(calls.begin(), calls.end(), 1) == int(mesh.size()));
      // of two neighbors one is the first
      CHECK(std::accumulate(before.begin(), before.end(), 0) == int(m.number_of_edges()));
      result.push_back(before);
      int e = 0;
      for (const auto edge : m.edges())
        if (++e % (7 + pass) == 0 && mesh.working().is_flippable(edge)) mesh.flip(edge);
    }
    return result;
  };
  const auto one_by_one = changed_before(CGAL::Sequential_tag());
  CHECK(changed_before(CGAL::Parallel_if_available_tag()) == one_by_one);
  CHECK(one_by_one[0] != one_by_one[1]);
}

namespace {

struct Coarse_egg {
  Case c = make_case(shapes::ellipsoid(1, 0.7, 0.4, 3), 200, 1);
  Facet_tree tree{c.surface.points, c.surface.triangles};
  internal::Surface_projector projector{c.surface, tree};
  internal::Star_mesh mesh{c.raw, projector};
};

} // namespace

TEST_CASE("what is undone since a checkpoint is as it was, with or without a trace")
{
  Coarse_egg egg;
  internal::Star_mesh& mesh = egg.mesh;
  using Vertex = internal::Star_mesh::Vertex;
  const auto& m = mesh.working().mesh;
  const auto state = [&](bool with_changes) {
    std::vector<double> s;
    for (const Vertex v : m.vertices()) {
      for (const Vec3d& x : {mesh.point(v), mesh.normal(v)}) s.insert(s.end(), {x.x, x.y, x.z});
      s.insert(s.end(), {double(mesh.facet(v)), mesh.height(v), double(mesh.is_movable(v)),
                         double(m.halfedge(v))});
      if (with_changes) s.push_back(double(mesh.changes(v)));
    }
    for (const auto h : m.halfedges())
      s.insert(s.end(), {double(m.target(h)), double(m.next(h)), double(m.face(h))});
    for (const auto f : m.faces()) s.push_back(double(m.halfedge(f)));
    return s;
  };

  const std::vector<double> before = state(true);
  std::size_t flips = 0;
  for (const auto e : m.edges()) {
    if (!mesh.working().is_flippable(e)) continue;
    ++flips;
    const auto corners = mesh.corners(e);
    internal::Star_mesh::Checkpoint start(mesh);
    std::vector<internal::Star_mesh::State> states;
    for (const Vertex v : corners) states.push_back(mesh.state_around(v));
    mesh.flip(e);
    for (int k = 0; k < 4; ++k) {
      const Vertex v = corners[k];
      CHECK(mesh.state_around(v) != states[k]);
      mesh.move(v, mesh.project(v, 0.9 * mesh.point(v) + 0.1 * mesh.point(corners[0])));
    }
    CHECK(state(true) != before);
    start.rewind();
    CHECK(state(true) == before);
  }
  CHECK(flips > 500);

  const std::vector<double> all = state(false);
  internal::Star_mesh::Checkpoint start(mesh);
  std::vector<internal::Star_mesh::State> states;
  for (const Vertex u : m.vertices()) states.push_back(mesh.state_around(u));
  const Vertex v(7);
  mesh.pin(v);
  REQUIRE(mesh.move_off(v, 1.05 * mesh.point(v)));
  start.restore();
  CHECK(state(false) == all);
  for (const Vertex u : m.vertices()) {
    const bool is_near = u == v || mesh.working().are_adjacent(u, v);
    CHECK((mesh.state_around(u) != states[u]) == is_near);
  }

  // a vertex goes elsewhere; the new elements have the numbers of the old ones
  const auto collapsible = [&] {
    for (const auto h : m.halfedges())
      if (CGAL::Euler::does_satisfy_link_condition(m.edge(h), m)) return h;
    return internal::Star_mesh::Halfedge();
  };
  REQUIRE(collapsible().is_valid());
  mesh.collapse(collapsible());
  const std::vector<double> collapsed = state(false);
  {
    internal::Star_mesh::Checkpoint after(mesh);
    for (int pass = 0; pass < 2; ++pass) {
      const auto h = m.halfedge(*(m.vertices_begin() + 50));
      mesh.pin(mesh.split(
          h, egg.projector.nearest(0.5 * (mesh.point(m.source(h)) + mesh.point(m.target(h))))));
      CHECK(m.number_of_vertices() == mesh.size());
      CHECK(CGAL::is_valid_polygon_mesh(m));
      after.restore();
      CHECK(state(false) == collapsed);
    }
  }
  start.restore();
  CHECK(state(false) == all);
  CHECK(CGAL::is_valid_polygon_mesh(m));
}

TEST_CASE("vertices that have been taken out have nothing around them")
{
  Coarse_egg egg;
  internal::Star_mesh& mesh = egg.mesh;
  using Vertex = internal::Star_mesh::Vertex;
  const auto& m = mesh.working().mesh;
  internal::Bad_triangle_optimizer optimizer(mesh);
  internal::Vertex_mover mover(mesh, optimizer, 0.3);
  for (int k = 0; k < 3; ++k) {
    const std::vector<Vertex> spare = mover.find_spare();
    const auto in_mesh = [&](Vertex v) { return mesh.working().has_edges(v); };
    REQUIRE(!spare.empty());
    CHECK(std::all_of(spare.begin(), spare.end(), in_mesh));
    mover.remove(spare[0]);
  }
  REQUIRE(m.number_of_vertices() == mesh.size() - 3);
  std::vector<int> all(mesh.size());
  std::iota(all.begin(), all.end(), 0);
  CHECK(vertices_around(mesh, all).size() == m.number_of_vertices());
  CHECK(faces_around(mesh, all).size() == m.number_of_faces());
  for (const int v : all)
    if (m.is_removed(Vertex(v))) {
      CHECK(faces_around(mesh, std::vector<int>{v}).empty());
      CHECK(vertices_around(mesh, std::vector<int>{v}).empty());
      CHECK(mesh.state_around(Vertex(v)) != 0);
    }
}

TEST_CASE("a checkpoint undoes what its thread has done to its mesh")
{
  const Case c = make_case(shapes::ellipsoid(1, 0.7, 0.4, 3), 3000, 1);
  const Facet_tree tree(c.surface.points, c.surface.triangles);
  const internal::Surface_projector projector(c.surface, tree);
  internal::Star_mesh mesh(c.raw, projector), other(c.raw, projector);
  const int n = int(mesh.size());
  const Vec3d elsewhere{2, 3, 4};
  internal::for_each_chunk(CGAL::Parallel_if_available_tag(), n, 1, [&](int i, int) {
    const internal::Star_mesh::Vertex v(i);
    internal::Star_mesh::Checkpoint outer(mesh);
    {
      internal::Star_mesh::Checkpoint inner(mesh);
      mesh.set_point(v, elsewhere);
    }
    other.set_point(v, elsewhere);
    if (i % 3 > 0) outer.restore();
  });
  for (int i = 0; i < n; ++i) {
    const internal::Star_mesh::Vertex v(i);
    CHECK((mesh.point(v) == elsewhere) == (i % 3 == 0));
    CHECK(other.point(v) == elsewhere);
  }
}
