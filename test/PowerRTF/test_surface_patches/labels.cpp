// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Labels of faces: what they part stays apart, and they come out; numbers of patches.
#include "../mesh_of_shape.h"
#include "../odd_shapes.h"
#include "../shapes.h"

#include <CGAL/PowerRTF/transfer/find_sources.h>
#include <CGAL/power_rtf_remeshing.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using shapes::Mesh;
using shapes::Soup;
namespace params = CGAL::PowerRTF::parameters;

namespace {

using Face = Mesh::Face_index;
using Label_at = std::function<int(const Vec3d&)>;

Vec3d corner(const Mesh& mesh, Face f, int k)
{
  auto h = mesh.halfedge(f);
  for (; k > 0; --k) h = mesh.next(h);
  return internal::to_vec3d(mesh.point(mesh.target(h)));
}

Vec3d center(const Mesh& mesh, Face f)
{
  return (corner(mesh, f, 0) + corner(mesh, f, 1) + corner(mesh, f, 2)) * (1. / 3);
}

struct Labeled {
  Mesh mesh;
  Mesh::Property_map<Face, int> labels;
  Remeshing_report report;

  Labeled() : labels(mesh.add_property_map<Face, int>("f:label").first) {}
  Labeled(const Soup& soup, const Label_at& label) : mesh(shapes::make_mesh(soup))
  {
    labels = mesh.add_property_map<Face, int>("f:label").first;
    for (const Face f : mesh.faces()) labels[f] = label(center(mesh, f));
  }
  Labeled(const Labeled&) = delete;

  std::map<int, double> areas() const
  {
    std::map<int, double> sums;
    for (const Face f : mesh.faces())
      sums[labels[f]] += length(cross(corner(mesh, f, 1) - corner(mesh, f, 0),
                                      corner(mesh, f, 2) - corner(mesh, f, 0))) /
                         2;
    return sums;
  }
  /// The ends of the edges between two labels.
  std::vector<Vec3d> boundary() const
  {
    std::vector<Vec3d> points;
    for (const auto e : mesh.edges()) {
      const auto h = mesh.halfedge(e);
      if (mesh.is_border(e) || labels[mesh.face(h)] == labels[mesh.face(mesh.opposite(h))])
        continue;
      for (const auto v : {mesh.source(h), mesh.target(h)})
        points.push_back(internal::to_vec3d(mesh.point(v)));
    }
    return points;
  }
};

void remesh(const Labeled& input, std::size_t n, Labeled& output)
{
  output.report =
      CGAL::power_rtf_remeshing(input.mesh, n, output.mesh, params::face_patch_map(input.labels),
                                params::face_patch_map(output.labels));
  CHECK(output.report.missed_guarantees().empty());
}

/// Of the area of a label, in parts of it.
double largest_error(const Labeled& input, const Labeled& output)
{
  const auto after = output.areas();
  double largest = 0;
  for (const auto& [label, area] : input.areas())
    largest = std::max(largest, std::abs(after.at(label) / area - 1));
  return largest;
}

int sector(const Vec3d& p) { return int(std::floor(2 * std::atan2(p.y, p.x) / shapes::pi)); }

} // namespace

TEST_CASE("labels of a smooth surface keep their lines and their areas")
{
  // four sectors of a torus: the lines between them lie in the planes x = 0 and y = 0
  const Labeled input(shapes::torus(80, 40, 1, 0.4), sector);
  Labeled output;
  remesh(input, 1500, output);
  const auto before = input.areas(), after = output.areas();
  REQUIRE(after.size() == before.size());
  for (const auto& [label, area] : before) CHECK(after.at(label) == Approx(area).epsilon(0.01));
  const std::vector<Vec3d> line = output.boundary();
  CHECK(line.size() > 100);
  for (const Vec3d& p : line) CHECK((std::min)(std::abs(p.x), std::abs(p.y)) < 1e-12);
  CHECK(output.report.crease_edges == 4 * 40);
}

TEST_CASE("labels keep their areas where the triangles are large beside the surface's radius")
{
  const Labeled input(shapes::torus(160, 80, 1, 0.15), sector);
  Labeled output;
  remesh(input, 400, output);
  const auto before = input.areas(), after = output.areas();
  for (const auto& [label, area] : before) CHECK(after.at(label) == Approx(area).epsilon(0.005));
}

TEST_CASE("straight lines between labels of a flat surface stay straight: areas are the same")
{
  const auto checkers = [](const Vec3d& p) { return int(4 * p.x) % 2 + 7 * (int(4 * p.y) % 2); };
  const Labeled input(shapes::plane_patch(8, 8), checkers);
  Labeled output;
  remesh(input, 900, output);
  const auto after = output.areas();
  CHECK(after.size() == 4);
  for (const auto& [label, area] : after) CHECK(area == Approx(0.25).epsilon(1e-9));
  for (const Face f : output.mesh.faces())
    CHECK(output.labels[f] == checkers(center(output.mesh, f)));
}

TEST_CASE("labels of a few triangles keep their areas: lines between them move, sides stay apart")
{
  struct Case {
    double radius;
    std::size_t n;
  };
  for (const Case c : {Case{0.04, 900}, Case{0.07, 400}, Case{0.08, 400}}) {
    CAPTURE(c.radius);
    const Labeled input(shapes::plane_patch(40, 40), [&](const Vec3d& p) {
      return int(length(p - Vec3d{0.51, 0.48, 0}) < c.radius);
    });
    Labeled output;
    remesh(input, c.n, output);
    CHECK(largest_error(input, output) < 0.006);
  }
}

TEST_CASE("rings on a wavy surface keep their areas, with triangles as long as a wave is high")
{
  const auto wave = [](const Vec3d& p) {
    return Vec3d{p.x, p.y, 0.15 * std::sin(12 * p.x) * std::sin(9 * p.y + 1)};
  };
  const Labeled input(shapes::mapped(shapes::plane_patch(60, 60), wave), [](const Vec3d& p) {
    return int(5 * length(Vec3d{p.x - 0.5, p.y - 0.5, 0}));
  });
  for (const std::size_t n : {300, 600}) {
    CAPTURE(n);
    Labeled output;
    remesh(input, n, output);
    CHECK(largest_error(input, output) < 0.006);
  }
}

TEST_CASE("a symmetric mesh has the lines of one half, but the labels of both")
{
  Remeshing_options options;
  options.symmetry = Symmetry::x;
  // the half that is remeshed has one label, the other one two
  const Labeled input(shapes::torus(60, 30, 1, 0.4), [](const Vec3d& p) {
    return p.x > 0 ? 0 : p.y > 0 ? 1 : 2;
  });
  Labeled output;
  CGAL::power_rtf_remeshing(input.mesh, 1500, output.mesh,
                            params::remeshing_options(options).face_patch_map(input.labels),
                            params::face_patch_map(output.labels));
  CHECK(largest_error(input, output) < 0.01);
}

TEST_CASE("without labels in the output, or of one kind, nothing else changes")
{
  const Labeled plain(shapes::torus(40, 20, 1, 0.4), [](const Vec3d&) { return 3; });
  Labeled output;
  remesh(plain, 500, output);
  for (const Face f : output.mesh.faces()) CHECK(output.labels[f] == 3);
  Mesh other;
  CGAL::power_rtf_remeshing(plain.mesh, 500, other);
  CHECK(shapes::soup_of(other).points == shapes::soup_of(output.mesh).points);
  CHECK(shapes::soup_of(other).triangles == shapes::soup_of(output.mesh).triangles);
}

TEST_CASE("labels may be of any kind, and the output the same object as the input")
{
  Labeled mesh(shapes::box(4), [](const Vec3d& p) { return p.x < 0; });
  auto names = mesh.mesh.add_property_map<Face, std::string>("f:name").first;
  for (const Face f : mesh.mesh.faces()) names[f] = mesh.labels[f] ? "left" : "right";
  CGAL::power_rtf_remeshing(mesh.mesh, 600, mesh.mesh, params::face_patch_map(names),
                            params::face_patch_map(names));
  for (const Face f : mesh.mesh.faces())
    CHECK(names[f] == (center(mesh.mesh, f).x < 0 ? "left" : "right"));
}

TEST_CASE("without labels the patches between creases are numbered, however fine the mesh")
{
  const Mesh cube = shapes::make_mesh(shapes::box(5));
  std::vector<std::map<std::pair<int, int>, int>> numbers; // of a side: its axis, its sign
  for (const std::size_t n : {400, 2000}) {
    Labeled output;
    CGAL::power_rtf_remeshing(cube, n, output.mesh, params::default_values(),
                              params::face_patch_map(output.labels));
    const auto areas = output.areas();
    CHECK(areas.size() == 6);
    for (const auto& [number, area] : areas) CHECK(area == Approx(4).epsilon(1e-9));
    numbers.emplace_back();
    for (const Face f : output.mesh.faces()) {
      const Vec3d c = center(output.mesh, f);
      const int axis = std::abs(c.x) > 0.9999 ? 0 : std::abs(c.y) > 0.9999 ? 1 : 2;
      const double x = axis == 0 ? c.x : axis == 1 ? c.y : c.z;
      numbers.back()[{axis, x < 0 ? -1 : 1}] = output.labels[f];
    }
  }
  CHECK(numbers[0] == numbers[1]);
  CHECK(numbers[0].size() == 6);

  Labeled sphere;
  CGAL::power_rtf_remeshing(shapes::make_mesh(shapes::icosphere(3)), 300, sphere.mesh,
                            params::default_values(), params::face_patch_map(sphere.labels));
  CHECK(sphere.areas().size() == 1);
}

TEST_CASE("both sides of a thin sheet have patches of their own")
{
  Labeled output;
  CGAL::power_rtf_remeshing(shapes::make_mesh(shapes::thin_disc(0.05)), 2000, output.mesh,
                            params::default_values(), params::face_patch_map(output.labels));
  std::map<bool, std::set<int>> sides;
  for (const Face f : output.mesh.faces()) {
    const Vec3d normal = cross(corner(output.mesh, f, 1) - corner(output.mesh, f, 0),
                               corner(output.mesh, f, 2) - corner(output.mesh, f, 0));
    if (std::abs(normal.z) > 0.99 * length(normal)) sides[normal.z > 0].insert(output.labels[f]);
  }
  CHECK(sides[true].size() == 1);
  CHECK(sides[false].size() == 1);
}

TEST_CASE("labels belong to polygons of any sizes, whose vertices may be there several times")
{
  const Soup shared = shapes::plane_patch(6, 6);
  Surface_fields fields;
  Soup apart; // each label has vertices of its own, as some programs write them
  for (const Triangle& t : shared.triangles) {
    const bool is_left = (shared.points[t[0]] + shared.points[t[1]] + shared.points[t[2]]).x < 1.5;
    fields.labels.push_back(is_left);
    const int first = int(apart.points.size());
    for (const int v : t) apart.points.push_back(shared.points[v]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  const auto creases = [&](const Soup& soup) {
    Remeshing_report report;
    const Surface s =
        prepare_surface(internal::soup_of_ranges(soup.points, soup.triangles), fields, {}, report);
    for (const Edge& e : s.creases)
      for (const int v : e) CHECK(s.normalization.to_outside(s.points[v]).x == Approx(0.5));
    return s.creases.size();
  };
  CHECK(creases(shared) == 6);
  CHECK(creases(apart) == 6);
  fields.labels.pop_back();
  CHECK_THROWS_WITH_AS(creases(shared), "there are 71 labels for 72 facets", Invalid_input_error);
}

TEST_CASE("lines are creases beside those that are found")
{
  const Soup soup = shapes::box(4); // the middle of the side z = 1
  Surface_fields fields;
  std::vector<int> middle;
  for (int v = 0; v < int(soup.points.size()); ++v)
    if (soup.points[v].z == 1 && soup.points[v].x == 0) middle.push_back(v);
  std::sort(middle.begin(), middle.end(),
            [&](int a, int b) { return soup.points[a].y < soup.points[b].y; });
  for (std::size_t k = 0; k + 1 < middle.size(); ++k)
    fields.lines.push_back({middle[k + 1], middle[k]});
  Remeshing_report report;
  const Surface s =
      prepare_surface(internal::soup_of_ranges(soup.points, soup.triangles), fields, {}, report);
  CHECK(s.creases.size() == 12 * 4 + 4);
}
