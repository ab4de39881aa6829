// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Creases and borders: sampled, and kept from the samples to the mesh.
#include <doctest/doctest.h>

#include "creased_surface.h"
#include "dirty_shapes.h"
#include "odd_shapes.h"

#include <CGAL/PowerRTF/cells/clip_at_features.h>
#include <CGAL/PowerRTF/extraction/Opened_surface.h>
#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/features/Surface_patches.h>
#include <CGAL/PowerRTF/features/curve_samples.h>
#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/quality/assess.h>
#include <CGAL/PowerRTF/quality/assess_impl.h>
#include <CGAL/PowerRTF/quality/topology.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace CGAL::PowerRTF;

namespace {

/// The distance of `p` from the polyline through the vertices of `curve`.
double distance_to(const Surface& surface, const Feature_curve& curve, const Vec3d& p)
{
  double least = 1e300;
  for (std::size_t k = 0; k + 1 < curve.vertices.size(); ++k) {
    const Vec3d a = surface.points[curve.vertices[k]], b = surface.points[curve.vertices[k + 1]];
    const double t = dot(p - a, b - a) / squared_length(b - a);
    least = std::min(least, length(p - (a + (b - a) * std::min(1., std::max(0., t)))));
  }
  return least;
}

} // namespace

TEST_CASE("curves run from corner to corner")
{
  const auto curves = feature_curves(shapes::with_creases(shapes::box(6), 1000), 0.01);
  CHECK(curves.size() == 12);
  std::set<int> corners;
  for (const Feature_curve& c : curves) {
    CHECK(c.vertices.size() == 7);
    CHECK(c.has_corners);
    CHECK(c.parallels == 1);
    corners.insert({c.vertices.front(), c.vertices.back()});
  }
  CHECK(corners.size() == 8);

  const auto rims = feature_curves(shapes::with_creases(shapes::can(60, 5), 1000), 0.01);
  CHECK(rims.size() == 2);
  for (const Feature_curve& c : rims) {
    CHECK_FALSE(c.has_corners);
    CHECK(c.vertices.size() == 61);
    CHECK(c.vertices.front() == c.vertices.back());
  }

  // The corners of a border are turns.
  const auto sides = feature_curves(shapes::make_surface(shapes::plane_patch(9, 5)), 0.05);
  CHECK(sides.size() == 4);
  const auto loop = feature_curves(shapes::make_surface(shapes::plane_patch(9, 5)), 0);
  CHECK(loop.size() == 1);
}

TEST_CASE("samples line creases and borders evenly")
{
  for (const shapes::Soup& soup : {shapes::box(5), shapes::can(80, 6), shapes::plane_patch(8, 8),
                                   shapes::open_cylinder(60, 10, 1, 3)}) {
    for (const std::size_t n : {200, 3000}) {
      const Surface surface = shapes::with_creases(soup, n);
      const Cut_surface cut = cut_along_creases(surface);
      const Feature_samples features = sample_features(surface, cut, n);
      const double spacing = std::sqrt(2 / std::sqrt(3.) * surface.area / double(n));
      CHECK(features.size() > 3);
      CHECK(features.size() < n);
      CHECK(features.edges.size() >= features.size()); // closed curves, or more at corners
      for (const Edge& e : features.edges) {
        const double l = length(features.samples.points[e[1]] - features.samples.points[e[0]]);
        CHECK(l > 0.7 * spacing);
        CHECK(l < 1.4 * spacing);
      }
      const auto curves = feature_curves(surface, 0);
      for (std::size_t s = 0; s < features.size(); ++s) {
        double least = 1;
        for (const Feature_curve& c : curves)
          least = std::min(least, distance_to(surface, c, features.samples.points[s]));
        CHECK(least < 1e-15);
      }
      // Along the boundary of its patch each site is followed by the next, the patch to the left.
      const Samples& sites = features.sites;
      CHECK(features.next.size() == sites.size());
      for (std::size_t s = 0; s < sites.size(); ++s) {
        const int next = features.next[s];
        CHECK(sites.patches[next] == sites.patches[s]);
        CHECK(length(sites.points[next] - sites.points[s]) < 1.4 * spacing);
        const Triangle& t = surface.triangles[sites.facets[s]];
        const Vec3d center =
            (surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]) * (1. / 3);
        const Vec3d along = sites.points[next] - sites.points[s];
        CHECK(dot(cross(along, center - sites.points[s]), surface.facet_normals[sites.facets[s]]) >
              0);
      }
    }
  }
}

TEST_CASE("a surface with samples on creases and borders has room for half its triangles")
{
  struct Part {
    shapes::Soup soup;
    int characteristic;
    bool has_borders;
  };
  for (const Part& part : {Part{shapes::box(5), 2, false}, Part{shapes::can(80, 6), 2, false},
                           Part{shapes::plane_patch(8, 8), 1, true},
                           Part{shapes::open_cylinder(60, 10, 1, 3), 0, true}}) {
    const std::size_t n = 1000;
    const Surface surface = shapes::with_creases(part.soup, n);
    const Cut_surface cut = cut_along_creases(surface);
    const Feature_samples features = sample_features(surface, cut, n);
    const double border = part.has_borders ? double(features.size()) : 0;
    CHECK(equivalent_cells(cut.surface, n, features) ==
          doctest::Approx(double(n) - border / 2 - part.characteristic));
  }
}

TEST_CASE("too few samples for the borders are refused, for found creases these are left out")
{
  const Surface plane = shapes::make_surface(shapes::plane_patch(4, 4));
  CHECK_THROWS_AS(sample_features(plane, cut_along_creases(plane), 2), Invalid_input_error);
  CHECK(
      !shapes::with_creases(shapes::box(5), 8).creases.empty()); // all is flat: the corners suffice
  CHECK(shapes::with_creases(shapes::box(5), 7).creases.empty());
  CHECK(shapes::with_creases(shapes::box(5), 16).creases.size() == 60);
  Remeshing_options options;
  Surface box = shapes::make_surface(shapes::box(3));
  for (double angle : {0., -1., 181., std::nan("")}) {
    options.feature_angle = angle;
    CHECK_THROWS_AS(set_creases(box, options), Invalid_input_error);
  }
}

TEST_CASE("cells are cut at the chords between neighbors on a boundary")
{
  // The cell [-1, 1]^2 of the site (0, 0); sites 1, 2, 3 are the boundary, the patch to the left.
  const int next[] = {-1, 2, 3, 1}, previous[] = {-1, 3, 1, 2};
  const Tangent_frame<double> frame({0, 0, 1});
  const auto area_after = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c, bool is_cut) {
    const Site<double> sites[] = {{{0, 0, 0}, 0}, {a, 0}, {b, 0}, {c, 0}};
    Sites_view<double> view;
    view.sites = sites;
    Tangent_polygon<double> polygon;
    polygon.set_square(1);
    CHECK_FALSE(clip_at_features(view, 0, next, previous, frame, polygon)); // no neighbor on it
    polygon.neighbor[0] = 1;
    CHECK(clip_at_features(view, 0, next, previous, frame, polygon) == is_cut);
    double sum = 0;
    for (int k = 0; k < polygon.size; ++k) {
      const int l = polygon.next(k);
      sum += (polygon.x[k] * polygon.y[l] - polygon.x[l] * polygon.y[k]) / 2;
    }
    return sum;
  };
  CHECK(area_after({-2, -0.5, 0}, {2, -0.5, 0}, {0, 50, 0}, true) == doctest::Approx(3));
  CHECK(area_after({-0.8, -0.5, 0}, {0.8, -0.5, 0}, {0, 50, 0}, true) < 3); // two chords
  CHECK(area_after({-2, -1.5, 0}, {2, -1.5, 0}, {0, 50, 0}, false) == doctest::Approx(4));
  // The site a little outside, between chord and curve; far outside it is the other side of a slit.
  CHECK(area_after({-2, 0.5, 0}, {2, 0.5, 0}, {0, 50, 0}, true) == doctest::Approx(1));
  CHECK(area_after({2, -0.9, 0}, {-2, -0.9, 0}, {0, -50, 0}, false) == doctest::Approx(4));
}

TEST_CASE("the extraction keeps creases and borders, wherever the other samples are")
{
  for (const shapes::Soup& soup : {shapes::box(5), shapes::can(80, 6), shapes::plane_patch(8, 8),
                                   shapes::open_cylinder(60, 10, 1, 3)})
    for (const unsigned seed : {0, 1}) {
      Surface surface = shapes::with_creases(soup, 400);
      Remeshing_options options;
      options.number_of_samples = 400;
      options.random_seed = seed;
      const Surface_patches patches(surface, options);
      const Samples free = sample_surface(patches.surface(), options, patches.features());
      CHECK(free.size() + patches.features().size() == 400);
      const Extracted_mesh mesh = extract_by_insertion(
          surface, joined(patches.on_whole(free), patches.features().samples), patches.features());
      CHECK(mesh.points.size() == 400);
      CHECK(mesh.feature_edges.size() == patches.features().edges.size());
      Remeshing_report report;
      report.samples_asked = 400;
      assess(surface, mesh, report);
      CHECK(report.missed_guarantees().empty());
      CHECK(report.lost_feature_edges == 0);
      CHECK(report.topology.border_loops == report.input_topology.border_loops);
    }
}

TEST_CASE("a crease that is one edge keeps all its samples")
{
  for (const std::size_t n : {20, 100, 1000}) {
    CAPTURE(n);
    Surface surface = shapes::make_surface(shapes::icosahedron());
    const Triangle& t = surface.triangles[7];
    surface.creases = {sorted_edge(t[0], t[1])};
    Remeshing_options options;
    options.number_of_samples = n;
    const Surface_patches patches(surface, options);
    const Feature_samples& features = patches.features();
    CHECK(features.edges.size() + 1 == features.size());
    CHECK(features.size() >= (n == 20 ? 2u : 4u));
    for (std::size_t k = 0; k < features.size(); ++k) {
      REQUIRE(features.samples.facets[k] >= 0);
      const Triangle& u = surface.triangles[features.samples.facets[k]];
      const Vec3d& p = features.samples.points[k];
      const Vec3d q = nearest_point_on_triangle(p, surface.points[u[0]], surface.points[u[1]],
                                                surface.points[u[2]]);
      CHECK(length(q - p) < 1e-12);
      CHECK(length(features.samples.normals[k]) == doctest::Approx(1));
    }
    const Samples free = sample_surface(patches.surface(), options, features);
    const Extracted_mesh mesh =
        extract_by_insertion(surface, joined(patches.on_whole(free), features.samples), features);
    Remeshing_report report;
    report.samples_asked = n;
    assess(surface, mesh, report);
    CHECK(report.missed_guarantees().empty());
  }
}

TEST_CASE("surfaces with one side only are cut open, sampled and sewn up again")
{
  // Klein's bottle as a torus that comes back mirrored; it passes through itself nowhere in this
  // test's sense: only its topology counts.
  shapes::Soup klein = shapes::torus(24, 12, 3, 1);
  for (Triangle& t : klein.triangles)
    for (int& v : t)
      if (v / 12 == 0 && std::any_of(t.begin(), t.end(), [](int w) { return w / 12 == 23; }))
        v = (12 - v) % 12;
  struct Case {
    shapes::Soup soup;
    std::size_t loops;
  };
  for (const Case& c :
       {Case{shapes::moebius_strip(60), 1},
        Case{shapes::some_reversed(shapes::moebius_strip(61), 4), 1}, Case{klein, 0},
        Case{shapes::klein_bottle(20, 12), 0}}) // two sheets have vertices at the same points
    for (const Preset preset : {Preset::quality, Preset::paper}) {
      Surface surface = shapes::make_surface(c.soup);
      CHECK_FALSE(surface.seams.empty());
      CHECK(surface.seams == surface.creases);
      Remeshing_options options = Remeshing_options::of(preset);
      options.number_of_samples = 300;
      const Surface_patches patches(surface, options);
      CHECK(topology(patches.surface().triangles).oriented);
      const Samples free = sample_surface(patches.surface(), options, patches.features());
      const Opened_surface opened(
          surface, joined(patches.on_whole(free), patches.features().samples), patches.features());
      Extracted_mesh mesh = extract_by_insertion(opened.surface(), opened.samples(),
                                                 opened.features(), opened.seams());
      CHECK(topology(mesh.triangles).oriented);
      CHECK(mesh.points.size() > 300);
      Opened_surface::sew_up(mesh);
      CHECK(mesh.points.size() == 300);
      CHECK(internal::lost_feature_edges(mesh) == 0);
      const Topology_statistics is = topology(mesh.triangles), was = topology(surface.triangles);
      CHECK(is.vertices == 300);
      CHECK_FALSE(is.oriented);
      CHECK(is.euler_characteristic == was.euler_characteristic);
      CHECK(is.components == 1);
      CHECK(is.border_loops == c.loops);
      CHECK(was.border_loops == c.loops);
      CHECK(is.non_manifold_edges + is.non_manifold_vertices == 0);
    }
}

TEST_CASE("a sample that comes to lie on a seam is no vertex of one sheet there")
{
  shapes::Soup fin = shapes::plane_patch(4, 4), wall = fin; // on a floor
  for (Vec3d& p : wall.points) p = {0.5, p.y, p.x};
  fin = shapes::joined(fin, wall);
  Remeshing_options options;
  options.number_of_samples = 300;
  Repair_counts repairs;
  Surface surface =
      import_soup(fin.points, fin.triangles, repairs, Repair::yes, Non_manifold::keep);
  const Surface_patches patches(surface, options);
  const Samples free = sample_surface(patches.surface(), options, patches.features());
  Samples samples = joined(patches.on_whole(free), patches.features().samples);
  const Edge seam = surface.seams.front();
  samples.points[0] = 0.63 * surface.points[seam[0]] + 0.37 * surface.points[seam[1]];
  samples.facets[0] = 0;
  const auto has = [&](int v) {
    const Triangle& t = surface.triangles[samples.facets[0]];
    return std::find(t.begin(), t.end(), v) != t.end();
  };
  while (!has(seam[0]) || !has(seam[1])) ++samples.facets[0];
  const Opened_surface opened(surface, samples, patches.features());
  Extracted_mesh mesh =
      extract_by_insertion(opened.surface(), opened.samples(), opened.features(), opened.seams());
  Opened_surface::sew_up(mesh);
  const Topology_statistics is = topology(mesh.triangles), was = topology(surface.triangles);
  CHECK(was.junctions == 1);
  CHECK(is.junctions == 1);
  CHECK(is.border_loops == was.border_loops);
  CHECK(is.euler_characteristic == was.euler_characteristic);
}

TEST_CASE("density does not see a crease as curvature")
{
  Remeshing_options options;
  options.number_of_samples = 500;
  Surface surface = shapes::with_creases(shapes::box(8), 500);
  set_density(surface, options);
  for (double rho : surface.vertex_density) CHECK(rho == doctest::Approx(1));
}

TEST_CASE("where an edge joins two copies of a vertex, sewing up collapses it")
{
  Extracted_mesh mesh;
  mesh.points = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {0, 4, 3}, {1, 5, 2}, {1, 3, 5}};
  mesh.places = {7, 7, -1, -1, -1, -1};
  mesh.feature_edges = {{0, 1}, {0, 4}};
  Opened_surface::sew_up(mesh);
  CHECK(mesh.points.size() == 5);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 3}, {0, 2, 4}, {0, 3, 2}, {0, 4, 1}});
  CHECK(mesh.feature_edges == std::vector<Edge>{{0, 3}});
}

TEST_CASE("points of different places are not sewn up")
{
  Extracted_mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.places = {4, -1, -1, 4, -1, -1};
  Opened_surface::sew_up(mesh);
  CHECK(mesh.points.size() == 5);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 3, 4}});
  CHECK(mesh.places.empty());
}

TEST_CASE("no edge joins two places that another sheet joins already")
{
  using Vertex = internal::Working_mesh::Vertex;
  // Two squares; 0 and 2 of the first are copies of 4 and 6 of the second.
  const std::vector<Vec3d> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                     {0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}};
  internal::Working_mesh m(points, {{0, 1, 3}, {1, 2, 3}, {4, 5, 6}, {4, 6, 7}},
                           CGAL::Sequential_tag());
  const auto edge = [&](int a, int b) {
    return m.mesh.edge(m.mesh.halfedge(Vertex(a), Vertex(b)));
  };
  CHECK(m.is_flippable(edge(1, 3)));
  CHECK(m.is_flippable(edge(4, 6)));
  m.set_places({7, -1, 8, -1, 7, -1, 8, -1});
  CHECK(m.copies(7) == std::vector<Vertex>{Vertex(0), Vertex(4)});
  CHECK_FALSE(m.is_flippable(edge(1, 3)));
  CHECK(m.is_flippable(edge(4, 6)));
  CHECK(m.are_joined_elsewhere(Vertex(0), Vertex(2)));
  CHECK_FALSE(m.are_joined_elsewhere(Vertex(4), Vertex(6)));
  CHECK(m.are_joined_elsewhere(Vertex(0), Vertex(4)));         // copies of one
  CHECK(m.joins_twice(m.mesh.halfedge(Vertex(1), Vertex(0)))); // it would join 0 and 2
  CHECK_FALSE(m.joins_twice(m.mesh.halfedge(Vertex(5), Vertex(4))));
  m.set_places({7, -1, 7, -1, -1, -1, -1, -1}); // 1 is joined to both copies
  CHECK(m.are_joined_elsewhere(Vertex(1), Vertex(0)));
  CHECK_FALSE(m.are_joined_elsewhere(Vertex(1), Vertex(3)));
}

TEST_CASE("curves without length get samples, too")
{
  Surface surface; // two of its vertices are at the same point
  surface.points = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}};
  surface.vertex_density = {1, 1, 1};
  const std::vector<Feature_curve> curves = {{{0, 1}, true, 2}, {{0, 1}, true, 2}, {{1, 2}}};
  const internal::Curve_sampler sampler(surface, curves);
  const Curve_samples samples = sampler.run(0.5);
  CHECK(samples.places.size() == sampler.count(0.5));
  CHECK(samples.places.size() == 6); // three corners, one on each curve
  for (const Edge_place& p : samples.places) CHECK(0 <= p.at);
}
