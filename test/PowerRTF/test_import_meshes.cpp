// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes of CGAL as they become surfaces: their types and point maps.
#include "mesh_of_shape.h"
#include "sound_surface.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <doctest/doctest.h>

#include <map>
#include <string>
#include <vector>

namespace PRTF = CGAL::PowerRTF;
using PRTF::import_surface;
using PRTF::Polygon_soup;
using PRTF::Repair_counts;
using PRTF::Surface;
using PRTF::Triangle;
using PRTF::Vec3d;
using shapes::Kernel;
using shapes::Mesh;
using sound_surface::check_is_sound;
using sound_surface::euler_characteristic;
using sound_surface::reason;

TEST_CASE("Surface_mesh and Polyhedron_3, own and foreign point maps")
{
  const shapes::Soup soup = shapes::torus(12, 8, 2, 1);
  const Surface reference = shapes::make_surface(soup);
  Repair_counts repairs;
  SUBCASE("Surface_mesh")
  {
    Mesh mesh = shapes::make_mesh(soup);
    const Surface s = import_surface(mesh, CGAL::parameters::default_values(), repairs);
    CHECK(s.points == reference.points);
    CHECK(s.area == doctest::Approx(reference.area));
    auto other = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_3>("v:other").first;
    for (const auto v : mesh.vertices()) {
      const auto p = mesh.point(v);
      put(other, v, Kernel::Point_3(p.x(), p.y(), 3 * p.z()));
    }
    const Surface tall = import_surface(mesh, CGAL::parameters::vertex_point_map(other), repairs);
    CHECK(tall.area > 1.5 * s.area);
    CHECK(tall.points[5].z == doctest::Approx(3 * s.points[5].z));
  }
  SUBCASE("Surface_mesh with removed and isolated vertices")
  {
    Mesh mesh;
    mesh.add_vertex({7, 7, 7});
    const auto removed = mesh.add_vertex({8, 8, 8});
    std::vector<Mesh::Vertex_index> v;
    const shapes::Soup tetrahedron = shapes::tetrahedron();
    for (const Vec3d& p : tetrahedron.points) v.push_back(mesh.add_vertex({p.x, p.y, p.z}));
    for (const Triangle& t : tetrahedron.triangles) mesh.add_face(v[t[0]], v[t[1]], v[t[2]]);
    mesh.remove_vertex(removed);
    const Surface s = import_surface(mesh, CGAL::parameters::default_values(), repairs);
    check_is_sound(s);
    CHECK(s.points.size() == 4);
    CHECK(repairs.unused_vertices == 1);
    CHECK(s.input_vertices == std::vector<int>{1, 2, 3, 4});
  }
  SUBCASE("Polyhedron_3")
  {
    using Polyhedron = CGAL::Polyhedron_3<Kernel>;
    const auto mesh = shapes::make_mesh<Polyhedron>(soup);
    const Surface s = import_surface(mesh, CGAL::parameters::default_values(), repairs);
    check_is_sound(s);
    CHECK(s.points.size() == reference.points.size());
    CHECK(s.area == doctest::Approx(reference.area));
    std::map<boost::graph_traits<Polyhedron>::vertex_descriptor, Kernel::Point_3> flat;
    for (const auto v : vertices(mesh)) {
      const auto p = v->point();
      flat[v] = Kernel::Point_3(p.x(), p.y(), p.z() / 2);
    }
    const Surface low = import_surface(
        mesh, CGAL::parameters::vertex_point_map(boost::make_assoc_property_map(flat)), repairs);
    CHECK(low.area < 0.9 * s.area);
  }
  SUBCASE("exact constructions")
  {
    using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
    const auto mesh = shapes::make_mesh<CGAL::Surface_mesh<Exact::Point_3>>(soup);
    const Surface s = import_surface(mesh, CGAL::parameters::default_values(), repairs);
    CHECK(s.points == reference.points);
  }
}

TEST_CASE("the facets of a Surface_mesh are read by any number of threads as one by one")
{
  Mesh mesh = shapes::make_mesh(shapes::torus(40, 30, 2, 1));
  for (const auto e : mesh.edges())
    if (e.idx() % 11 == 0 && mesh.face(mesh.halfedge(e, 0)) != mesh.face(mesh.halfedge(e, 1)))
      CGAL::Euler::join_face(mesh.halfedge(e), mesh); // larger facets, and gaps between them
  REQUIRE(mesh.has_garbage());
  std::map<Mesh::Vertex_index, int> places;
  for (const auto v : mesh.vertices()) places.emplace(v, static_cast<int>(places.size()));
  std::vector<int> corners, first{0};
  for (const auto f : mesh.faces()) {
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      corners.push_back(places[v]);
    first.push_back(static_cast<int>(corners.size()));
  }
  for (const PRTF::internal::Concurrency concurrency :
       {PRTF::internal::Concurrency(CGAL::Sequential_tag()),
        PRTF::internal::Concurrency(CGAL::Parallel_if_available_tag())}) {
    const Polygon_soup soup =
        PRTF::internal::soup_of_mesh(mesh, CGAL::parameters::default_values(), concurrency);
    CHECK(soup.corners == corners);
    CHECK(soup.first == first);
  }
}

TEST_CASE("a mesh keeps its connectivity: equal points of different vertices stay apart")
{
  const shapes::Soup square = shapes::plane_patch(1, 1);
  const auto two =
      shapes::make_mesh<Mesh>(shapes::joined(square, shapes::translated(square, {1, 0, 0})));
  Repair_counts repairs;
  const Surface s = import_surface(two, CGAL::parameters::default_values(), repairs);
  CHECK(s.points.size() == 8);
  CHECK(repairs.duplicate_vertices == 0);
}

TEST_CASE("an edge without length is removed and the surface stays closed")
{
  Repair_counts repairs;
  shapes::Soup s = shapes::icosphere(1);
  Mesh mesh = shapes::make_mesh<Mesh>(s);
  const auto h = *mesh.halfedges().begin();
  mesh.point(mesh.source(h)) = mesh.point(mesh.target(h));
  const Surface surface = import_surface(mesh, CGAL::parameters::default_values(), repairs);
  check_is_sound(surface);
  CHECK(surface.points.size() == s.points.size() - 1);
  CHECK(surface.triangles.size() == s.triangles.size() - 2);
  CHECK(euler_characteristic(surface) == 2);
  CHECK(repairs.duplicate_vertices == 1);
  CHECK(repairs.degenerate_facets == 2);
}

TEST_CASE("a mesh without facets is refused with a reason")
{
  Repair_counts repairs;
  const std::string said =
      reason([&] { import_surface(Mesh(), CGAL::parameters::default_values(), repairs); });
  CHECK(said.find("no facet") != std::string::npos);
}
