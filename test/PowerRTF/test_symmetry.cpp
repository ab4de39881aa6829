// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Results that are their own mirror images.
#include "cad_shapes.h"
#include "mesh_of_shape.h"
#include "mirror_image.h"
#include "odd_shapes.h"
#include "remeshed_shape.h"

#include <CGAL/PowerRTF/cells/mirror_images.h>
#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/features/half_surface.h>
#include <CGAL/PowerRTF/transfer/Mesh_source.h>
#include <CGAL/power_rtf_remeshing.h>

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace remeshed_shape;
using mirror_image::differences;
using mirror_image::vertices_on;
using shapes::make_mesh;
using shapes::Mesh;
namespace params = CGAL::PowerRTF::parameters;

Result remeshed_shape::remesh(const Soup& soup, std::size_t n, const Remeshing_options& options)
{
  Mesh output;
  const Remeshing_report report =
      CGAL::power_rtf_remeshing(make_mesh(soup), n, output, params::remeshing_options(options));
  CHECK(output.is_valid());
  return {shapes::soup_of(output), report};
}

namespace {

Remeshing_options symmetric(Symmetry plane)
{
  Remeshing_options options;
  options.symmetry = plane;
  return options;
}

/// Remeshes and checks what always holds.
Result remesh_symmetric(const Soup& soup, std::size_t n, const Remeshing_options& options)
{
  const Result result = remesh(soup, n, options);
  check_guarantees(result.report);
  const Symmetry_report& symmetry = result.report.symmetry;
  REQUIRE(symmetry.axis.size() == 1);
  const int axis = symmetry.axis[0] - 'x';
  CHECK(result.report.topology.vertices == n);
  CHECK(differences(result.soup, axis, symmetry.at) == 0);
  CHECK(vertices_on(result.soup, axis, symmetry.at) == symmetry.vertices);
  return result;
}

/// Why a soup is refused.
std::string refusal(const Soup& soup, std::size_t n, Symmetry plane)
{
  try {
    remesh(soup, n, symmetric(plane));
  } catch (const Invalid_input_error& e) {
    return e.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/// A ball with a bump at one side.
Soup dented_ball(double height)
{
  return shapes::mapped(shapes::icosphere(4), [=](const Vec3d& p) {
    return p.x > 0.9 ? Vec3d{p.x + height, p.y, p.z} : p;
  });
}

/// A house with a ridge in x = 0.
Soup house()
{
  Soup s = shapes::box(4);
  return shapes::mapped(s, [](const Vec3d& p) {
    return p.z > 0 ? Vec3d{p.x, p.y, p.z * (1.8 - std::abs(p.x))} : p;
  });
}

} // namespace

TEST_CASE("the result is its own mirror image, with exactly n vertices, whatever n and the axis")
{
  for (const std::size_t n : {200, 301, 1000})
    for (const Symmetry plane : {Symmetry::x, Symmetry::y, Symmetry::z}) {
      CAPTURE(n);
      CAPTURE(name_of(plane));
      const Result result = remesh_symmetric(shapes::torus(40, 20, 1, 0.4), n, symmetric(plane));
      CHECK(result.report.symmetry.axis == name_of(plane));
      CHECK(result.report.symmetry.vertices % 2 == n % 2);
      CHECK(result.report.quality.q_min > 0.55);
    }
}

TEST_CASE("surfaces of all kinds stay what they are")
{
  const Soup pair = shapes::two_spheres(3);
  const std::vector<std::pair<const char*, Soup>> soups = {
      {"creases across the plane", shapes::box(3)},
      {"a crease in the plane", house()},
      {"parts of a machine", shapes::gear(0.5)},
      {"a plate with holes on the plane", shapes::bracket(6, 8)},
      {"borders across the plane", shapes::open_cylinder(40, 10, 1, 2)},
      {"a border around all", shapes::plane_patch(5, 5)},
      {"a border that is all on one side of it, and its image",
       shapes::joined(shapes::open_cylinder(30, 5, 1, 1),
                      shapes::translated(shapes::open_cylinder(30, 5, 1, 1), {3, 0, 0}))},
      {"components, one on each side", pair}};
  for (const auto& [what, soup] : soups) {
    CAPTURE(what);
    const Result result = remesh_symmetric(soup, 1200, symmetric(Symmetry::automatic));
    CHECK(result.report.symmetry.deviation < 1e-6);
  }
}

TEST_CASE("the plane's curve is a line of vertices")
{
  const Result result = remesh_symmetric(shapes::icosphere(4), 1500, symmetric(Symmetry::z));
  std::size_t edges = 0;
  const auto is_on = [&](int v) { return result.soup.points[v].z == result.report.symmetry.at; };
  for (const Triangle& t : result.soup.triangles)
    for (int i = 0; i < 3; ++i) edges += is_on(t[i]) && is_on(t[(i + 1) % 3]);
  CHECK(result.report.symmetry.vertices > 40);
  CHECK(edges == 2 * result.report.symmetry.vertices); // a closed line, from both sides
}

TEST_CASE("a ridge in the plane stays one, and other edges there are none")
{
  const Result ridge = remesh_symmetric(house(), 800, symmetric(Symmetry::x));
  const Result box = remesh_symmetric(shapes::box(4), 800, symmetric(Symmetry::x));
  CHECK(ridge.report.feature_edges > box.report.feature_edges);
  const Result ball = remesh_symmetric(shapes::icosphere(3), 800, symmetric(Symmetry::x));
  CHECK(ball.report.feature_edges == 0);
}

TEST_CASE("the plane is that of the input, wherever it is")
{
  const Soup torus = shapes::translated(shapes::torus(40, 20, 1, 0.4), {0.3, -7, 1e3});
  const Result result = remesh_symmetric(torus, 500, symmetric(Symmetry::z));
  CHECK(result.report.symmetry.at == doctest::Approx(1e3).epsilon(1e-12));
  // An ellipsoid that is turned about y has one plane across an axis.
  const Soup ellipsoid = shapes::rotated(shapes::ellipsoid(1, 0.6, 0.4, 4), 0.4, {0, 1, 0});
  CHECK(remesh_symmetric(ellipsoid, 500, symmetric(Symmetry::automatic)).report.symmetry.axis ==
        "y");
  const Soup upright = shapes::mapped(shapes::plane_patch(5, 5), [](const Vec3d& p) {
    return Vec3d{0, p.x, p.y};
  });
  CHECK(remesh_symmetric(upright, 500, symmetric(Symmetry::automatic)).report.symmetry.axis ==
        "y"); // it cannot be halved by x = 0, which it lies in
}

TEST_CASE("an input that is nearly symmetric becomes symmetric, and the report says how nearly")
{
  const Soup ball = dented_ball(0.03);
  const Result result = remesh_symmetric(ball, 600, symmetric(Symmetry::x));
  CHECK(result.report.symmetry.deviation > 0.01);
  CHECK(result.report.absolute(result.report.distance.max) > 0.01);
}

TEST_CASE("an input that is not is refused, with where and how far")
{
  const Soup ball = dented_ball(0.3);
  const std::string about_x = refusal(ball, 600, Symmetry::x);
  CAPTURE(about_x);
  CHECK(has(about_x, "not symmetric about the plane x = "));
  CHECK(has(about_x, "away from it, but may be no more than"));
  CHECK(refusal(ball, 600, Symmetry::y) == "");
  Soup open = shapes::box(1); // the image of the hole is within a facet, far from all vertices
  open.triangles.pop_back();
  CHECK(has(refusal(open, 600, Symmetry::automatic), "the mirror image of its point"));
  const Soup turned = shapes::rotated(shapes::box(4), 0.5);
  CHECK(has(refusal(turned, 600, Symmetry::automatic), "any plane across an axis"));
}

TEST_CASE("what cannot be halved is refused")
{
  CHECK(has(refusal(shapes::plane_patch(4, 4), 100, Symmetry::z), "lies in the plane"));
  const Soup wavy = shapes::mapped(shapes::plane_patch(20, 20), [](const Vec3d& p) {
    return Vec3d{p.x, p.y, 0.01 * std::sin(9 * p.x)};
  });
  CHECK(has(refusal(wavy, 400, Symmetry::z), "lies in the plane"));
  const Soup sheet =
      shapes::joined(shapes::box(4), shapes::translated(shapes::plane_patch(4, 4), {2, 0, 0}));
  CHECK(has(refusal(sheet, 400, Symmetry::z), "a part of it lies in the plane"));
  CHECK(has(refusal(shapes::two_spheres(3), 801, Symmetry::x), "has to be even"));
  const Soup box = shapes::box(4);
  Mesh mesh = make_mesh(box);
  const std::vector<Mesh::Face_index> faces(mesh.faces().begin(),
                                            std::next(mesh.faces().begin(), 40));
  CHECK_THROWS_AS(CGAL::power_rtf_remeshing(faces, mesh, 100, params::symmetry(Symmetry::x)),
                  const Invalid_input_error&);
}

TEST_CASE("a number of vertices that is found may have to be even")
{
  const Mesh spheres = make_mesh(shapes::two_spheres(3));
  Mesh output;
  std::size_t odd = 0;
  for (int k = 0; k < 5; ++k) {
    const Resolution resolution = Resolution::edge_length(0.2 + 0.003 * k);
    odd += CGAL::power_rtf_remeshing(spheres, resolution, output).samples_asked % 2;
    const Remeshing_report report =
        CGAL::power_rtf_remeshing(spheres, resolution, output, params::symmetry(Symmetry::x));
    check_guarantees(report);
    CHECK(report.samples_asked % 2 == 0);
  }
  CHECK(odd > 0);
}

TEST_CASE("the result is the same on one thread, and that of a scaled input is scaled")
{
  const Soup soup = shapes::gear(0.5);
  const Remeshing_options options = symmetric(Symmetry::automatic);
  const Result result = remesh_symmetric(soup, 900, options);
  Mesh sequential;
  CGAL::power_rtf_remeshing<CGAL::Sequential_tag>(make_mesh(soup), 900, sequential,
                                                  params::remeshing_options(options));
  CHECK(are_equal(shapes::soup_of(sequential), result.soup));
  const Result large = remesh_symmetric(shapes::scaled(soup, 1024), 900, options);
  CHECK(are_equal(large.soup, shapes::scaled(result.soup, 1024)));
}

TEST_CASE("the other presets and ways to triangulate keep it, too")
{
  for (const Preset preset : {Preset::fast, Preset::paper}) {
    Remeshing_options options = Remeshing_options::of(preset);
    options.symmetry = Symmetry::x;
    remesh_symmetric(torus(), 400, options);
  }
  for (const Extraction_method method :
       {Extraction_method::insertion, Extraction_method::restricted_delaunay}) {
    Remeshing_options options = symmetric(Symmetry::x);
    options.extraction = method;
    remesh_symmetric(torus(), 400, options);
  }
  Remeshing_options options = symmetric(Symmetry::x);
  options.coordinates = Coordinates::single_precision;
  for (const Vec3d& p : remesh_symmetric(torus(), 400, options).soup.points)
    for (const double x : {p.x, p.y, p.z}) CHECK(double(float(x)) == x);
}

TEST_CASE("vertices on either side come from their own side, and patches are those of the whole")
{
  const Mesh input = make_mesh(house());
  Mesh output;
  auto sources = output.add_property_map<Mesh::Vertex_index, Mesh_source<Mesh>>("v:source").first;
  auto patches = output.add_property_map<Mesh::Face_index, int>("f:patch", -1).first;
  const Remeshing_report report =
      CGAL::power_rtf_remeshing(input, 600, output, params::symmetry(Symmetry::x),
                                params::vertex_source_map(sources).face_patch_map(patches));
  check_guarantees(report);
  for (const auto v : output.vertices()) {
    double x = 0;
    for (int i = 0; i < 3; ++i)
      x += sources[v].weights[i] * input.point(sources[v].vertices[i]).x();
    CHECK(x == doctest::Approx(output.point(v).x()).epsilon(0.02));
  }
  std::set<int> numbers;
  for (const auto f : output.faces()) numbers.insert(patches[f]);
  CHECK(numbers.size() == 7); // the roof is two, and each wall and the floor one
}

TEST_CASE("holes and parts smaller than the spacing stay what they are across the plane")
{
  const Soup ring = shapes::mapped(shapes::open_cylinder(40, 10, 1, 1), [](const Vec3d& p) {
    const double r = 0.05 + 0.95 * p.z;
    return Vec3d{p.x * r, p.y * r, 0};
  });
  for (const std::size_t n : {8, 9, 10, 12, 15, 20, 200}) {
    CAPTURE(n);
    remesh_symmetric(ring, n, symmetric(Symmetry::y));
  }
  for (const std::size_t n : {60, 100, 150, 301}) {
    CAPTURE(n);
    for (const Symmetry plane : {Symmetry::x, Symmetry::y}) {
      remesh_symmetric(shapes::ellipsoid(0.12, 0.12, 1, 4), n, symmetric(plane));
      remesh_symmetric(shapes::ball_with_finger(0.1), n, symmetric(plane));
    }
  }
}

TEST_CASE("the curves at the mirror have as many samples as are wanted, more or fewer than fit")
{
  const Soup patch = shapes::plane_patch(6, 6);
  const Soup two = shapes::joined(patch, shapes::translated(patch, {20, 0, 0}));
  const Surface whole = shapes::make_surface(two);
  const Surface half = half_surface(whole, {1, (whole.points[0].y + whole.points.back().y) / 2});
  const std::vector<Feature_curve> curves = feature_curves(half, 0);
  const double spacing = std::sqrt(whole.area / 100);
  for (const std::size_t wanted : {6, 7, 12, 30}) {
    CAPTURE(wanted);
    internal::Curve_sampler sampler(half, curves);
    sampler.set_count_at_mirror(wanted, spacing);
    std::size_t found = 0;
    for (const Edge_place& place : sampler.run(spacing).places)
      found +=
          half.is_at_mirror(half.points[place.from]) && half.is_at_mirror(half.points[place.to]);
    CHECK(found == wanted);
  }
}

TEST_CASE("within a half no edge joins vertices at the mirror, nor does a collapse make one")
{
  using Vertex = internal::Working_mesh::Vertex;
  const std::vector<Vec3d> points = {
      {0, 0, 0}, {1, 0.5, 0}, {0, 1, 0}, {-1, 0.5, 0}, {0.1, 0.5, 0}};
  internal::Working_mesh two(points, {{0, 1, 3}, {1, 2, 3}}, CGAL::Sequential_tag());
  const auto diagonal = two.mesh.edge(two.mesh.halfedge(Vertex(1), Vertex(3)));
  CHECK(two.is_flippable(diagonal));
  two.mirror = Mirror_plane{0, 0};
  CHECK_FALSE(two.is_flippable(diagonal));

  internal::Working_mesh four(points, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
                              CGAL::Sequential_tag());
  const auto joins_twice = [&](int from, int to) {
    return four.joins_twice(four.mesh.halfedge(Vertex(from), Vertex(to)));
  };
  CHECK_FALSE(joins_twice(4, 0));
  four.mirror = Mirror_plane{0, 0};
  CHECK(joins_twice(4, 0));
  CHECK_FALSE(joins_twice(4, 1));
}

TEST_CASE("a half ends in the plane exactly, and has half the area")
{
  for (const double at : {0., 0.1, 1e-9}) {
    CAPTURE(at);
    const Surface whole = shapes::make_surface(shapes::torus(20, 12, 1, 0.3));
    const Surface half = half_surface(whole, {0, at * whole.normalization.scale});
    CHECK(half.adjacency.border_edges > 0);
    for (int h = 0; h < int(half.adjacency.opposite.size()); ++h)
      if (half.adjacency.opposite[h] == Facet_adjacency::none)
        CHECK(half.mirror->has(half.points[halfedge_source(half.triangles, h)]));
    for (const Vec3d& p : half.points) CHECK(half.mirror->height(p) >= 0);
    CHECK(half.area == doctest::Approx(whole.area / 2).epsilon(at == 0.1 ? 0.2 : 1e-3));
  }
}

TEST_CASE("the image of a cell has its sides in the other order, with the same neighbors")
{
  Cell_polygon cell;
  cell.vertices = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  cell.neighbors = {10, 11, 12, 13}; // below, to the right, above, to the left
  const std::vector<Cell_polygon> cells = with_images({cell}, Mirror_plane{0, 0.5});
  REQUIRE(cells.size() == 2);
  CHECK(cells[1].vertices == std::vector<Vec3d>{{0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {0, 0, 0}});
  CHECK(cells[1].neighbors == std::vector<int>{12, 11, 10, 13});
  CHECK(with_images({cell}, std::nullopt).size() == 1);

  Samples samples;
  samples.points = {{0.5, 3, 0}, {1, 0, 0}, {0.5, 0, 0}};
  samples.normals.assign(3, {1, 0, 0});
  samples.facets.assign(3, 0);
  samples.density.assign(3, 1);
  samples.weights.assign(3, 0);
  const Samples all = with_images(samples, 2, Mirror_plane{0, 0.5});
  CHECK(all.size() == 5); // the last one is on a crease in the plane
  CHECK(all.points[4] == Vec3d{0, 0, 0});
  CHECK(all.normals[4] == Vec3d{-1, 0, 0});
}
