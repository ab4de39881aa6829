// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices that are taken out within a distance.
#include "../improvement_case.h"

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/bounding_box.h>
#include <CGAL/PowerRTF/improvement/coarsen_mesh.h>
#include <CGAL/PowerRTF/improvement/improve_mesh.h>
#include <CGAL/PowerRTF/quality/assess.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

using namespace improvement_case;

namespace {

// An improved mesh, and the distances of its surface.
struct Improved {
  Case c;
  Facet_tree tree;
  double diagonal;

  explicit Improved(const shapes::Soup& soup, std::size_t n = 1200)
      : c(make_case(soup, n, 1, Sampling::stratified)), tree(c.surface.points, c.surface.triangles)
  {
    REQUIRE(improve_mesh(c.surface, tree, c.raw));
    const auto box = CGAL::PowerRTF::internal::bounding_box(c.surface.points, c.surface.triangles);
    diagonal = length(box.hi - box.lo);
  }

  // To `percent` of the diagonal.
  std::pair<Extracted_mesh, std::size_t>
  coarse(double percent,
         CGAL::PowerRTF::internal::Concurrency concurrency = CGAL::Sequential_tag()) const
  {
    Extracted_mesh mesh = c.raw;
    const std::size_t taken =
        coarsen_mesh(c.surface, tree, mesh, percent / 100 * diagonal, concurrency);
    return {std::move(mesh), taken};
  }

  Remeshing_report judged(const Extracted_mesh& mesh) const
  {
    Remeshing_report report;
    assess(c.surface, mesh, report);
    return report;
  }
};

} // namespace

TEST_CASE("a mesh becomes coarser within a distance")
{
  for (const shapes::Soup& soup :
       {shapes::ellipsoid(1, 0.6, 0.3, 4), shapes::torus(60, 30, 1, 0.4),
        shapes::open_cylinder(40, 20, 1, 2), shapes::plane_patch(20, 20)}) {
    const Improved mesh(soup);
    const Remeshing_report before = mesh.judged(mesh.c.raw);
    for (const double percent : {0.5, 1.}) {
      CAPTURE(percent);
      const auto [coarse, taken] = mesh.coarse(percent);
      const Remeshing_report after = mesh.judged(coarse);
      CHECK(double(taken) > 0.15 * double(mesh.c.raw.points.size()));
      CHECK(after.topology.vertices + taken == before.topology.vertices);
      CHECK(coarse.points.size() + taken == mesh.c.raw.points.size());
      CHECK(after.topology.euler_characteristic == before.topology.euler_characteristic);
      CHECK(after.topology.border_edges == before.topology.border_edges);
      CHECK(after.topology.non_manifold_edges == 0);
      CHECK(after.topology.non_manifold_vertices == 0);
      CHECK(after.self_intersections == 0);
      CHECK(after.distance.bound <= std::max(percent, before.distance.bound));
      CHECK(after.quality.theta_min > std::min(40., before.quality.theta_min - 1e-9));
    }
  }
}

TEST_CASE("what is as near as can be, or no manifold, stays as it is")
{
  Improved mesh(shapes::icosphere(4), 600);
  const auto check_same = [&](double percent) {
    const auto [same, taken] = mesh.coarse(percent);
    CHECK(taken == 0);
    CHECK(same.points == mesh.c.raw.points);
    CHECK(same.triangles == mesh.c.raw.triangles);
  };
  check_same(0.01);
  mesh.c.raw.triangles.push_back(mesh.c.raw.triangles.front());
  check_same(1);
}

TEST_CASE("few and no triangles")
{
  Improved mesh(shapes::icosphere(2), 4);
  CHECK(mesh.coarse(10).second == 0);
  mesh.c.raw = {};
  CHECK(mesh.coarse(10).second == 0);
}

TEST_CASE("vertices on features and borders stay, and are named as before")
{
  Improved mesh(shapes::open_cylinder(40, 20, 1, 2), 1500);
  const Extracted_mesh& fine = mesh.c.raw;
  std::vector<Edge> features; // the corners of many triangles inside
  for (std::size_t f = 0; f < fine.triangles.size(); f += 20)
    features.push_back({fine.triangles[f][0], fine.triangles[f][1]});
  mesh.c.raw.feature_edges = features;
  mesh.c.raw.input_points.resize(fine.points.size());
  for (const Edge& e : features)
    for (const int v : e) mesh.c.raw.input_points[v].number = 7 * v;
  const auto [coarse, taken] = mesh.coarse(1);
  REQUIRE(taken > 100);
  REQUIRE(coarse.input_points.size() == coarse.points.size());
  REQUIRE(coarse.feature_edges.size() == features.size());
  for (std::size_t k = 0; k < features.size(); ++k)
    for (const int end : {0, 1}) {
      const int v = features[k][end], w = coarse.feature_edges[k][end];
      CHECK(coarse.points[w] == fine.points[v]);
      CHECK(coarse.input_points[w].number == 7 * v);
    }
  const auto edges = [](const Extracted_mesh& m) {
    std::set<Edge> all;
    for (const Triangle& t : m.triangles)
      for (int k = 0; k < 3; ++k) all.insert(sorted_edge(t[k], t[(k + 1) % 3]));
    return all;
  };
  const std::set<Edge> of_coarse = edges(coarse);
  for (const auto& [a, b] : coarse.feature_edges) CHECK(of_coarse.count(sorted_edge(a, b)) == 1);
  CHECK(mesh.judged(coarse).topology.border_edges == mesh.judged(fine).topology.border_edges);
}

TEST_CASE("a coarse mesh is the same with all threads")
{
  const Improved mesh(shapes::torus(60, 30, 1, 0.4), 3000);
  const auto one_by_one = mesh.coarse(0.5),
             at_once = mesh.coarse(0.5, CGAL::Parallel_if_available_tag());
  CHECK(one_by_one.second > 0);
  CHECK(at_once.first.points == one_by_one.first.points);
  CHECK(at_once.first.triangles == one_by_one.first.triangles);
}
