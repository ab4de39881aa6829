// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/PowerRTF/extraction/connect_halfedges.h>
#include <CGAL/PowerRTF/extraction/export_mesh.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/tags.h>

#include <doctest/doctest.h>

#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using internal::Concurrency;

namespace {

using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

const Concurrency both[] = {CGAL::Sequential_tag(), CGAL::Parallel_if_available_tag()};

// A grid of n x m squares, each cut in two.
std::vector<Triangle> grid(int n, int m)
{
  std::vector<Triangle> triangles;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const int a = i * (m + 1) + j, b = a + m + 1;
      triangles.push_back({a, b, b + 1});
      triangles.push_back({a, b + 1, a + 1});
    }
  return triangles;
}

bool is_empty(const Mesh& mesh)
{
  return mesh.number_of_vertices() + mesh.number_of_halfedges() + mesh.number_of_faces() == 0;
}

} // namespace

TEST_CASE("triangles become faces, whatever share of their edges is on the border")
{
  for (const Concurrency& concurrency : both)
    for (const auto& [n, m] : {std::pair(1, 1), std::pair(1, 100), std::pair(60, 50)}) {
      const std::vector<Triangle> triangles = grid(n, m);
      const int vertices = (n + 1) * (m + 1);
      Mesh mesh;
      REQUIRE(internal::connect_halfedges(mesh, triangles, vertices, concurrency));
      CHECK(CGAL::is_valid_polygon_mesh(mesh));
      CHECK(int(mesh.number_of_edges()) == 3 * n * m + n + m);
      for (std::size_t f = 0; f < triangles.size(); ++f) {
        const Mesh::Halfedge_index h = mesh.halfedge(Mesh::Face_index(f));
        CHECK(Triangle{int(mesh.source(h)), int(mesh.target(h)), int(mesh.target(mesh.next(h)))} ==
              triangles[f]);
      }
    }
}

TEST_CASE("of what is no oriented 2-manifold nothing is made")
{
  const std::vector<Triangle> defects[] = {{{0, 1, 2}, {0, 1, 3}},             // turned
                                           {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}},  // three at an edge
                                           {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}}; // fine
  for (const Concurrency& concurrency : both)
    for (const std::vector<Triangle>& triangles : defects) {
      Mesh mesh;
      const bool is_fine = &triangles == std::prev(std::end(defects));
      CHECK(internal::connect_halfedges(mesh, triangles, 5, concurrency) == is_fine);
      CHECK(is_empty(mesh) != is_fine);
    }
  Mesh mesh;
  CHECK_FALSE(internal::connect_halfedges(mesh, {{0, 1, 2}, {0, 3, 4}}, 5, both[1])); // a bow-tie
  CHECK(is_empty(mesh));
}

TEST_CASE("an exported mesh is the same for any concurrency")
{
  Extracted_mesh mesh;
  mesh.triangles = grid(40, 30);
  for (int v = 0; v < 41 * 31 + 2; ++v) // with two that have no triangle
    mesh.points.push_back({v / 64., v % 31 / 8., 1. / (1 + v)});
  Mesh output[2];
  for (const int k : {0, 1}) {
    const auto exported =
        export_mesh(mesh, {}, output[k], CGAL::parameters::default_values(), both[k]);
    REQUIRE(output[k].number_of_vertices() == 41 * 31);
    REQUIRE(exported.vertices.size() == 41 * 31);
    REQUIRE(exported.faces.size() == mesh.triangles.size());
    for (std::size_t v = 0; v < exported.vertices.size(); ++v) {
      const Vec3d& p = mesh.points[exported.points[v]];
      CHECK(output[k].point(exported.vertices[v]) == Mesh::Point(p.x, p.y, p.z));
    }
    for (std::size_t f = 0; f < exported.faces.size(); ++f) // begins at its first corner
      CHECK(int(output[k].target(output[k].halfedge(exported.faces[f]))) == mesh.triangles[f][0]);
  }
  for (const Mesh::Halfedge_index h : output[0].halfedges()) {
    CHECK(output[1].next(h) == output[0].next(h));
    CHECK(output[1].target(h) == output[0].target(h));
  }
}
