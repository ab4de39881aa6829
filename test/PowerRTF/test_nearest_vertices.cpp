// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "packed.h"
#include "shapes.h"

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/sampling/random_source.h>

#include <doctest/doctest.h>

#include <algorithm>

using namespace CGAL::PowerRTF;

namespace {

/// Numbers of vertices are their places in the tree.
std::vector<int> by_sorting(const Surface_view<double>& view, const Vec3d& q, std::size_t k)
{
  std::vector<std::pair<double, int>> all;
  for (int v = 0; v < view.vertex_tree.items; ++v)
    all.emplace_back(squared_length(view.vertices[v] - q), v);
  std::sort(all.begin(), all.end());
  std::vector<int> result;
  for (std::size_t i = 0; i < std::min(k, all.size()); ++i) result.push_back(all[i].second);
  return result;
}

std::vector<int> by_tree(const Surface_view<double>& view, const Vec3d& q, int k)
{
  std::vector<int> result(max_near_vertices);
  result.resize(nearest_vertices(view, q, k, result.data()));
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
    const Packed<double> packed(s);
    for (unsigned seed = 0; seed < 3; ++seed) {
      Random_source random(seed);
      for (int query = 0; query < 60; ++query) {
        Vec3d q{random() - 0.5, random() - 0.5, random() - 0.5};
        if (query % 3 == 1) q = s.points[query % s.points.size()];
        if (query % 3 == 2) q = 100. * q; // far away
        for (const int k : {1, 3, 12, 16, 64})
          CHECK(by_tree(packed.view(), q, k) == by_sorting(packed.view(), q, k));
      }
    }
  }
}

TEST_CASE("equal distances come by place")
{
  const Surface patch = shapes::make_surface(shapes::plane_patch(20, 20));
  const Packed<double> packed(patch);
  const Surface_view<double>& view = packed.view();
  for (int v = 0; v < view.vertex_tree.items; v += 17)
    for (const int k : {1, 2, 7, 20, 33, 64})
      CHECK(by_tree(view, view.vertices[v], k) == by_sorting(view, view.vertices[v], k));
}

TEST_CASE("fewer vertices than asked for, none, and more than can be found")
{
  const Surface tetrahedron = shapes::make_surface(shapes::tetrahedron());
  const Packed<double> few(tetrahedron);
  CHECK(by_tree(few.view(), few.view().vertices[2], 16).size() == 4);
  CHECK(by_tree(few.view(), few.view().vertices[2], 1) == std::vector<int>{2});
  CHECK(by_tree(few.view(), {0, 0, 0}, 0).empty());
  const Surface sphere = shapes::make_surface(shapes::icosphere(2));
  const Packed<double> many(sphere);
  CHECK(by_tree(many.view(), {0, 0, 0}, 1000).size() == max_near_vertices);
}

TEST_CASE("the facets at each vertex")
{
  for (const shapes::Soup& soup : {shapes::octahedron(), shapes::plane_patch(4, 3)}) {
    const Surface s = shapes::make_surface(soup);
    const Facet_tree tree(s.points, s.triangles);
    const Surface_in_tree packed = internal::make_surface_in_tree(s, tree, true);
    const int* const first = packed.facets.first_corner;
    CHECK(packed.vertex_facets.size() == 3 * s.triangles.size());
    for (int v = 0; v < static_cast<int>(s.points.size()); ++v) {
      std::vector<int> expected; // by their numbers in the surface
      for (int f = 0; f < static_cast<int>(s.triangles.size()); ++f) {
        if (std::count(s.triangles[f].begin(), s.triangles[f].end(), v))
          expected.push_back(tree.place(f));
      }
      CHECK(std::vector<int>(packed.vertex_facets.begin() + first[v],
                             packed.vertex_facets.begin() + first[v + 1]) == expected);
    }
  }
}
