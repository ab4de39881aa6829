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
#include <string>
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

TEST_CASE("vertices that have to stay, and those on features, are in the coarse mesh")
{
  Improved mesh(shapes::ellipsoid(1, 0.6, 0.3, 4));
  const Triangle& t = mesh.c.raw.triangles[100];
  mesh.c.raw.feature_edges = {{t[0], t[1]}};
  const int kept = 700;
  mesh.c.raw.input_points.assign(mesh.c.raw.points.size(), -1);
  mesh.c.raw.input_points[kept] = 17;
  const auto [coarse, taken] = mesh.coarse(1);
  REQUIRE(taken > 100);
  REQUIRE(coarse.input_points.size() == coarse.points.size());
  const auto at = std::find(coarse.input_points.begin(), coarse.input_points.end(), 17);
  REQUIRE(at != coarse.input_points.end());
  CHECK(std::count(coarse.input_points.begin(), coarse.input_points.end(), -1) ==
        std::ptrdiff_t(coarse.points.size()) - 1);
  REQUIRE(coarse.feature_edges.size() == 1);
  const auto [a, b] = coarse.feature_edges[0];
  CHECK(coarse.points[a] == mesh.c.raw.points[t[0]]);
  CHECK(coarse.points[b] == mesh.c.raw.points[t[1]]);
  CHECK(std::any_of(
      coarse.triangles.begin(), coarse.triangles.end(), [a = a, b = b](const Triangle& f) {
        return std::count(f.begin(), f.end(), a) + std::count(f.begin(), f.end(), b) == 2;
      }));
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
