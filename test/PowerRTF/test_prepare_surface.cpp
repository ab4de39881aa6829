// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dirty_shapes.h"
#include "shapes.h"

#include <CGAL/PowerRTF/features/Surface_patches.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/vertex_corners.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF/sampling/random_source.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>

using namespace CGAL::PowerRTF;
using Mesh = CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3>;

namespace {

Mesh mesh_of(const shapes::Soup& soup)
{
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for (const Vec3d& p : soup.points) v.push_back(mesh.add_vertex({p.x, p.y, p.z}));
  for (const Triangle& t : soup.triangles) mesh.add_face(v[t[0]], v[t[1]], v[t[2]]);
  return mesh;
}

const auto defaults = CGAL::parameters::default_values();

} // namespace

TEST_CASE("a mesh and the soup of it become the same surface, with creases and density")
{
  const shapes::Soup soup = shapes::joined(
      shapes::box(6), shapes::translated(shapes::ellipsoid(1, 0.5, 0.5, 3), {4, 0, 0}));
  const Remeshing_options options;
  Remeshing_report of_mesh, of_soup;
  const Surface a = prepare_surface(mesh_of(soup), options, defaults, of_mesh);
  const Surface b = prepare_surface(soup.points, soup.triangles, options, of_soup);
  CHECK(a.points == b.points);
  CHECK(a.triangles == b.triangles);
  CHECK(a.creases == b.creases);
  CHECK(a.creases.size() == 12 * 6);
  CHECK(a.vertex_density == b.vertex_density);
  const auto [least, largest] =
      std::minmax_element(a.vertex_density.begin(), a.vertex_density.end());
  CHECK(*largest > 2 * *least);
}

TEST_CASE("the surface is the same with and without threads")
{
  const shapes::Soup shapes_[] = {shapes::box(12), shapes::torus(90, 60, 2, 1),
                                  shapes::joined(shapes::plane_patch(30, 20), shapes::icosphere(3)),
                                  shapes::open_cylinder(40, 30, 1, 3)};
  for (const shapes::Soup& soup : shapes_) {
    Remeshing_options options;
    options.density = Density::curvature;
    options.density_smoothing = 1;
    options.number_of_samples = 400;
    Remeshing_report report;
    Surface a = prepare_surface(soup.points, soup.triangles, options, report);
    Surface b = prepare_surface(soup.points, soup.triangles, options, report,
                                CGAL::Parallel_if_available_tag());
    const auto check = [&] {
      CHECK(a.triangles == b.triangles);
      CHECK(a.adjacency.opposite == b.adjacency.opposite);
      CHECK(a.facet_normals == b.facet_normals);
      CHECK(a.vertex_normals == b.vertex_normals);
      CHECK(a.area == b.area);
      CHECK(a.creases == b.creases);
      CHECK(a.vertex_density == b.vertex_density);
    };
    check();
    const Surface_patches pa(a, options), pb(b, options, CGAL::Parallel_if_available_tag());
    check();
    CHECK(pa.surface().vertex_normals == pb.surface().vertex_normals);
    CHECK(pa.features().samples.points == pb.features().samples.points);
  }
}

TEST_CASE("components by threads, compared with a search from facet to facet")
{
  shapes::Soup soup = shapes::icosphere(3);
  for (int k = 1; k < 6; ++k)
    soup = shapes::joined(
        soup, shapes::translated(k % 2 ? shapes::plane_patch(k, 9) : shapes::torus(12, 8, 2, 1),
                                 {10. * k, 0, 0}));
  Random_source random(1); // facets in any order
  for (std::size_t f = soup.triangles.size(); f-- > 1;)
    std::swap(soup.triangles[f], soup.triangles[std::size_t(random() * double(f + 1))]);
  const Facet_adjacency adjacency = facet_adjacency(soup.triangles, soup.points.size());
  std::vector<int> expected(soup.triangles.size(), -1), stack;
  int count = 0;
  for (std::size_t seed = 0; seed < expected.size(); ++seed) {
    if (expected[seed] >= 0) continue;
    for (stack.push_back(int(seed)); !stack.empty();) {
      const int f = stack.back();
      stack.pop_back();
      if (expected[f] >= 0) continue;
      expected[f] = count;
      for (int h = 3 * f; h < 3 * f + 3; ++h)
        if (adjacency.opposite[h] != Facet_adjacency::none)
          stack.push_back(adjacency.opposite[h] / 3);
    }
    ++count;
  }
  CHECK(count == 6);
  CHECK(facet_components(adjacency) == std::pair(expected, count));
  CHECK(facet_components(adjacency, CGAL::Parallel_if_available_tag()) ==
        std::pair(expected, count));
  CHECK(facet_components({}).second == 0);
}

TEST_CASE("corners at vertices: each once, increasing")
{
  const shapes::Soup soup = shapes::torus(90, 60, 2, 1);
  const std::size_t vertices = soup.points.size() + 1; // the last one is not used
  const auto a = vertex_corners(soup.triangles, vertices);
  const auto b = vertex_corners(soup.triangles, vertices, CGAL::Parallel_if_available_tag());
  CHECK(a.first == b.first);
  CHECK(a.entries == b.entries);
  REQUIRE(a.first.size() == vertices + 1);
  CHECK(a.first.back() == int(3 * soup.triangles.size()));
  for (std::size_t v = 0; v < vertices; ++v)
    for (int k = a.first[v]; k < a.first[v + 1]; ++k) {
      const int c = a.entries[k];
      CHECK(soup.triangles[c / 3][c % 3] == int(v));
      if (k > a.first[v]) CHECK(a.entries[k - 1] < c);
    }
}

TEST_CASE("repairs and seconds are added to the report, or the input is refused")
{
  shapes::Soup soup = shapes::icosphere(2);
  soup.triangles.push_back(soup.triangles.front());
  std::swap(soup.triangles[5][0], soup.triangles[5][1]);
  Remeshing_options options;
  Remeshing_report report;
  report.seconds.surface = 100;
  prepare_surface(soup.points, soup.triangles, options, report);
  CHECK(report.repairs.duplicate_facets == 1);
  CHECK(report.repairs.reoriented_facets == 1);
  CHECK(report.seconds.surface > 100);
  options.repair = Repair::no;
  CHECK_THROWS_AS(prepare_surface(soup.points, soup.triangles, options, report),
                  Invalid_input_error);
  CHECK(report.repairs.duplicate_facets == 1);
}

TEST_CASE("marked edges are the creases, and given densities the density")
{
  Mesh mesh = mesh_of(shapes::plane_patch(4, 4)); // vertex = 5 row + column
  mesh.add_vertex({9, 9, 9});                     // is not used
  auto is_marked = mesh.add_property_map<Mesh::Edge_index, bool>("e:marked", false).first;
  auto density = mesh.add_property_map<Mesh::Vertex_index, double>("v:density", -1).first;
  for (const auto e : mesh.edges()) {
    const int a = int(mesh.vertex(e, 0)), b = int(mesh.vertex(e, 1));
    is_marked[e] = a / 5 == b / 5 && (a / 5 == 2 || a / 5 == 0); // the middle, and a border
  }
  for (int v = 0; v < 25; ++v) density[Mesh::Vertex_index(v)] = 1 + v / 5;
  Remeshing_options options;
  options.gradation = 0;
  Remeshing_report report;
  const Surface s = prepare_surface(
      mesh, options, parameters::edge_is_constrained_map(is_marked).density_map(density), report);
  CHECK(s.creases == std::vector<Edge>{{10, 11}, {11, 12}, {12, 13}, {13, 14}});
  for (int v = 0; v < 25; ++v) CHECK(s.vertex_density[v] == doctest::Approx((1 + v / 5) / 5.));
}

TEST_CASE("a marked seam is one crease")
{
  const shapes::Soup strip = shapes::moebius_strip(30);
  std::vector<Edge> all;
  for (const Triangle& t : strip.triangles)
    for (int i = 0; i < 3; ++i) all.push_back({t[i], t[(i + 1) % 3]});
  Remeshing_report report;
  Surface_fields fields;
  fields.creases = all;
  const Surface s =
      prepare_surface(internal::soup_of_ranges(strip.points, strip.triangles), fields, {}, report);
  REQUIRE(!s.seams.empty());
  CHECK(std::includes(s.creases.begin(), s.creases.end(), s.seams.begin(), s.seams.end()));
  CHECK(std::adjacent_find(s.creases.begin(), s.creases.end()) == s.creases.end());
  CHECK(s.creases.size() == s.triangles.size()); // all edges but those of the border
}
