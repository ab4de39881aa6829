// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A part of a mesh is remeshed, the rest stays.
#include "test_regions/faces_where.h"

#include <CGAL/PowerRTF/geometry/self_intersections.h>
#include <CGAL/power_rtf_remeshing.h>

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polyhedron_3.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace CGAL::PowerRTF;
using regions::center;
using regions::check_invariance;
using regions::faces_where;
using regions::Is_inside;
using regions::is_upper;
using regions::sphere;
using shapes::make_mesh;
using shapes::Mesh;
using shapes::soup_of;
using Polyhedron = CGAL::Polyhedron_3<shapes::Kernel>;
namespace params = CGAL::PowerRTF::parameters;

namespace {

long euler_characteristic(const Mesh& mesh)
{
  return long(mesh.number_of_vertices()) - long(mesh.number_of_edges()) +
         long(mesh.number_of_faces());
}

/// The corners of the kept faces, which are the same elements afterwards.
std::map<Mesh::Face_index, std::vector<std::pair<Mesh::Vertex_index, Mesh::Point>>>
corners_of(const Mesh& mesh, const std::set<Mesh::Face_index>& without)
{
  std::map<Mesh::Face_index, std::vector<std::pair<Mesh::Vertex_index, Mesh::Point>>> result;
  for (const auto f : mesh.faces())
    if (!without.count(f))
      for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
        result[f].emplace_back(v, mesh.point(v));
  return result;
}

/// Remeshes the part of `mesh` that is inside, and checks what always holds.
Remeshing_report remesh(Mesh& mesh, const Is_inside& is_inside, const Resolution& resolution,
                        const Remeshing_options& options = {})
{
  const auto faces = faces_where(mesh, is_inside);
  const auto before = corners_of(mesh, {faces.begin(), faces.end()});
  const long characteristic = euler_characteristic(mesh);
  std::vector<Mesh::Halfedge_index> loops;
  CGAL::Polygon_mesh_processing::extract_boundary_cycles(mesh, std::back_inserter(loops));
  const std::size_t borders = loops.size();

  const Remeshing_report report =
      CGAL::power_rtf_remeshing(faces, mesh, resolution, params::remeshing_options(options));
  mesh.collect_garbage(); // moves elements
  CHECK(CGAL::is_valid_polygon_mesh(mesh));
  CHECK(euler_characteristic(mesh) == characteristic);
  loops.clear();
  CGAL::Polygon_mesh_processing::extract_boundary_cycles(mesh, std::back_inserter(loops));
  CHECK(loops.size() == borders);
  CHECK(report.missed_guarantees().empty());
  for (const std::string& missed : report.missed_guarantees()) MESSAGE(missed);
  CHECK(report.kept_faces == before.size());
  CHECK(mesh.number_of_faces() == report.kept_faces + report.topology.faces);

  std::multiset<std::vector<Mesh::Point>> polygons;
  const auto cycle = [](std::vector<Mesh::Point> points) {
    std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
    return points;
  };
  for (const auto f : mesh.faces()) {
    std::vector<Mesh::Point> points;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      points.push_back(mesh.point(v));
    polygons.insert(cycle(points));
  }
  for (const auto& [f, corners] : before) {
    std::vector<Mesh::Point> points;
    for (const auto& [v, p] : corners) points.push_back(p);
    CHECK(polygons.count(cycle(points)) == 1);
  }
  return report;
}

} // namespace

TEST_CASE("the rest of the mesh stays the same elements")
{
  Mesh mesh = sphere();
  auto marks = mesh.add_property_map<Mesh::Face_index, int>("f:mark", 7).first;
  const auto faces = faces_where(mesh, is_upper);
  const auto before = corners_of(mesh, {faces.begin(), faces.end()});
  for (const auto& [f, corners] : before) marks[f] = int(f);
  const Remeshing_report report = CGAL::power_rtf_remeshing(faces, mesh, 300);
  CHECK(report.missed_guarantees().empty());
  CHECK(report.topology.vertices == 300);
  CHECK(report.kept_faces == before.size());
  CHECK(report.topology.border_loops == 1);
  CHECK(CGAL::is_valid_polygon_mesh(mesh));
  CHECK(CGAL::is_closed(mesh));
  CHECK_FALSE(CGAL::Polygon_mesh_processing::does_self_intersect(mesh));
  for (const auto& [f, corners] : before) {
    REQUIRE_FALSE(mesh.is_removed(f));
    CHECK(marks[f] == int(f));
    std::vector<std::pair<Mesh::Vertex_index, Mesh::Point>> after;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      after.emplace_back(v, mesh.point(v));
    CHECK(after == corners);
  }
}

TEST_CASE("a Polyhedron_3 of quadrangles, of which some are remeshed")
{
  std::vector<std::vector<std::size_t>> quads;
  const std::size_t m = 8;
  std::vector<Vec3d> points;
  for (std::size_t j = 0; j <= m; ++j)
    for (std::size_t i = 0; i <= m; ++i) points.push_back({double(i), double(j), 0});
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t v = j * (m + 1) + i;
      quads.push_back({v, v + 1, v + m + 2, v + m + 1});
    }
  Polyhedron mesh = make_mesh<Polyhedron>(points, quads);
  std::vector<Polyhedron::Facet_handle> region;
  for (const auto f : faces(mesh))
    if (f->halfedge()->vertex()->point().x() > 4.5) region.push_back(f);
  const std::size_t kept = num_faces(mesh) - region.size();
  const Remeshing_report report = CGAL::power_rtf_remeshing(region, mesh, 60);
  CHECK(report.missed_guarantees().empty());
  CHECK(report.kept_faces == kept);
  CHECK(CGAL::is_valid_polygon_mesh(mesh));
  std::size_t quadrangles = 0;
  for (const auto f : faces(mesh)) quadrangles += f->is_quad();
  CHECK(quadrangles == kept);
}

TEST_CASE("spacing inside as on the border, finer, coarser")
{
  for (const double edge : {0.04, 0.075, 0.15}) { // the input's are about 0.075
    CAPTURE(edge);
    Mesh mesh = sphere();
    const Remeshing_report report = remesh(mesh, is_upper, Resolution::edge_length(edge));
    CHECK(report.quality.q_min > 0.5);
    CHECK(report.quality.theta_min > 25);
    CHECK(report.quality.q_avg > 0.88);
    CHECK(report.edge_length.min > 0.4 * (std::min)(edge, 0.06));
  }
}

TEST_CASE("a number of vertices is kept, whatever the border asks for")
{
  for (const std::size_t n : {150, 400, 2000}) {
    CAPTURE(n);
    Mesh mesh = sphere();
    CHECK(remesh(mesh, is_upper, n).topology.vertices == n);
  }
  Mesh coarse = make_mesh(shapes::icosphere(1)); // 4 of its facets around a vertex
  const Remeshing_report report = remesh(
      coarse, [](const Vec3d& p) { return p.x + p.y + 3 * p.z > 2; }, 120);
  CHECK(report.topology.vertices == 120);
}

TEST_CASE("a single triangle with many vertices")
{
  for (const std::size_t n : {4, 30, 100}) {
    CAPTURE(n);
    Mesh mesh = make_mesh(shapes::box(1));
    const Remeshing_report report = remesh(
        mesh, [](const Vec3d& p) { return p.z > 0.99 && p.x > p.y; }, n);
    CHECK(report.kept_faces == 11);
    CHECK(report.topology.border_edges == 3);
    CHECK(report.quality.theta_min > 0.5);
  }
}

TEST_CASE("vertices of the border are as many as before, and do not move")
{
  // The middle of the square, in a coarse mesh whose border would slide for better triangles.
  shapes::Soup soup = shapes::plane_patch(12, 12);
  for (Vec3d& p : soup.points) p.x += 0.03 * std::sin(40 * p.y) * std::cos(3 * p.x);
  Polygon_soup whole;
  whole.points = soup.points;
  std::vector<char> is_inside;
  for (const Triangle& t : soup.triangles) {
    for (const int v : t) whole.add_corner(v);
    whole.end_polygon();
    const Vec3d c = (1. / 3) * (soup.points[t[0]] + soup.points[t[1]] + soup.points[t[2]]);
    is_inside.push_back(c.x > 0.3 && c.x < 0.7 && c.y > 0.3 && c.y < 0.7);
  }
  const internal::Soup_region region(whole, is_inside, {});
  Remeshing_options options;
  options.number_of_samples = 150;
  Remeshing_report report;
  Surface surface = prepare_surface(Polygon_soup(region.soup), region.fields, options, report);
  const std::size_t vertices = surface.kept_vertices.size();
  CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<shapes::Kernel, CGAL::Sequential_tag>> remesher(
      std::move(surface), options, report);
  Remeshing_default_visitor visitor;
  REQUIRE(remesher.optimize(visitor));
  const Extracted_mesh mesh = remesher.extract(visitor);
  const Normalization& normalization = remesher.surface().normalization;
  std::size_t kept = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (!mesh.is_kept(int(v))) continue;
    ++kept;
    const Vec3d p = region.soup.points[mesh.input_points[v].number];
    CHECK(length(normalization.to_outside(mesh.points[v]) - p) < 1e-14);
  }
  CHECK(kept == vertices);
  CHECK(remesher.report().topology.border_edges == region.fields.kept_edges.size());
}

TEST_CASE("the border of the mesh is remeshed with the region")
{
  Mesh mesh = make_mesh(shapes::plane_patch(10, 10));
  const std::size_t before = remesh(
                                 mesh, [](const Vec3d& p) { return p.x > 0.5; }, 300)
                                 .topology.border_edges;
  CHECK(before > 30 + 10); // 20 on three sides before, and 10 kept
}

TEST_CASE("regions in several parts, with holes, that touch themselves in a vertex")
{
  Mesh parts = sphere();
  CHECK(remesh(
            parts, [](const Vec3d& p) { return std::abs(p.z) > 0.5; }, 600)
            .topology.components == 2);
  Mesh ring = sphere();
  CHECK(remesh(
            ring, [](const Vec3d& p) { return std::abs(p.z) < 0.4; }, 500)
            .topology.border_loops == 2);
  Mesh mesh = make_mesh(shapes::plane_patch(12, 12));
  // Two squares of the board, and the corner between them.
  const Remeshing_report report = remesh(
      mesh,
      [](const Vec3d& p) {
        return p.x > 0.2 && p.x < 0.8 && p.y > 0.2 && p.y < 0.8 && (p.x < 0.5) == (p.y < 0.5);
      },
      200);
  CHECK(report.topology.vertices == 200);
}

TEST_CASE("all faces: as a whole mesh")
{
  Mesh mesh = sphere(), whole;
  CGAL::power_rtf_remeshing(mesh, 300, whole);
  const auto all = mesh.faces();
  const Remeshing_report report =
      CGAL::power_rtf_remeshing(std::vector<Mesh::Face_index>(all.begin(), all.end()), mesh, 300);
  CHECK(report.kept_faces == 0);
  mesh.collect_garbage();
  CHECK(std::multiset<Mesh::Point>(mesh.points().begin(), mesh.points().end()) ==
        std::multiset<Mesh::Point>(whole.points().begin(), whole.points().end()));
}

TEST_CASE("new faces get the labels of the old ones, and the lines between them stay")
{
  Mesh mesh = sphere();
  auto labels = mesh.add_property_map<Mesh::Face_index, int>("f:label", 0).first;
  for (const auto f : mesh.faces()) labels[f] = center(mesh, f).x > 0 ? 5 : 3;
  const auto faces = faces_where(mesh, is_upper);
  const Remeshing_report report =
      CGAL::power_rtf_remeshing(faces, mesh, 300, params::face_patch_map(labels));
  CHECK(report.missed_guarantees().empty());
  CHECK(report.crease_edges > 10);
  for (const auto f : mesh.faces()) {
    const double x = center(mesh, f).x;
    if (std::abs(x) > 0.05) CHECK(labels[f] == (x > 0 ? 5 : 3));
  }
}

TEST_CASE("scaled, and on one thread, a region becomes the same")
{
  check_invariance([](const auto& faces, Mesh& mesh, auto concurrency) {
    CGAL::power_rtf_remeshing<decltype(concurrency)>(faces, mesh, 300);
  });
}

TEST_CASE("a vertex on an edge that should be kept is told")
{
  Polygon_soup soup; // two triangles, of which the second is remeshed
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
  for (const int v : {1, 0, 2, 0, 1, 3}) {
    soup.add_corner(v);
    if (soup.corners.size() % 3 == 0) soup.end_polygon();
  }
  const internal::Soup_region region(soup, {0, 1}, {});
  Extracted_mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}};
  mesh.input_points = {{0}, {1}, {}, {}};
  const auto judged = [&] {
    Remeshing_report report;
    internal::Joined_mesh(soup, region, mesh, Normalization())
        .judge(soup, region, report, CGAL::Sequential_tag());
    return report;
  };
  mesh.triangles = {{0, 1, 2}};
  CHECK(judged().lost_feature_edges == 0);
  CHECK(judged().kept_faces == 1);
  CHECK(judged().kept_vertices == 3);
  mesh.triangles = {{0, 3, 2}, {3, 1, 2}};
  CHECK(judged().lost_feature_edges == 1);
}

TEST_CASE("new triangles that meet what stays are told")
{
  Polygon_soup soup; // two sheets, 0.1 apart
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}, {1, 0, 0.1}, {0, 1, 0.1}};
  for (int v = 0; v < 6; ++v) {
    soup.add_corner(v);
    if (v % 3 == 2) soup.end_polygon();
  }
  const internal::Soup_region region(soup, {0, 1}, {});
  Extracted_mesh mesh;
  mesh.points = {{0, 0, 0.1}, {1, 0, 0.1}, {0, 1, -0.1}};
  mesh.triangles = {{0, 1, 2}};
  Remeshing_report report;
  internal::Joined_mesh(soup, region, mesh, Normalization())
      .judge(soup, region, report, CGAL::Sequential_tag());
  CHECK(report.self_intersections == 1);
  CHECK(report.input_self_intersections == 0);
}

TEST_CASE("what cannot be")
{
  Mesh mesh = sphere();
  const auto untouched = soup_of(mesh);
  const std::vector<Mesh::Face_index> none;
  CHECK_THROWS_WITH_AS(CGAL::power_rtf_remeshing(none, mesh, 100), "no facet is in the region",
                       Invalid_input_error);
  const auto faces = faces_where(mesh, is_upper);
  CHECK_THROWS_WITH_AS(CGAL::power_rtf_remeshing(faces, mesh, 30),
                       doctest::Contains("the borders, creases and vertices that are to stay need"),
                       Invalid_input_error);
  Remeshing_options merging;
  merging.merge_distance = 0.01;
  CHECK_THROWS_WITH_AS(
      CGAL::power_rtf_remeshing(faces, mesh, 300, params::remeshing_options(merging)),
      doctest::Contains("regions"), Invalid_input_error);
  CHECK(soup_of(mesh).points == untouched.points);
  CHECK(soup_of(mesh).triangles == untouched.triangles);

  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  for (const int v : {0, 1, 2}) soup.add_corner(v);
  soup.end_polygon();
  CHECK_THROWS_WITH_AS(internal::Soup_region(soup, {1, 0}, {}),
                       "the region is told by 2 entries, but there are 1 facets",
                       Invalid_input_error);
}
