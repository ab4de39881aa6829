// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is judged is what is written: points on a grid that the output's numbers hold, so that
// nothing is rounded after the result has been judged.
#include "shapes.h"

#include <CGAL/PowerRTF/geometry/output_grid.h>
#include <CGAL/power_rtf_remeshing.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace CGAL::PowerRTF;
using shapes::Soup;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Float_mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<float>::Point_3>;

/// Two unit squares that enclose an angle, the edge between them through the origin.
Soup wedge(double degrees)
{
  const double x = std::cos(degrees * shapes::pi / 360), z = std::sin(degrees * shapes::pi / 360);
  return {{{0, -.5, 0}, {0, .5, 0}, {x, -.5, -z}, {x, .5, -z}, {x, -.5, z}, {x, .5, z}},
          {{0, 1, 3}, {0, 3, 2}, {0, 4, 5}, {0, 5, 1}, {2, 3, 5}, {2, 5, 4}, {0, 2, 4}, {1, 5, 3}}};
}

Mesh make_mesh(const Soup& soup)
{
  std::vector<Kernel::Point_3> points;
  for (const Vec3d& p : soup.points) points.emplace_back(p.x, p.y, p.z);
  Mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, soup.triangles, mesh);
  return mesh;
}

/// In the mesh's own coordinates, exactly.
template <class Points>
bool intersects_itself(const CGAL::Surface_mesh<Points>& mesh)
{
  Mesh copy;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    copy.add_vertex({double(p.x()), double(p.y()), double(p.z())});
  }
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    REQUIRE(copy.add_face(Mesh::Vertex_index(mesh.source(h)), Mesh::Vertex_index(mesh.target(h)),
                          Mesh::Vertex_index(mesh.target(mesh.next(h))))
                .is_valid());
  }
  return CGAL::Polygon_mesh_processing::does_self_intersect(copy);
}

} // namespace

TEST_CASE("the mesh that is handed out is the one that was judged")
{
  for (const double degrees : {3., 2., 1., .5, .2})
    for (const std::size_t n : {100, 300, 1000})
      for (unsigned seed = 0; seed < 4; ++seed) {
        CAPTURE(degrees);
        CAPTURE(n);
        Remeshing_options options;
        options.random_seed = seed;
        Mesh output;
        const auto report =
            CGAL::power_rtf_remeshing(make_mesh(wedge(degrees)), n, output,
                                      CGAL::PowerRTF::parameters::remeshing_options(options));
        CHECK(report.missed_guarantees().empty());
        CHECK(!intersects_itself(output));
      }
}

TEST_CASE("coordinates of single precision")
{
  const Soup disc = shapes::thin_disc(0.001, 8);
  for (const Vec3d& offset : {Vec3d{0, 0, 0}, {10, 20, 30}, {100, -200, 300}}) {
    CAPTURE(offset.x);
    Float_mesh output;
    const auto report =
        CGAL::power_rtf_remeshing(make_mesh(shapes::translated(disc, offset)), 500, output);
    CHECK((report.self_intersections > 0) == intersects_itself(output));
    CHECK(report.missed_guarantees().empty());
  }
}

TEST_CASE("the way back from the grid is exact")
{
  const Soup sphere = shapes::icosphere(3);
  for (const double size : {1e-20, 1., 1e15})
    for (const double offset : {0., 1e3, 1e9}) {
      Surface surface = shapes::make_surface(
          shapes::translated(shapes::scaled(sphere, size), {offset * size, size / 3, 0}));
      const bool floats_can = offset < 1e9;
      for (const auto type : {Coordinates::double_precision, Coordinates::single_precision}) {
        CAPTURE(size);
        CAPTURE(offset);
        Remeshing_options o;
        o.number_of_samples = 1000;
        o.coordinates = type;
        if (type == Coordinates::single_precision && !floats_can) {
          CHECK_THROWS_AS(set_output_grid(surface, o), Invalid_input_error);
          continue;
        }
        set_output_grid(surface, o);
        const Normalization& map = surface.normalization;
        for (const Vec3d& p : surface.points) {
          const Vec3d q = map.snapped(p), out = map.to_outside(q);
          CHECK(length(q - p) <= map.grid);
          CHECK(map.to_inside(out) == q);
          if (type == Coordinates::single_precision)
            CHECK(Vec3d{double(float(out.x)), double(float(out.y)), double(float(out.z))} == out);
        }
      }
    }
}

TEST_CASE("coordinates that cannot hold the mesh are refused")
{
  const Mesh far = make_mesh(shapes::translated(shapes::icosphere(3), {1e15, 0, 0}));
  Mesh output;
  std::string message;
  try {
    CGAL::power_rtf_remeshing(far, 1000, output);
  } catch (const Invalid_input_error& e) {
    message = e.what();
  }
  CHECK(message.find("cannot hold 1000 samples") != std::string::npos);
  CHECK(output.number_of_vertices() == 0);

  Float_mesh floats;
  CHECK_THROWS_AS(CGAL::power_rtf_remeshing(make_mesh(shapes::scaled(shapes::icosphere(3), 1e39)),
                                            1000, floats),
                  Invalid_input_error);
}
