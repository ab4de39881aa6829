// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values of faces: each new face has that which the largest share of it comes from.
#include "../mesh_of_shape.h"
#include "../shapes.h"

#include <CGAL/PowerRTF/transfer/point_of_face.h>
#include <CGAL/power_rtf_remeshing.h>

#include <boost/property_map/function_property_map.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

using namespace CGAL::PowerRTF;
using shapes::Mesh;
namespace params = CGAL::PowerRTF::parameters;

namespace {

using Face = Mesh::Face_index;
using Corners = std::array<Vec3d, 3>;

Corners corners_of(const Mesh& mesh, Face f)
{
  Corners corners;
  int k = 0;
  for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
    corners[k++] = internal::to_vec3d(mesh.point(v));
  return corners;
}

double area(const std::vector<Vec3d>& polygon) // in the plane z = 0
{
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum / 2;
}

/// The area of the part of triangle `t` that is in triangle `u`, both counter-clockwise in the
/// plane.
double common_area(const Corners& t, const Corners& u)
{
  std::vector<Vec3d> polygon(t.begin(), t.end());
  for (int side = 0; side < 3; ++side) {
    const Vec3d &a = u[side], &b = u[(side + 1) % 3];
    const auto inside = [&](const Vec3d& p) {
      return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    };
    std::vector<Vec3d> left;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      const double of_p = inside(p), of_q = inside(q);
      if (of_p >= 0) left.push_back(p);
      if ((of_p < 0) != (of_q < 0)) left.push_back(p + (q - p) * (of_p / (of_p - of_q)));
    }
    polygon = left;
  }
  return area(polygon);
}

/// A result with the sources of its faces.
struct Traced {
  Mesh mesh;
  Mesh::Property_map<Face, Mesh_source<Mesh>> faces;

  template <class Parameters>
  Traced(const Mesh& input, std::size_t n, const Parameters& np)
  {
    faces = mesh.add_property_map<Face, Mesh_source<Mesh>>("f:source").first;
    CGAL::power_rtf_remeshing(input, n, mesh, np, params::face_source_map(faces));
  }
};

} // namespace

TEST_CASE("the first of the values that are there most often")
{
  const auto most = [](const std::vector<int>& values) {
    return most_frequent(int(values.size()), [&](int k) { return values[k]; });
  };
  CHECK(most({5}) == 0);
  CHECK(most({5, 6}) == 0);
  CHECK(most({5, 6, 6}) == 1);
  CHECK(most({5, 6, 6, 5}) == 0);
  CHECK(most({1, 2, 3, 4, 4}) == 3);
  CHECK(most({1, 1, 1, 2, 2, 2, 2}) == 3);
}

TEST_CASE("sixteen points are the centers of equal parts of a face, the first its own")
{
  const Vec3d a{0, 0, 0}, b{12, 0, 0}, c{0, 12, 0};
  Vec3d sum{0, 0, 0};
  std::vector<Vec3d> points;
  for (int k = 0; k < points_of_face; ++k) {
    points.push_back(internal::point_of_face(k, a, b, c));
    sum += points.back();
  }
  CHECK(points[0] == Vec3d{4, 4, 0});
  CHECK(length(sum * (1. / points_of_face) - points[0]) < 1e-14);
  for (std::size_t k = 0; k < points.size(); ++k) {
    CHECK(std::min({points[k].x, points[k].y, 12 - points[k].x - points[k].y}) >= 1);
    for (std::size_t l = 0; l < k; ++l) CHECK(length(points[k] - points[l]) > 1.4);
  }
}

TEST_CASE("faces have the value of the largest share, not that at their centers")
{
  const Mesh input = shapes::make_mesh(shapes::plane_patch(40, 40));
  std::mt19937 random(1);
  std::vector<int> value;
  for (std::size_t f = 0; f < input.number_of_faces(); ++f) value.push_back(random() % 10 < 3);
  const auto values = boost::make_function_property_map<Face>([&](Face f) { return value[f]; });
  Remeshing_options options;
  options.density = Density::uniform;
  int faces = 0, wrong = 0, wrong_at_center = 0;
  for (options.random_seed = 0; options.random_seed < 4; ++options.random_seed) {
    CAPTURE(options.random_seed);
    Traced t(input, 150, params::remeshing_options(options)); // a face lies on some 12 of the input
    auto result = t.mesh.add_property_map<Face, int>("f:value").first;
    transfer_face_values(t.mesh, t.faces, values, result);
    faces += int(t.mesh.number_of_faces());
    for (const Face f : t.mesh.faces()) {
      REQUIRE(t.faces[f].faces.size() == std::size_t(points_of_face));
      CHECK(t.faces[f].faces[0] == t.faces[f].face);
      const Corners corners = corners_of(t.mesh, f);
      std::array<double, 2> areas{0, 0};
      for (const Face g : input.faces())
        areas[value[g]] += common_area(corners_of(input, g), corners);
      const double whole = areas[0] + areas[1];
      CHECK(whole == doctest::Approx(area({corners.begin(), corners.end()})));
      CHECK(areas[result[f]] > 0.3 * whole); // sixteen points see shares a little wrong
      wrong += areas[result[f]] < areas[1 - result[f]];
      wrong_at_center += areas[value[t.faces[f].face]] < areas[1 - value[t.faces[f].face]];
    }
  }
  MESSAGE(wrong << " and " << wrong_at_center << " of " << faces << " have less than half");
  CHECK(wrong < faces / 8);
  CHECK(wrong_at_center > faces / 4);
}

TEST_CASE("sources that name one face only give its value")
{
  const Mesh mesh = shapes::make_mesh(shapes::tetrahedron());
  const auto sources = boost::make_function_property_map<Face>([](Face f) {
    Mesh_source<Mesh> source;
    source.face = Face((f + 1) % 4);
    return source;
  });
  const auto values = boost::make_function_property_map<Face>([](Face f) { return 10 * int(f); });
  std::map<Face, int> result;
  transfer_face_values(mesh, sources, values, boost::make_assoc_property_map(result));
  for (const Face f : mesh.faces()) CHECK(result[f] == 10 * ((f + 1) % 4));
}

TEST_CASE("no share of a face comes from beyond a line between labels")
{
  const Mesh input = shapes::make_mesh(shapes::icosphere(4));
  std::map<Face, int> label;
  for (const Face f : input.faces()) {
    const Corners c = corners_of(input, f);
    const Vec3d center = c[0] + c[1] + c[2];
    label[f] = center.z + 0.3 * center.x > 0.3 ? 2 : 1;
  }
  const auto labels = boost::make_assoc_property_map(label);
  const Traced t(input, 60, params::face_patch_map(labels));
  int near = 0;
  for (const Face f : t.mesh.faces()) {
    const Mesh_source<Mesh>& source = t.faces[f];
    for (const Face g : source.faces) CHECK(label[g] == label[source.face]);
    near += std::count(source.faces.begin(), source.faces.end(), source.face) > 3;
  }
  CHECK(near < 20); // the shares are there
}
