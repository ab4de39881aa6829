// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border of a region is remeshed with it.
#include "faces_where.h"

#include <CGAL/power_rtf_remeshing.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using regions::center;
using regions::check_invariance;
using regions::faces_where;
using regions::Is_inside;
using regions::is_upper;
using regions::sphere;
using shapes::make_mesh;
using shapes::Mesh;
namespace params = CGAL::PowerRTF::parameters;

namespace {

using Corners = std::vector<Mesh::Point>;
using Map = Mesh::Property_map<Mesh::Face_index, int>;

/// From the smallest corner on.
Corners corners(const Mesh& mesh, Mesh::Face_index f)
{
  Corners points;
  for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
    points.push_back(mesh.point(v));
  std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
  return points;
}

/// What has become of a region, which is labeled 1, the rest 0.
struct Remeshed {
  Mesh mesh;
  Map labels;
  Mesh before;
  std::set<Mesh::Point> old_border;                ///< its vertices
  std::vector<std::array<Vec3d, 2>> old_edges;     ///< of the border
  std::vector<std::array<Mesh::Point, 2>> borders; ///< edges of the new one
  Remeshing_report report;

  Remeshed(Mesh input, const Is_inside& is_inside, const Resolution& resolution,
           Region_border border = Region_border::remesh)
      : mesh(std::move(input))
  {
    labels = mesh.add_property_map<Mesh::Face_index, int>("f:label", 0).first;
    const auto faces = faces_where(mesh, is_inside);
    for (const auto f : faces) labels[f] = 1;
    before = mesh;
    for_each_border_edge([&](const Mesh::Point& a, const Mesh::Point& b) {
      old_border.insert({a, b});
      old_edges.push_back({internal::to_vec3d(a), internal::to_vec3d(b)});
    });
    report = CGAL::power_rtf_remeshing(faces, mesh, resolution,
                                       params::region_border(border).face_patch_map(labels));
    mesh.collect_garbage();
    CHECK(CGAL::is_valid_polygon_mesh(mesh));
    CHECK(report.missed_guarantees().empty());
    CHECK_FALSE(CGAL::Polygon_mesh_processing::does_self_intersect(mesh));
    for_each_border_edge([&](const Mesh::Point& a, const Mesh::Point& b) {
      borders.push_back({a, b});
    });
    check_rest();
  }
  Remeshed(const Remeshed&) = delete;

  double border_length() const // the mean of its edges'
  {
    double sum = 0;
    for (const auto& [a, b] : borders) sum += std::sqrt(CGAL::squared_distance(a, b));
    return sum / double(borders.size());
  }

private:
  template <class F>
  void for_each_border_edge(const F& f) const
  {
    for (const auto e : mesh.edges()) {
      const auto h = mesh.halfedge(e);
      if (!mesh.is_border(e) && labels[mesh.face(h)] != labels[mesh.face(mesh.opposite(h))])
        f(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)));
    }
  }

  /// Faces of the rest off the old border are there as they were.
  void check_rest() const
  {
    std::multiset<Corners> after;
    std::size_t rest = 0, inside = 0;
    for (const auto f : mesh.faces()) {
      if (labels[f] == 0) after.insert(corners(mesh, f));
      (labels[f] == 0 ? rest : inside)++;
    }
    CHECK(inside == report.topology.faces);
    CHECK(rest == report.kept_faces + report.changed_faces);
    std::size_t same = 0;
    for (const auto f : before.faces()) {
      if (before.property_map<Mesh::Face_index, int>("f:label").first[f] == 1) continue;
      const Corners c = corners(before, f);
      same += after.count(c);
      if (std::none_of(c.begin(), c.end(), [&](const auto& p) { return old_border.count(p) > 0; }))
        CHECK(after.count(c) == 1);
    }
    CHECK(same == report.kept_faces);
  }
};

double distance_to_segment(const Vec3d& p, const Vec3d& a, const Vec3d& b)
{
  const double t = dot(p - a, b - a) / squared_length(b - a);
  return length(p - a - (b - a) * std::clamp(t, 0., 1.));
}

} // namespace

TEST_CASE("the border gets the region's spacing, finer and coarser")
{
  for (const double edge : {0.03, 0.15, 0.25}) { // the input's are about 0.075
    CAPTURE(edge);
    const Remeshed r(sphere(), is_upper, Resolution::edge_length(edge));
    CHECK(r.border_length() == Approx(edge).epsilon(0.1));
    CHECK(r.report.changed_faces > 0);
    // Where a face of the rest keeps two vertices of the border, lengths grow from these on.
    if (edge < 0.2) CHECK(r.report.edge_length.median == Approx(edge).epsilon(0.05));
    CHECK(r.report.quality.q_min > 0.5);
    for (const auto& [a, b] : r.borders)
      for (const auto& p : {a, b}) {
        double nearest = 1;
        for (const auto& [from, to] : r.old_edges)
          nearest = (std::min)(nearest, distance_to_segment(internal::to_vec3d(p), from, to));
        CHECK(nearest < 1e-15);
      }
    const Remeshed kept(sphere(), is_upper, Resolution::edge_length(edge), Region_border::keep);
    CHECK(kept.report.changed_faces == 0);
    CHECK(std::abs(kept.border_length() / edge - 1) > 0.3);
  }
}

TEST_CASE("the spacing is that along a border whose edges go to and fro")
{
  for (const double sign : {-1., 1.}) { // of these lines one runs along the diagonals
    const auto is_inside = [sign](const Vec3d& p) { return p.y > 0.5 + sign * (p.x - 0.5); };
    const Remeshed r(make_mesh(shapes::plane_patch(24, 24)), is_inside,
                     Resolution::edge_length(0.2));
    CHECK(r.border_length() == Approx(0.2).epsilon(0.2));
  }
}

TEST_CASE("where all is flat, the changed faces fill the same place, and corners stay")
{
  const auto is_inside = [](const Vec3d& p) {
    return p.x > 0.25 && p.x < 0.75 && p.y > 0.25 && p.y < 0.75;
  };
  for (const std::size_t n : {60, 3000}) {
    CAPTURE(n);
    const Remeshed r(make_mesh(shapes::plane_patch(24, 24)), is_inside, n);
    CHECK(r.report.topology.vertices == n);
    double area = 0;
    for (const auto f : r.mesh.faces()) {
      const Corners c = corners(r.mesh, f);
      const double signed_area = CGAL::cross_product(c[1] - c[0], c[2] - c[0]).z() / 2;
      CHECK(signed_area > 0);
      if (r.labels[f] == 1) area += signed_area;
    }
    CHECK(area == Approx(0.25).epsilon(1e-12));
    for (const double x : {0.25, 0.75})
      for (const double y : {0.25, 0.75})
        CHECK(std::any_of(r.borders.begin(), r.borders.end(), [&](const auto& e) {
          return e[0] == Mesh::Point(x, y, 0) || e[1] == Mesh::Point(x, y, 0);
        }));
  }
}

TEST_CASE("creases that lead across the border go on")
{
  const Remeshed r(
      make_mesh(shapes::box(12)), [](const Vec3d& p) { return p.z > 0.1; },
      Resolution::edge_length(0.4));
  double volume = 0;
  for (const auto f : r.mesh.faces()) {
    const Corners c = corners(r.mesh, f);
    volume += CGAL::scalar_product(c[0] - CGAL::ORIGIN,
                                   CGAL::cross_product(c[1] - CGAL::ORIGIN, c[2] - CGAL::ORIGIN)) /
              6;
  }
  CHECK(volume == Approx(8).epsilon(1e-12));
}

TEST_CASE("two sheets, holes, a border of the mesh, a single facet")
{
  const Resolution coarse = Resolution::edge_length(0.2), fine = Resolution::edge_length(0.03);
  for (const Resolution& resolution : {coarse, fine}) {
    Remeshed(
        sphere(), [](const Vec3d& p) { return std::abs(p.z) > 0.5; }, resolution);
    Remeshed(
        sphere(), [](const Vec3d& p) { return std::abs(p.z) < 0.4; }, resolution);
    Remeshed(
        make_mesh(shapes::plane_patch(20, 20)), [](const Vec3d& p) { return p.x > 0.5; },
        resolution);
    Remeshed(
        make_mesh(shapes::box(1)), [](const Vec3d& p) { return p.z > 0.99 && p.x > p.y; },
        resolution);
    Remeshed(
        make_mesh(shapes::thin_disc(0.05)), [](const Vec3d& p) { return p.x > 0.2; }, resolution);
  }
}

TEST_CASE("a remeshed border is the same on one thread, and for a scaled mesh")
{
  check_invariance([](const auto& faces, Mesh& mesh, auto concurrency) {
    CGAL::power_rtf_remeshing<decltype(concurrency)>(faces, mesh, 150,
                                                     params::region_border(Region_border::remesh));
  });
}

TEST_CASE("no spacing on the border follows from a largest distance")
{
  Mesh mesh = sphere();
  const auto untouched = shapes::soup_of(mesh);
  CHECK_THROWS_WITH_AS(CGAL::power_rtf_remeshing(faces_where(mesh, is_upper), mesh,
                                                 Resolution::max_distance(0.01),
                                                 params::region_border(Region_border::remesh)),
                       doctest::Contains("largest distance"), Invalid_input_error);
  CHECK(shapes::soup_of(mesh).points == untouched.points);
}

TEST_CASE("a triangle is cut at vertices on its sides into triangles with areas")
{
  const std::vector<Vec3d> points = {{0, 0, 0},   {1, 0, 0},   {0, 1, 0},     {0.1, 0, 0},
                                     {0.2, 0, 0}, {0.9, 0, 0}, {0.5, 0.5, 0}, {0, 0.7, 0}};
  for (const bool on_all : {true, false}) {
    std::vector<Triangle> cut;
    internal::cut_at_sides(points, {0, 1, 2},
                           {std::vector<int>{3, 4, 5},
                            on_all ? std::vector<int>{6} : std::vector<int>(),
                            on_all ? std::vector<int>{7} : std::vector<int>()},
                           cut);
    CHECK(cut.size() == (on_all ? 6 : 4));
    double sum = 0;
    for (const auto& [a, b, c] : cut) {
      const double area = cross(points[b] - points[a], points[c] - points[a]).z / 2;
      CHECK(area > 0);
      sum += area;
    }
    CHECK(sum == Approx(0.5));
  }
}

TEST_CASE("a vertex goes only where faces neither fold nor meet")
{
  // A fan around vertex 0, and its neighbor 1.
  Polygon_soup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  std::vector<int> places = {0, 1, 2, 3, 4};
  for (int k = 1; k <= 4; ++k) {
    for (const int v : {0, k, k % 4 + 1}) soup.add_corner(v);
    soup.end_polygon();
  }
  const auto contracts = [&] {
    return internal::Border_pieces(soup, places, {1, 1, 1, 1, 1}, {1, 1, 1, 1}).contract(0, 1, 0.7);
  };
  CHECK(contracts());
  soup.points[2] = {0.9, 1, 0};
  soup.points[1] = {0.3, 0.9, 0}; // the triangle of 1, 2, 3 turns over
  soup.points[3] = {0, 0.5, 0};
  CHECK_FALSE(contracts());
}
