// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include "shapes.h"

#include <CGAL/PowerRTF/surface/nearest_vertices.h>
#include <CGAL/PowerRTF/surface/random_source.h>
#include <CGAL/PowerRTF/surface/vertex_facets.h>

#include <doctest/doctest.h>

#include <algorithm>

using namespace CGAL::PowerRTF;

namespace {

std::vector<int> by_sorting(const std::vector<Vec3d>& points, const Vec3d& q, std::size_t k)
{
  std::vector<std::pair<double, int>> all;
  for (std::size_t v = 0; v < points.size(); ++v)
    all.emplace_back(squared_length(points[v] - q), static_cast<int>(v));
  std::sort(all.begin(), all.end());
  std::vector<int> result;
  for (std::size_t i = 0; i < std::min(k, all.size()); ++i) result.push_back(all[i].second);
  return result;
}

std::vector<int> by_tree(const Nearest_vertices& tree, const Vec3d& q, int k)
{
  std::vector<int> result(Nearest_vertices::max_neighbors);
  result.resize(tree.find(q, k, result.data()));
  return result;
}

} // namespace

TEST_CASE("the k nearest vertices, compared with sorting all")
{
  const shapes::Soup soups[] = {shapes::icosphere(3), shapes::torus(40, 20, 2, 0.5),
                                shapes::thin_disc(1e-3, 8), shapes::tetrahedron(),
                                shapes::ellipsoid(20, 1, 1, 3)};
  for (const shapes::Soup& soup : soups) {
    const Surface s = shapes::make_surface(soup);
    const Nearest_vertices tree(s);
    for (unsigned seed = 0; seed < 3; ++seed) {
      Random_source random(seed);
      for (int query = 0; query < 60; ++query) {
        Vec3d q{random() - 0.5, random() - 0.5, random() - 0.5};
        if (query % 3 == 1) q = s.points[query % s.points.size()];
        if (query % 3 == 2) q = 100. * q; // far away
        for (const int k : {1, 3, 12, 16, 64})
          CHECK(by_tree(tree, q, k) == by_sorting(s.points, q, k));
      }
    }
  }
}

TEST_CASE("equal distances come by index")
{
  std::vector<Vec3d> lattice; // many ties, also between leaves
  for (int i = 0; i < 1000; ++i)
    lattice.push_back({double(i / 100), double(i / 10 % 10), double(i % 10)});
  const Nearest_vertices tree(lattice);
  for (const Vec3d& q : {Vec3d{4.5, 4.5, 4.5}, Vec3d{3, 3, 3}, Vec3d{-1, 5, 5}})
    for (const int k : {1, 2, 7, 20, 33, 64})
      CHECK(by_tree(tree, q, k) == by_sorting(lattice, q, k));
  const std::vector<Vec3d> same(50, Vec3d{1, 2, 3});
  CHECK(by_tree(Nearest_vertices(same), {0, 0, 0}, 20) == by_sorting(same, {0, 0, 0}, 20));
}

TEST_CASE("few vertices, none, and more than there are")
{
  const std::vector<Vec3d> none;
  CHECK(by_tree(Nearest_vertices(none), {0, 0, 0}, 3).empty());
  const std::vector<Vec3d> two = {{0, 0, 0}, {1, 0, 0}};
  CHECK(by_tree(Nearest_vertices(two), {0.9, 0, 0}, 16) == std::vector<int>{1, 0});
  CHECK(by_tree(Nearest_vertices(two), {0.9, 0, 0}, 0).empty());
  CHECK(by_tree(Nearest_vertices(two), {0.9, 0, 0}, -1).empty());
  const Surface s = shapes::make_surface(shapes::icosphere(2));
  CHECK(by_tree(Nearest_vertices(s), {0, 0, 0}, 1000).size() == Nearest_vertices::max_neighbors);
}

TEST_CASE("the facets at each vertex")
{
  for (const shapes::Soup& soup : {shapes::octahedron(), shapes::plane_patch(4, 3)}) {
    const Surface s = shapes::make_surface(soup);
    const Vertex_facets at = vertex_facets(s);
    REQUIRE(at.first.size() == s.points.size() + 1);
    CHECK(at.facet.size() == 3 * s.triangles.size());
    for (int v = 0; v < static_cast<int>(s.points.size()); ++v) {
      std::vector<int> expected;
      for (int f = 0; f < static_cast<int>(s.triangles.size()); ++f)
        if (std::count(s.triangles[f].begin(), s.triangles[f].end(), v)) expected.push_back(f);
      CHECK(std::vector<int>(at.facet.begin() + at.first[v], at.facet.begin() + at.first[v + 1]) ==
            expected);
    }
  }
}
