// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the samples are too sparse for the surface, the extraction goes on with more care.
#include "dirty_shapes.h"

#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/extraction/extract_guarded.h>
#include <CGAL/PowerRTF/extraction/separated_samples.h>
#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/geometry/cut_surface.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/geometry/self_intersections.h>
#include <CGAL/PowerRTF/quality/assess.h>
#include <CGAL/PowerRTF/quality/assess_impl.h>
#include <CGAL/PowerRTF/quality/topology.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <vector>

namespace PRTF = CGAL::PowerRTF;
using PRTF::Extracted_mesh;
using PRTF::Samples;
using PRTF::Surface;
using PRTF::Triangle;
using PRTF::Vec3d;
using PRTF::internal::Intersection_guard;
using PRTF::internal::Working_mesh;

namespace {

Samples random_samples(const Surface& surface, std::size_t n, unsigned seed)
{
  PRTF::Remeshing_options options;
  options.number_of_samples = n;
  options.sampling = PRTF::Sampling::random; // worse than any that are optimized
  options.random_seed = seed;
  return PRTF::sample_surface(surface, options);
}

/// Two parallel squares, `gap` apart, closed at their rims, with `holes` square tubes between them.
shapes::Soup thin_plate(int holes, double gap)
{
  shapes::Soup s = shapes::plate_with_holes(holes, 4);
  for (Vec3d& p : s.points) p.z *= gap;
  return s;
}

void check_all_promises(const Surface& surface, const Extracted_mesh& mesh, std::size_t n)
{
  const auto in = PRTF::topology(surface.triangles), out = PRTF::topology(mesh.triangles);
  CHECK(out.vertices == n);
  CHECK(out.non_manifold_edges == 0);
  CHECK(out.non_manifold_vertices == 0);
  CHECK(out.oriented);
  CHECK(out.components == in.components);
  CHECK(out.euler_characteristic == in.euler_characteristic);
  CHECK(PRTF::self_intersections(mesh.points, mesh.triangles) == 0);
}

/// Slanted needles side by side and two triangles with a common edge beside them: none meet, but
/// their boxes overlap.
Working_mesh stacked_needles(int count)
{
  std::vector<Vec3d> points{{0, 0, 0}, {1, 0, 1}, {1, 0.001, 1}, {0, 0.001, 0}};
  std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
  for (int k = 1; k <= count; ++k) {
    const double y = 0.0002 + 0.0007 * k / count;
    const int first = int(points.size());
    points.insert(points.end(), {{0, y, 0.1}, {0.5, y, 0.6}, {0.5, y + 0.0003 / count, 0.6}});
    triangles.push_back({first, first + 1, first + 2});
  }
  return Working_mesh(points, triangles, CGAL::Sequential_tag());
}

} // namespace

TEST_CASE("balls of very different sizes contain the points that each of them contains")
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto point = [&] { return Vec3d{unit(random), unit(random), unit(random)}; };
  std::vector<PRTF::internal::Ball> balls;
  for (int k = 0; k < 300; ++k) balls.push_back({point(), std::pow(10., -4 * unit(random))});
  for (const double factor : {0.05, 0.2, 2.}) {
    const PRTF::internal::Ball_union fast(balls, factor);
    int inside = 0;
    for (int k = 0; k < 2000; ++k) {
      const Vec3d p = point();
      const bool is_inside = std::any_of(balls.begin(), balls.end(), [&](const auto& ball) {
        return PRTF::length(p - ball.center) < factor * ball.radius;
      });
      CHECK(fast.contains(p) == is_inside);
      inside += is_inside;
    }
    CHECK(inside > 0);
  }
  CHECK_FALSE(PRTF::internal::Ball_union({}, 1).contains({0, 0, 0}));
}

TEST_CASE("a guard that has judged too many pairs of triangles allows no more changes")
{
  const Working_mesh m = stacked_needles(2000);
  const Intersection_guard guard(m, std::vector<Intersection_guard::Sight>(
                                        m.mesh.num_vertices(), Intersection_guard::watched));
  const auto e = m.mesh.edge(m.mesh.halfedge(Working_mesh::Vertex(0), Working_mesh::Vertex(2)));
  int allowed = 0;
  const int most = 1000000;
  while (allowed < most && !guard.forbids_flip(e)) ++allowed;
  CHECK(allowed > 1000);
  CHECK(allowed < most);
  CHECK(guard.forbids_flip(e));
}

TEST_CASE("thin plates with holes and few, badly distributed samples")
{
  for (const int holes : {0, 1, 3})
    for (const double gap : {0.3, 0.02})
      for (const std::size_t n : {std::size_t(60), std::size_t(200)})
        for (const unsigned seed : {1u, 2u, 3u}) {
          CAPTURE(holes);
          CAPTURE(gap);
          CAPTURE(n);
          CAPTURE(seed);
          const Surface surface =
              shapes::make_surface(shapes::rotated(thin_plate(holes, gap), 0.3));
          const Samples samples = random_samples(surface, n, seed);
          check_all_promises(surface, PRTF::extract_by_insertion(surface, samples), n);
        }
}

TEST_CASE("samples that are all on one side: those that are missed come from there")
{
  const Surface surface = shapes::make_surface(shapes::torus(40, 20, 2, 0.6));
  Samples samples = random_samples(surface, 400, 5);
  Samples half;
  for (std::size_t s = 0; s < samples.size(); ++s)
    if (samples.points[s].x > 0.02) {
      half.points.push_back(samples.points[s]);
      half.facets.push_back(samples.facets[s]);
      half.normals.push_back(samples.normals[s]);
    }
  const Extracted_mesh mesh = PRTF::extract_by_insertion(surface, half);
  check_all_promises(surface, mesh, half.size());
}

TEST_CASE("all samples lie on a border: another component gets some of them")
{
  const Surface surface = shapes::make_surface(shapes::joined(
      shapes::plane_patch(10, 10), shapes::translated(shapes::icosphere(2), {5, 0, 0})));
  const auto features = PRTF::sample_features(surface, PRTF::cut_along_creases(surface), 2000);
  REQUIRE(features.size() > 20);
  const Extracted_mesh mesh = PRTF::extract_by_insertion(surface, features.samples, features);
  check_all_promises(surface, mesh, features.size());
  CHECK(PRTF::topology(mesh.triangles).border_loops == 1);
  CHECK(PRTF::internal::lost_feature_edges(mesh) == 0);
  CHECK(mesh.feature_edges.size() < features.size());
  std::size_t corners = 0;
  for (std::size_t s = 0; s < features.size(); ++s)
    if (features.places[s].from == features.places[s].to)
      corners += mesh.points[s] == features.samples.points[s];
  CHECK(corners >= 4);
}

TEST_CASE("fewer samples than the topology needs: vertices of the surface stay, nothing intersects")
{
  const Surface surface = shapes::make_surface(shapes::plate_with_holes(3, 3));
  const Samples samples = random_samples(surface, 8, 1);
  const Extracted_mesh mesh = PRTF::extract_by_insertion(surface, samples);
  const auto out = PRTF::topology(mesh.triangles);
  CHECK(out.euler_characteristic == -4);
  CHECK(out.vertices > 8);
  CHECK(out.non_manifold_vertices == 0);
  CHECK(PRTF::self_intersections(mesh.points, mesh.triangles) == 0);
}

TEST_CASE("the guard knows which flips and collapses add intersections")
{
  // A flat square of four triangles around a vertex, and a needle through one of them.
  PRTF::internal::Refined_surface refined;
  refined.points = {{0, 0, 0},       {1, 0, 0},        {1, 1, 0},        {0, 1, 0},
                    {0.5, 0.3, 0.2}, {0.5, 0.45, 0.1}, {0.45, 0.5, 0.1}, {0.5, 0.5, -1}};
  refined.normals.assign(8, Vec3d{0, 0, 1});
  refined.samples = {0, 1, 2, 3, -1, 4, 5, 6};
  refined.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {5, 6, 7}};
  for (const double height : {0.4, 0.05}) { // the needle's upper end, below and above the tent
    refined.points[4].z = height;
    refined.points[7].z = height == 0.4 ? 0.05 : 0.2;
    const Working_mesh mesh{PRTF::internal::Refined_surface(refined)};
    for (const auto sight : {Intersection_guard::watched, Intersection_guard::unknown}) {
      const Intersection_guard guard(mesh, std::vector<Intersection_guard::Sight>(8, sight));
      using Vertex = Working_mesh::Vertex;
      const auto h = mesh.mesh.halfedge(Vertex(4), Vertex(0));
      REQUIRE(h.is_valid());
      // Collapsed, the tent is the square; the needle is then above it or not.
      const bool crosses = refined.points[7].z * refined.points[5].z < 0;
      CHECK(guard.forbids_collapse(h) == (crosses && sight == Intersection_guard::watched));
    }
  }
}

TEST_CASE("samples at one point are taken apart, each in its facet")
{
  const Surface surface = shapes::make_surface(shapes::icosphere(1));
  Samples samples;
  const auto add = [&](const Vec3d& p, int facet) {
    samples.points.push_back(p);
    samples.facets.push_back(facet);
  };
  for (const int f : {3, 5}) { // at a corner, on an edge, at the center, and apart
    const Triangle& t = surface.triangles[f];
    const Vec3d a = surface.points[t[0]], b = surface.points[t[1]], c = surface.points[t[2]];
    for (int k = 0; k < 5; ++k) {
      add(a, f);
      add(0.5 * (a + b), f);
      add((1. / 3) * (a + b + c), f);
    }
    add(0.6 * a + 0.2 * b + 0.2 * c, f);
  }
  add(samples.points[0], 3); // fixed
  const Samples apart = PRTF::internal::separated_samples(surface, samples, 1);
  std::set<std::array<double, 3>> distinct;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const Vec3d p = apart.points[s];
    distinct.insert({p.x, p.y, p.z});
    const Triangle& t = surface.triangles[apart.facets[s]];
    const Vec3d q = PRTF::nearest_point_on_triangle(p, surface.points[t[0]], surface.points[t[1]],
                                                    surface.points[t[2]]);
    CHECK(length(p - q) < 1e-15);
  }
  CHECK(distinct.size() == samples.size());
  CHECK(apart.points.back() == samples.points.back());
  CHECK_FALSE(apart.points[0] == samples.points[0]); // the fixed one is there
  CHECK(apart.points[1] == samples.points[1]);
  CHECK(apart.points[15] == samples.points[15]);
  CHECK(PRTF::internal::separated_samples(surface, apart, 1).points == apart.points);
}
