// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices of the input that are to stay are vertices of the result, with the same coordinates.
#include "cad_shapes.h"
#include "test_regions/faces_where.h"

#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/quality/assess_impl.h>
#include <CGAL/power_rtf_remeshing.h>

#include <CGAL/Simple_cartesian.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

using namespace CGAL::PowerRTF;
using shapes::make_mesh;
using shapes::Mesh;
using shapes::Soup;
using shapes::soup_of;
namespace params = CGAL::PowerRTF::parameters;

namespace {

/// Coordinates with all their digits.
Soup turned(const Soup& soup) { return shapes::rotated(soup, 0.7); }

Soup egg() { return turned(shapes::ellipsoid(1, 0.8, 0.6, 4)); }

std::vector<int> random_vertices(const Soup& soup, int count, unsigned seed = 1)
{
  std::vector<int> all(soup.points.size());
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = int(v);
  std::shuffle(all.begin(), all.end(), std::mt19937(seed));
  all.resize(count);
  return all;
}

template <class Graph>
auto constrained(Graph& mesh, const std::vector<int>& vertices)
{
  auto map = mesh.template add_property_map<typename Graph::Vertex_index, bool>("v:stay").first;
  for (const int v : vertices) map[typename Graph::Vertex_index(v)] = true;
  return map;
}

/// How many of the vertices are also vertices of `mesh`, at the same coordinates.
template <class Point>
std::size_t count_found(const CGAL::Surface_mesh<Point>& before, const std::vector<int>& vertices,
                        const CGAL::Surface_mesh<Point>& mesh)
{
  using Vertex = typename CGAL::Surface_mesh<Point>::Vertex_index;
  std::multiset<Point> points;
  for (const auto v : mesh.vertices()) points.insert(mesh.point(v));
  return std::count_if(vertices.begin(), vertices.end(),
                       [&](int v) { return points.count(before.point(Vertex(v))) == 1; });
}

struct Result {
  Mesh mesh;
  Remeshing_report report;
};

/// Remeshes with these vertices, and checks that they are there and all guarantees are met.
template <class Tag = CGAL::Parallel_if_available_tag>
Result remeshed(const Soup& soup, const std::vector<int>& vertices, const Resolution& resolution,
                const Remeshing_options& options = {})
{
  Mesh mesh = make_mesh(soup);
  Result result;
  result.report = CGAL::power_rtf_remeshing<Tag>(
      mesh, resolution, result.mesh,
      params::remeshing_options(options).vertex_is_constrained_map(constrained(mesh, vertices)));
  const Remeshing_report& report = result.report;
  for (const std::string& missed : report.missed_guarantees()) MESSAGE(missed);
  CHECK(report.missed_guarantees().empty());
  CHECK(report.constrained_vertices == vertices.size());
  CHECK(report.lost_constrained_vertices == 0);
  CHECK(count_found(mesh, vertices, result.mesh) == vertices.size());
  return result;
}

Remeshing_options uniform()
{
  Remeshing_options options;
  options.density = Density::uniform;
  return options;
}

} // namespace

TEST_CASE("vertices inside a smooth surface stay exactly, with triangles about as good")
{
  const Soup soup = egg();
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Result result = remeshed(soup, random_vertices(soup, 30, seed), 600);
    CHECK(result.mesh.number_of_vertices() == 600);
    CHECK(result.report.quality.q_avg > 0.92);
    CHECK(result.report.quality.theta_min > 30);
  }
  const Mesh without = [&] {
    Mesh mesh = make_mesh(soup), output;
    CGAL::power_rtf_remeshing(mesh, 600, output);
    return output;
  }();
  CHECK(count_found(make_mesh(soup), random_vertices(soup, 30), without) == 0);
}

TEST_CASE("each way to make triangles and each preset has them")
{
  const Soup soup = turned(shapes::torus(40, 20, 1, 0.4));
  const std::vector<int> vertices = random_vertices(soup, 20);
  for (const Extraction_method method : {Extraction_method::cells, Extraction_method::insertion,
                                         Extraction_method::restricted_delaunay}) {
    Remeshing_options options = uniform();
    options.extraction = method;
    remeshed(soup, vertices, 500, options);
  }
  for (const Preset preset : {Preset::fast, Preset::paper})
    remeshed(soup, vertices, 500, Remeshing_options::of(preset));
}

TEST_CASE("the same result on one thread and at any scale")
{
  const Soup soup = egg();
  const std::vector<int> vertices = random_vertices(soup, 10);
  const Soup parallel = soup_of(remeshed(soup, vertices, 300).mesh),
             sequential = soup_of(remeshed<CGAL::Sequential_tag>(soup, vertices, 300).mesh);
  CHECK(parallel.points == sequential.points);
  CHECK(parallel.triangles == sequential.triangles);
  for (const double factor : {std::ldexp(1., -80), std::ldexp(1., 80)}) {
    const Soup scaled =
        soup_of(remeshed<CGAL::Sequential_tag>(shapes::scaled(soup, factor), vertices, 300).mesh);
    CHECK(scaled.triangles == sequential.triangles);
    for (std::size_t v = 0; v < scaled.points.size(); ++v)
      CHECK(length((1 / factor) * scaled.points[v] - sequential.points[v]) < 1e-14);
  }
}

TEST_CASE("vertices on creases and borders stay, and these with them")
{
  const Soup part = turned(shapes::bracket(0.2, 4));
  const std::vector<int> all = random_vertices(part, int(part.points.size()) / 2);
  const Result result = remeshed(part, all, 1200);
  CHECK(result.report.crease_edges > 0);
  CHECK(result.report.lost_feature_edges == 0);
  const Soup tube = turned(shapes::open_cylinder(40, 20, 1, 2));
  std::vector<int> on_border; // vertices come ring by ring
  for (int v = 0; v < 40; v += 3) on_border.push_back(v);
  for (const Density density : {Density::uniform, Density::curvature}) {
    Remeshing_options options;
    options.density = density;
    CHECK(remeshed(tube, on_border, 400, options).report.topology.border_loops == 2);
  }
}

TEST_CASE("from one vertex to all, neighbors and clusters, and no more than there are samples")
{
  const Soup ball = turned(shapes::icosphere(2));
  const int n = int(ball.points.size());
  remeshed(ball, random_vertices(ball, 1), 50);
  const Triangle& t = ball.triangles.front();
  remeshed(ball, {t[0], t[1]}, 30); // far nearer to each other than samples are
  remeshed(ball, {t[0], t[1], t[2]}, 30);
  remeshed(ball, random_vertices(ball, n), n);
  remeshed(ball, random_vertices(ball, n - 1), n);
  Mesh mesh = make_mesh(ball), output;
  const auto map = constrained(mesh, random_vertices(ball, 31));
  CHECK_THROWS_WITH_AS(
      CGAL::power_rtf_remeshing(mesh, 30, output, params::vertex_is_constrained_map(map)),
      doctest::Contains("vertices that are to stay need 31"), Invalid_input_error);
}

TEST_CASE("a largest distance and an edge length leave them")
{
  const Soup soup = egg();
  const std::vector<int> vertices = random_vertices(soup, 12);
  const Result coarse =
      remeshed(soup, vertices, Resolution::relative_max_distance(0.01)); // takes vertices out
  CHECK(coarse.report.topology.vertices < 120);
  remeshed(soup, vertices, Resolution::relative_max_distance(0.01), uniform());
  remeshed(soup, vertices, Resolution::edge_length(0.2));
}

TEST_CASE("coordinates of single precision stay as they are")
{
  using Point = CGAL::Simple_cartesian<float>::Point_3;
  using Float_mesh = CGAL::Surface_mesh<Point>;
  const Soup soup = shapes::translated(egg(), {40, 50, 60});
  Float_mesh mesh = make_mesh<Float_mesh>(soup), output;
  const std::vector<int> vertices = random_vertices(soup, 20);
  const Remeshing_report report = CGAL::power_rtf_remeshing(
      mesh, 500, output, params::vertex_is_constrained_map(constrained(mesh, vertices)));
  CHECK(report.missed_guarantees().empty());
  CHECK(count_found(mesh, vertices, output) == vertices.size());
}

TEST_CASE("a vertex where sheets touch, or on a seam of a network, stays")
{
  Soup two =
      shapes::joined(shapes::icosphere(3), shapes::translated(shapes::icosphere(3), {2, 0, 0}));
  const auto at = [](const Soup& s, const Vec3d& p) {
    return int(std::min_element(
                   s.points.begin(), s.points.end(),
                   [&](const Vec3d& a, const Vec3d& b) { return length(a - p) < length(b - p); }) -
               s.points.begin());
  };
  Surface_fields fields;
  fields.kept_vertices = {at(two, {0, 0, 1}), at(two, {2, 0, -1})};
  Remeshing_options options = uniform();
  options.number_of_samples = 400;
  const auto run = [&](const Soup& soup) {
    Polygon_soup polygons = internal::soup_of_ranges(soup.points, soup.triangles);
    Remeshing_report report;
    Surface surface = prepare_surface(std::move(polygons), fields, options, report);
    CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<shapes::Kernel>> remesher(std::move(surface),
                                                                              options, report);
    Remeshing_default_visitor visitor;
    REQUIRE(remesher.optimize(visitor));
    const Extracted_mesh mesh = remesher.extract(visitor);
    CHECK(remesher.report().lost_constrained_vertices == 0);
    CHECK(remesher.report().missed_guarantees().empty());
    const std::vector<Vec3d> points = mesh.outside(remesher.surface().normalization);
    for (const int v : fields.kept_vertices)
      CHECK(std::count(points.begin(), points.end(), soup.points[v]) >= 1);
  };
  run(two);
  Soup floor = shapes::plane_patch(4, 4), wall = floor; // which stands on the middle of the floor
  for (Vec3d& p : wall.points) p = {0.5, p.y, p.x};
  const Soup fin = shapes::joined(floor, wall);
  fields.kept_vertices = {at(fin, {0.5, 0.25, 0}), at(fin, {0.25, 0.25, 0}),
                          at(fin, {0.5, 0.5, 0.5}), at(fin, {1, 0.75, 0})};
  run(fin);
}

TEST_CASE("inside a region that is remeshed, and on its border if that is, too")
{
  for (const Region_border border : {Region_border::keep, Region_border::remesh}) {
    Mesh mesh = make_mesh(egg());
    const Mesh before = mesh;
    const auto faces = regions::faces_where(mesh, regions::is_upper);
    const std::set<Mesh::Face_index> inside(faces.begin(), faces.end());
    std::vector<int> vertices, on_border;
    for (const auto v : mesh.vertices()) {
      std::size_t found = 0, around = 0;
      for (const auto f : CGAL::faces_around_target(mesh.halfedge(v), mesh))
        found += inside.count(f), ++around;
      if (found == around && v % 50 == 0) vertices.push_back(int(v));
      if (0 < found && found < around && v % 5 == 0) on_border.push_back(int(v));
    }
    REQUIRE(vertices.size() > 5);
    REQUIRE(on_border.size() > 3);
    vertices.insert(vertices.end(), on_border.begin(), on_border.end());
    const Remeshing_report report = CGAL::power_rtf_remeshing(
        faces, mesh, 300,
        params::region_border(border).vertex_is_constrained_map(constrained(mesh, vertices)));
    mesh.collect_garbage();
    CHECK(report.missed_guarantees().empty());
    CHECK(count_found(before, vertices, mesh) == vertices.size());
  }
}

TEST_CASE("what makes other vertices of the input's is refused with them")
{
  const auto refused = [](const auto& change, const char* why) {
    Mesh mesh = make_mesh(egg()), output;
    Remeshing_options options;
    change(options);
    CHECK_THROWS_WITH_AS(
        CGAL::power_rtf_remeshing(
            mesh, 300, output,
            params::remeshing_options(options).vertex_is_constrained_map(constrained(mesh, {0}))),
        doctest::Contains(why), Invalid_input_error);
  };
  refused([](auto& o) { o.symmetry = Symmetry::x; }, "symmetry and vertices that are to stay");
  refused([](auto& o) { o.merge_distance = 0.01; }, "merge_distance may join");
  refused([](auto& o) { o.intersections = Intersections::wrap; }, "makes others");
  Mesh mesh = make_mesh(egg()), output;
  mesh.add_vertex(Mesh::Point(0, 0, 0));
  const auto alone = constrained(mesh, {int(mesh.number_of_vertices()) - 1});
  CHECK_THROWS_WITH_AS(
      CGAL::power_rtf_remeshing(mesh, 300, output, params::vertex_is_constrained_map(alone)),
      doctest::Contains("cannot stay: no facet with an area has it"), Invalid_input_error);
}

TEST_CASE("a vertex off all creases is one site, inside its patch; a lost one is told")
{
  Surface surface = shapes::make_surface(shapes::icosphere(3));
  surface.kept_vertices = {5, 17};
  for (const int v : surface.kept_vertices)
    surface.kept_points.push_back(surface.normalization.to_outside(surface.points[v]));
  const Cut_surface cut = cut_along_creases(surface);
  const Feature_samples features = sample_features(surface, cut, 100);
  REQUIRE(features.size() == 2);
  CHECK(features.next == std::vector<int>{-1, -1});
  CHECK(features.sites_inside() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(features.sites.points[k] == surface.points[surface.kept_vertices[k]]);
    const Triangle& t = surface.triangles[features.sites.facets[k]];
    CHECK(std::count(t.begin(), t.end(), surface.kept_vertices[k]) == 1);
  }
  CHECK(equivalent_cells(cut.surface, 100, features) == doctest::Approx(98)); // 100 - chi

  Extracted_mesh mesh;
  mesh.points = surface.points;
  mesh.triangles = surface.triangles;
  mesh.input_points.resize(mesh.points.size());
  for (std::size_t k = 0; k < 2; ++k)
    mesh.input_points[surface.kept_vertices[k]] = {surface.kept_vertices[k],
                                                   surface.kept_points[k]};
  CHECK(internal::lost_kept_vertices(surface, mesh) == 0);
  mesh.points[17].x += 1e-6;
  CHECK(internal::lost_kept_vertices(surface, mesh) == 1);
  mesh.input_points[5].number = -1;
  CHECK(internal::lost_kept_vertices(surface, mesh) == 2);
  mesh.points[17].x -= 1e-6;
  mesh.triangles.erase(
      std::remove_if(mesh.triangles.begin(), mesh.triangles.end(),
                     [](const Triangle& t) { return std::count(t.begin(), t.end(), 17) > 0; }),
      mesh.triangles.end());
  CHECK(internal::lost_kept_vertices(surface, mesh) == 2);
}
