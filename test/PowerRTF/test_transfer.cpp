// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the vertices and faces of a result come from, and what that carries over.
#include "mesh_of_shape.h"
#include "shapes.h"

#include <CGAL/Polyhedron_3.h>
#include <CGAL/power_rtf_remeshing.h>

#include <boost/property_map/function_property_map.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace CGAL::PowerRTF;
using shapes::Mesh;
using shapes::Soup;
namespace params = CGAL::PowerRTF::parameters;

namespace {

using Place = Mesh_source<Mesh>;
using Vertex = Mesh::Vertex_index;
using Face = Mesh::Face_index;

/// A result with the sources of its elements.
struct Traced {
  Mesh mesh;
  Mesh::Property_map<Vertex, Place> vertices;
  Mesh::Property_map<Face, Place> faces;
  Remeshing_report report;
};

Traced traced(const Mesh& input, std::size_t n, const Remeshing_options& options = {})
{
  Traced result;
  result.vertices = result.mesh.add_property_map<Vertex, Place>("v:source").first;
  result.faces = result.mesh.add_property_map<Face, Place>("f:source").first;
  result.report = CGAL::power_rtf_remeshing(
      input, n, result.mesh, params::remeshing_options(options),
      params::vertex_source_map(result.vertices).face_source_map(result.faces));
  return result;
}

Vec3d at(const Mesh& mesh, Vertex v) { return internal::to_vec3d(mesh.point(v)); }

Vec3d point_of(const Mesh& mesh, const Place& place)
{
  Vec3d p{0, 0, 0};
  for (int i = 0; i < 3; ++i) p += at(mesh, place.vertices[i]) * place.weights[i];
  return p;
}

bool has_corners_of_its_face(const Mesh& mesh, const Place& place)
{
  std::set<Vertex> corners;
  for (const Vertex v : CGAL::vertices_around_face(mesh.halfedge(place.face), mesh))
    corners.insert(v);
  return std::all_of(place.vertices.begin(), place.vertices.end(),
                     [&](Vertex v) { return corners.count(v) == 1; });
}

Vec3d center(const Mesh& mesh, Face f)
{
  Vec3d sum{0, 0, 0};
  for (const Vertex v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) sum += at(mesh, v);
  return sum * (1. / 3);
}

/// The largest distance of a vertex from its source, and of a face's center from its own.
std::pair<double, double> farthest(const Mesh& input, const Traced& t)
{
  double vertices = 0, faces = 0;
  for (const Vertex v : t.mesh.vertices())
    vertices = (std::max)(vertices, length(at(t.mesh, v) - point_of(input, t.vertices[v])));
  for (const Face f : t.mesh.faces())
    faces = (std::max)(faces, length(center(t.mesh, f) - point_of(input, t.faces[f])));
  return {vertices, faces};
}

void check_places(const Mesh& input, const Traced& t)
{
  for (const Vertex v : t.mesh.vertices()) {
    const Place place = t.vertices[v];
    CHECK(has_corners_of_its_face(input, place));
    CHECK(*std::min_element(place.weights.begin(), place.weights.end()) >= 0);
    CHECK(place.weights[0] + place.weights[1] + place.weights[2] == doctest::Approx(1));
  }
  for (const Face f : t.mesh.faces()) CHECK(has_corners_of_its_face(input, t.faces[f]));
}

/// A cube of six squares; `shift`: where the numbers of its faces begin.
Mesh cube_of_squares(int shift)
{
  const std::vector<Vec3d> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::vector<std::vector<std::size_t>> faces = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                 {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  std::rotate(faces.begin(), faces.begin() + shift, faces.end());
  return shapes::make_mesh(points, faces);
}

} // namespace

TEST_CASE("vertices lie on their sources, unless the improvement moves them")
{
  const Mesh input = shapes::make_mesh(shapes::icosphere(4));
  Remeshing_options options;
  options.improvement = Improvement::no;
  const Traced exact = traced(input, 500, options);
  CHECK(farthest(input, exact).first < 1e-14);
  check_places(input, exact);

  const Traced improved = traced(input, 500);
  const double distance = improved.report.absolute(improved.report.distance.max);
  CHECK(farthest(input, improved).first <= distance * (1 + 1e-9));
  CHECK(farthest(input, improved).second <= distance * (1 + 1e-9));
  check_places(input, improved);
}

TEST_CASE("sources have the user's numbers, also on surfaces that are put into another order")
{
  const Mesh input = shapes::make_mesh(shapes::icosphere(6)); // 81920 facets: sorted in space
  REQUIRE(num_faces(input) > 65536);
  const Traced t = traced(input, 300);
  check_places(input, t);
  CHECK(farthest(input, t).first <= t.report.absolute(t.report.distance.max) * (1 + 1e-9));
}

TEST_CASE("a wrap faces outward, whichever way the facets of its input do")
{
  const double thickness = 0.02;
  shapes::Soup plate = shapes::box(3);
  for (Vec3d& p : plate.points) p.z *= thickness;
  for (const bool is_turned : {false, true}) {
    if (is_turned)
      for (Triangle& t : plate.triangles) std::swap(t[0], t[1]);
    const Mesh input = shapes::make_mesh(plate);
    Remeshing_options options;
    options.intersections = Intersections::wrap;
    options.wrap_radius = 0.06;
    // the wrap is outside: from there the other side is farther away
    CHECK(farthest(input, traced(input, 400, options)).first < thickness);
  }
}

TEST_CASE("faces with more than three sides are sources, and give their labels to all on them")
{
  for (int shift = 0; shift < 6; ++shift) {
    const Mesh input = cube_of_squares(shift);
    Traced t = traced(input, 200);
    check_places(input, t);
    CHECK(farthest(input, t).second < 1e-12);
    auto labels = t.mesh.add_property_map<Face, int>("f:label").first;
    transfer_face_values(t.mesh, t.faces,
                         boost::make_function_property_map<Face>([](Face f) { return int(f); }),
                         labels);
    std::vector<double> areas(6, 0);
    for (const Face f : t.mesh.faces()) {
      std::vector<Vec3d> c;
      for (const Vertex v : CGAL::vertices_around_face(t.mesh.halfedge(f), t.mesh))
        c.push_back(at(t.mesh, v));
      areas[labels[f]] += length(cross(c[1] - c[0], c[2] - c[0])) / 2;
    }
    for (const double area : areas) CHECK(area == doctest::Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("linear functions on flat faces come over as they are, vectors and arrays, too")
{
  const Mesh input = cube_of_squares(0);
  Traced t = traced(input, 200);
  using Vector = shapes::Kernel::Vector_3;
  const auto vector_of = [](const Vec3d& p) { return Vector(p.x + 2 * p.y, p.z, 1); };
  auto vectors = t.mesh.add_property_map<Vertex, Vector>("v:vector").first;
  transfer_vertex_values(
      t.mesh, t.vertices,
      boost::make_function_property_map<Vertex>([&](Vertex v) { return vector_of(at(input, v)); }),
      vectors);
  auto arrays = t.mesh.add_property_map<Vertex, std::array<float, 2>>("v:array").first;
  transfer_vertex_values(t.mesh, t.vertices,
                         boost::make_function_property_map<Vertex>([&](Vertex v) {
                           const Vec3d p = at(input, v);
                           return std::array<float, 2>{float(p.x), float(p.z)};
                         }),
                         arrays);
  for (const Vertex v : t.mesh.vertices()) {
    const Vec3d p = at(t.mesh, v);
    CHECK((vectors[v] - vector_of(p)).squared_length() < 1e-24);
    CHECK(arrays[v][0] == doctest::Approx(p.x).epsilon(1e-6));
    CHECK(arrays[v][1] == doctest::Approx(p.z).epsilon(1e-6));
  }
}

TEST_CASE("the error of a smooth function is of second order in the input's edges")
{
  const auto value = [](const Vec3d& p) { return std::sin(2 * p.x) + p.y * p.z; };
  const auto error = [&](int subdivisions) {
    const Mesh input = shapes::make_mesh(shapes::icosphere(subdivisions));
    Remeshing_options options;
    options.improvement = Improvement::no;
    Traced t = traced(input, 400, options);
    auto values = t.mesh.add_property_map<Vertex, double>("v:value").first;
    transfer_vertex_values(
        t.mesh, t.vertices,
        boost::make_function_property_map<Vertex>([&](Vertex v) { return value(at(input, v)); }),
        values);
    double largest = 0;
    for (const Vertex v : t.mesh.vertices())
      largest = (std::max)(largest, std::abs(values[v] - value(normalized(at(t.mesh, v)))));
    return largest;
  };
  const double coarse = error(3), fine = error(5); // edges of a quarter of the length
  CHECK(fine < coarse / 12);
  CHECK(fine > 0);
}

TEST_CASE("the other side of a thin plate is no source, nor is it where facets have been turned")
{
  // 40 times as wide as thick; vertices are farther from each other than the sides
  const double thickness = 0.025;
  Soup soup = shapes::box(10);
  for (Vec3d& p : soup.points) p = {p.x / 2, p.y / 2, thickness / 2 * p.z};
  const Mesh input = shapes::make_mesh(soup);
  const Traced t = traced(input, 400);
  for (const Face f : t.mesh.faces()) {
    const double z = center(t.mesh, f).z;
    if (std::abs(z) > 0.45 * thickness) CHECK(point_of(input, t.faces[f]).z * z > 0);
  }

  Polygon_soup turned = internal::soup_of_ranges(soup.points, soup.triangles);
  for (std::size_t f = 0; f < soup.triangles.size(); f += 3)
    std::swap(turned.corners[3 * f], turned.corners[3 * f + 1]);
  Remeshing_report report;
  const Surface surface = prepare_surface(Polygon_soup(turned), Surface_fields(), {}, report);
  CHECK(report.repairs.reoriented_facets > 0);
  const Sources sources =
      find_sources(turned, surface.normalization, false, surface.points, surface.triangles);
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    const Source& s = sources.vertices[v];
    Vec3d p{0, 0, 0};
    for (int i = 0; i < 3; ++i) p += turned.points[s.vertices[i]] * s.weights[i];
    CHECK(length(p - surface.normalization.to_outside(surface.points[v])) < 1e-14);
  }
}

TEST_CASE("colors are interpolated and rounded, labels at vertices are not mixed")
{
  using CGAL::IO::Color;
  const std::array<double, 3> weights{0.5, 0.3, 0.2};
  CHECK(interpolated(Color(255, 0, 10), Color(0, 255, 10), Color(0, 0, 10), weights) ==
        Color(128, 77, 10));
  CHECK(interpolated(7, 100, 1000, weights) == 7);
  CHECK(interpolated(7, 100, 1000, {0.2, 0.5, 0.3}) == 100);
  CHECK(interpolated(7, 100, 1000, {0.2, 0.3, 0.5}) == 1000);
  CHECK(interpolated(true, false, false, weights));
  CHECK(interpolated(1.f, 2.f, 3.f, weights) == doctest::Approx(1.7));
}

TEST_CASE("the output may be of another type than the input")
{
  using Polyhedron = CGAL::Polyhedron_3<shapes::Kernel>;
  const Mesh input = shapes::make_mesh(shapes::icosphere(3));
  Polyhedron output;
  std::map<boost::graph_traits<Polyhedron>::vertex_descriptor, Place> sources;
  CGAL::power_rtf_remeshing(input, 200, output, params::default_values(),
                            params::vertex_source_map(boost::make_assoc_property_map(sources)));
  CHECK(sources.size() == 200);
  for (const auto& [v, place] : sources)
    CHECK(length(internal::to_vec3d(v->point()) - point_of(input, place)) < 0.02);
}

TEST_CASE("values of corners jump at constrained edges only, as texture coordinates do")
{
  using Halfedge = Mesh::Halfedge_index;
  const auto mesh_with_values = [](int around, auto& values, auto& is_seam) {
    Mesh mesh = shapes::make_mesh(shapes::open_cylinder(around, around / 4, 1, 2));
    values = mesh.add_property_map<Halfedge, double>("h:u").first;
    is_seam = mesh.add_property_map<Mesh::Edge_index, bool>("e:seam", false).first;
    for (const Face f : mesh.faces()) { // angles, from 0 at y = 0 up
      const bool is_below = center(mesh, f).y < 0;
      for (const Halfedge h : CGAL::halfedges_around_face(mesh.halfedge(f), mesh)) {
        const Vec3d p = at(mesh, mesh.target(h));
        const double angle = std::abs(p.y) < 1e-9 && p.x > 0 ? 0 : std::atan2(p.y, p.x);
        values[h] = angle + (is_below && angle <= 0 ? 2 * shapes::pi : 0);
      }
    }
    for (const auto e : mesh.edges()) {
      const Vec3d p = at(mesh, mesh.vertex(e, 0)), q = at(mesh, mesh.vertex(e, 1));
      is_seam[e] = p.x > 0 && q.x > 0 && std::abs(p.y) + std::abs(q.y) < 1e-9;
    }
    return mesh;
  };
  const auto error = [&](int around, std::size_t n) {
    Mesh::Property_map<Halfedge, double> values;
    Mesh::Property_map<Mesh::Edge_index, bool> is_seam;
    const Mesh input = mesh_with_values(around, values, is_seam);
    Mesh output;
    auto sources = output.add_property_map<Halfedge, Place>("h:source").first;
    CGAL::power_rtf_remeshing(input, n, output, params::edge_is_constrained_map(is_seam),
                              params::corner_source_map(sources));
    auto new_values = output.add_property_map<Halfedge, double>("h:u").first;
    transfer_corner_values(output, sources, input, values, new_values);
    double largest = 0;
    std::size_t jumps = 0;
    for (const Face f : output.faces())
      for (const Halfedge h : CGAL::halfedges_around_face(output.halfedge(f), output)) {
        const Vec3d p = at(output, output.target(h));
        double wanted = std::atan2(p.y, p.x);
        if (wanted < -1e-9 || (wanted < 1e-9 && center(output, f).y < 0)) wanted += 2 * shapes::pi;
        jumps += wanted > 6.28;
        largest = (std::max)(largest, std::abs(new_values[h] - wanted));
      }
    CHECK(jumps > 3);
    return largest;
  };
  const double coarse = error(24, 300), fine = error(96, 4800);
  CHECK(coarse < 0.1);
  CHECK(fine < coarse / 8);
}

TEST_CASE("the sources are the same for any number of threads")
{
  const Soup soup = shapes::icosphere(4);
  const Polygon_soup input = internal::soup_of_ranges(soup.points, soup.triangles);
  const Soup mesh = shapes::icosphere(3);
  const auto sources = [&](internal::Concurrency concurrency) {
    return find_sources(input, {}, true, mesh.points, mesh.triangles, concurrency);
  };
  const Sources a = sources(CGAL::Sequential_tag()), b = sources(CGAL::Parallel_if_available_tag());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    CHECK(a.vertices[v].face == b.vertices[v].face);
    CHECK(a.vertices[v].weights == b.vertices[v].weights);
  }
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) CHECK(a.faces[f].face == b.faces[f].face);
}
