// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes.h"

#include <CGAL/PowerRTF/extraction/decimate.h>
#include <CGAL/PowerRTF/extraction/delaunay_flips.h>
#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/extraction/extract_restricted_delaunay.h>
#include <CGAL/PowerRTF/extraction/insert_samples.h>
#include <CGAL/PowerRTF/extraction/separated_samples.h>
#include <CGAL/PowerRTF/geometry/self_intersections.h>
#include <CGAL/PowerRTF/quality/topology.h>
#include <CGAL/PowerRTF/sampling/random_source.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;

namespace {

Samples samples_on(const Surface& surface, std::size_t n, unsigned seed = 0,
                   Sampling sampling = Sampling::elimination)
{
  Remeshing_options o;
  o.number_of_samples = n;
  o.sampling = sampling;
  o.random_seed = seed;
  return sample_surface(surface, o);
}

// Samples at given barycentric coordinates.
struct Place {
  int facet;
  double a, b, c;
};
Samples samples_at(const Surface& surface, const std::vector<Place>& places)
{
  Samples samples;
  for (const Place& p : places) {
    const Triangle& t = surface.triangles[p.facet];
    samples.points.push_back(p.a * surface.points[t[0]] + p.b * surface.points[t[1]] +
                             p.c * surface.points[t[2]]);
    samples.facets.push_back(p.facet);
    samples.normals.push_back(surface.facet_normals[p.facet]);
  }
  return samples;
}

// The extraction's points are exactly the samples, not those of the output's grid.
Surface surface_of(const shapes::Soup& soup)
{
  Surface surface = shapes::make_surface(soup);
  surface.normalization.grid = 0;
  return surface;
}

// Of the first n points, how many are not the samples of these numbers.
std::size_t exchanged_samples(const Samples& samples, const Extracted_mesh& mesh)
{
  std::size_t count = 0;
  for (std::size_t s = 0; s < samples.size(); ++s) count += mesh.points[s] != samples.points[s];
  return count;
}

// The first n points are the samples; those that had to be exchanged, and points after them, are
// samples or vertices of the surface. The mesh has the surface's topology.
void check_topology(const Surface& surface, const Samples& samples, const Extracted_mesh& mesh)
{
  REQUIRE(mesh.points.size() >= samples.size());
  using Coordinates = std::array<double, 3>;
  std::set<Coordinates> vertices;
  for (const auto* points : {&surface.points, &samples.points})
    for (const Vec3d& p : *points) vertices.insert({p.x, p.y, p.z});
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vec3d& p = mesh.points[v];
    if (v >= samples.size() || p != samples.points[v]) CHECK(vertices.count({p.x, p.y, p.z}) == 1);
  }
  const Topology_statistics in = topology(surface.triangles), out = topology(mesh.triangles);
  CHECK(out.vertices == mesh.points.size());
  CHECK(out.euler_characteristic == in.euler_characteristic);
  CHECK(out.components == in.components);
  CHECK(out.border_loops == in.border_loops);
  CHECK(out.non_manifold_edges == 0);
  CHECK(out.non_manifold_vertices == 0);
  CHECK(out.oriented);
}

Triangle canonical(Triangle t)
{
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

std::set<Triangle> canonical(const std::vector<Triangle>& triangles)
{
  std::set<Triangle> result;
  for (const Triangle& t : triangles) result.insert(canonical(t));
  return result;
}

double signed_volume(const Extracted_mesh& mesh)
{
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    sum += dot(mesh.points[t[0]], cross(mesh.points[t[1]], mesh.points[t[2]])) / 6;
  return sum;
}

struct Shape {
  std::string name;
  shapes::Soup soup;
};

std::vector<Shape> all_shapes()
{
  using namespace shapes;
  return {{"tetrahedron", tetrahedron()},
          {"cube", box(1)},
          {"fine cube", box(8)},
          {"sphere", icosphere(3)},
          {"torus", torus(30, 12, 1, .4)},
          {"thin torus", torus(60, 8, 1, .05)},
          {"plane", plane_patch(10, 10)},
          {"triangle pair", plane_patch(1, 1)},
          {"cylinder", open_cylinder(20, 10, .5, 2)},
          {"thin disc", thin_disc(.01)},
          {"two spheres", two_spheres(2)},
          {"sphere and patch", joined(icosphere(2), translated(plane_patch(6, 6), {3, 0, 0}))}};
}

} // namespace

TEST_CASE("insertion keeps the topology of every shape, for any number of samples")
{
  for (const Shape& shape : all_shapes()) {
    const Surface surface = surface_of(shape.soup);
    for (const std::size_t n : {4, 5, 20, 500, 3000})
      for (unsigned seed = 0; seed < 3; ++seed)
        for (const Sampling sampling : {Sampling::elimination, Sampling::random}) {
          CAPTURE(shape.name);
          CAPTURE(n);
          CAPTURE(seed);
          const Samples samples = samples_on(surface, n, seed, sampling);
          const Extracted_mesh mesh = extract_by_insertion(surface, samples);
          check_topology(surface, samples, mesh);
          const bool is_closed = topology(surface.triangles).border_loops == 0;
          if (n >= (is_closed ? 20 : 500)) CHECK(mesh.points.size() == n);
          if (n >= 500 && sampling == Sampling::elimination)
            CHECK(exchanged_samples(samples, mesh) == 0);
        }
  }
}

TEST_CASE("a face that is said to be a part of a flat patch lies in it")
{
  for (const Shape& shape : all_shapes())
    for (const unsigned seed : {0u, 1u}) {
      CAPTURE(shape.name);
      CAPTURE(seed);
      const Surface surface = surface_of(shape.soup);
      const Flat_patches patches(surface, Flat_patches::coplanar_sine);
      std::map<int, int> facet_of; // one by patch
      for (int f = 0; f < int(surface.triangles.size()); ++f) facet_of[patches[f]] = f;
      internal::Working_mesh mesh(
          internal::insert_samples(surface, samples_on(surface, 150, seed, Sampling::elimination)));
      internal::Edge_flipper flipper(mesh, 0.1);
      flipper.push_around_samples();
      flipper.run(20 * mesh.mesh.number_of_edges());
      internal::Decimator(mesh, flipper).run();
      for (const auto face : mesh.mesh.faces()) {
        if (mesh.patches[face] < 0) continue;
        const int f = facet_of.at(mesh.patches[face]);
        const Vec3d& corner = surface.points[surface.triangles[f][0]];
        for (const auto v : mesh.mesh.vertices_around_face(mesh.mesh.halfedge(face)))
          CHECK(std::abs(dot(mesh.point(v) - corner, surface.facet_normals[f])) < 1e-6);
      }
    }
}

TEST_CASE("without self-intersections where samples are well distributed")
{
  for (const Shape& shape : all_shapes()) {
    const Surface surface = surface_of(shape.soup);
    for (const std::size_t n : {500, 3000}) {
      CAPTURE(shape.name);
      CAPTURE(n);
      const Extracted_mesh mesh = extract_by_insertion(surface, samples_on(surface, n));
      CHECK(self_intersections(mesh.points, mesh.triangles) == 0);
    }
  }
}

TEST_CASE("closed results are oriented outwards")
{
  for (const auto& soup : {shapes::icosphere(4), shapes::torus(40, 20, 1, .4)}) {
    const Surface surface = surface_of(soup);
    const double volume = signed_volume({surface.points, surface.triangles, {}});
    const Samples samples = samples_on(surface, 1000);
    CHECK(signed_volume(extract_by_insertion(surface, samples)) ==
          doctest::Approx(volume).epsilon(.05));
    CHECK(signed_volume(extract_restricted_delaunay(surface, samples)) ==
          doctest::Approx(volume).epsilon(.05));
  }
}

TEST_CASE("the surface's own vertices as samples give back all of them")
{
  for (const Shape& shape : all_shapes()) {
    CAPTURE(shape.name);
    const Surface surface = surface_of(shape.soup);
    std::vector<Place> places(surface.points.size(), {-1, 0, 0, 0});
    for (int f = 0; f < int(surface.triangles.size()); ++f)
      for (int i = 0; i < 3; ++i)
        places[surface.triangles[f][i]] = {f, double(i == 0), double(i == 1), double(i == 2)};
    const Samples samples = samples_at(surface, places);
    const Extracted_mesh mesh = extract_by_insertion(surface, samples);
    check_topology(surface, samples, mesh);
    CHECK(mesh.points == samples.points);
  }
}

TEST_CASE("samples on edges, from both sides, and at vertices")
{
  for (const Shape& shape : all_shapes()) {
    CAPTURE(shape.name);
    const Surface surface = surface_of(shape.soup);
    Random_source random(1);
    std::vector<Place> places;
    for (int f = 0; f < int(surface.triangles.size()); f += 2) {
      const double t = random();
      places.push_back({f, t, 1 - t, 0});
      places.push_back({f, 0, t, 1 - t});
      places.push_back({f, 1e-9, 0, 1 - 1e-9});
      places.push_back({f + 1, .5, 1e-12, .5 - 1e-12});
      places.push_back({f + 1, 1e-14, .25, .75});
    }
    const Samples samples = samples_at(surface, places);
    const Extracted_mesh mesh = extract_by_insertion(surface, samples);
    check_topology(surface, samples, mesh);
    if (topology(surface.triangles).border_loops == 0) CHECK(mesh.points.size() == samples.size());
  }
}

TEST_CASE("samples at the same place become separate vertices")
{
  for (const Shape& shape : all_shapes()) {
    CAPTURE(shape.name);
    const Surface surface = surface_of(shape.soup);
    std::vector<Place> places;
    for (int copy = 0; copy < 30; ++copy) {
      places.push_back({0, 1, 0, 0});
      places.push_back({0, .5, .5, 0});
      places.push_back({0, .2, .3, .5});
    }
    const Samples samples = samples_at(surface, places);
    const Samples apart = internal::separated_samples(surface, samples, 0);
    check_topology(surface, apart, extract_by_insertion(surface, samples));
  }
}

TEST_CASE("fewer samples than the topology needs: vertices of the surface stay")
{
  const Surface sphere = surface_of(shapes::two_spheres(2));
  const Extracted_mesh none = extract_by_insertion(sphere, Samples());
  check_topology(sphere, Samples(), none);
  CHECK(none.points.size() == 8);
  const Samples all_on_one = samples_at(
      sphere,
      {{0, .3, .3, .4}, {10, .3, .3, .4}, {20, .3, .3, .4}, {30, .3, .3, .4}, {40, .3, .3, .4}});
  const Extracted_mesh mesh = extract_by_insertion(sphere, all_on_one);
  check_topology(sphere, all_on_one, mesh);
  CHECK(mesh.points.size() == 8); // four on each
  const Surface torus = surface_of(shapes::torus(20, 10, 1, .4));
  const Extracted_mesh small = extract_by_insertion(torus, Samples());
  check_topology(torus, Samples(), small);
  CHECK(small.points.size() >= 7);
  CHECK(small.points.size() <= 10); // a mesh on 7, the fewest, is found, but it intersects itself
  CHECK(self_intersections(small.points, small.triangles) == 0);
}

TEST_CASE("an empty surface gives an empty mesh")
{
  CHECK(extract_by_insertion(Surface(), Samples()).triangles.empty());
  CHECK(extract_restricted_delaunay(Surface(), Samples()).triangles.empty());
}

TEST_CASE("samples that lie nowhere are refused")
{
  const Surface surface = surface_of(shapes::icosphere(1));
  Samples samples = samples_on(surface, 10);
  samples.facets[3] = int(surface.triangles.size());
  CHECK_THROWS_AS(extract_by_insertion(surface, samples), Invalid_input_error);
  samples.facets[3] = -1;
  CHECK_THROWS_AS(extract_by_insertion(surface, samples), Invalid_input_error);
  samples.facets[3] = 0;
  samples.points[3].y = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(extract_by_insertion(surface, samples), Invalid_input_error);
}

TEST_CASE("the order of the samples does not matter")
{
  for (const auto& soup : {shapes::icosphere(3), shapes::torus(30, 12, 1, .4), shapes::box(2)})
    for (unsigned seed = 0; seed < 3; ++seed) {
      const Surface surface = surface_of(soup);
      const Samples samples = samples_on(surface, 300, seed);
      std::vector<int> order(samples.size());
      std::iota(order.begin(), order.end(), 0);
      std::mt19937_64 random(seed + 1);
      for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
      Samples permuted;
      for (const int s : order) {
        permuted.points.push_back(samples.points[s]);
        permuted.facets.push_back(samples.facets[s]);
        permuted.normals.push_back(samples.normals[s]);
      }
      std::vector<Triangle> back = extract_by_insertion(surface, permuted).triangles;
      for (Triangle& t : back)
        for (int& v : t) v = order[v];
      CHECK(canonical(back) == canonical(extract_by_insertion(surface, samples).triangles));
    }
}

TEST_CASE("scaling by a power of two changes nothing")
{
  for (const auto& soup : {shapes::torus(30, 12, 1, .4), shapes::box(2)}) {
    Surface surface = surface_of(soup);
    Samples samples = samples_on(surface, 400);
    const auto before = extract_by_insertion(surface, samples).triangles;
    for (Vec3d& p : surface.points) p *= 0x1p-20;
    for (Vec3d& p : samples.points) p *= 0x1p-20;
    CHECK(extract_by_insertion(surface, samples).triangles == before);
  }
}

TEST_CASE("dense samples: the restricted Delaunay triangulation")
{
  for (const auto& soup : {shapes::icosphere(5), shapes::torus(120, 50, 1, .4)})
    for (unsigned seed = 0; seed < 3; ++seed) {
      const Surface surface = surface_of(soup);
      const Samples samples = samples_on(surface, 4000, seed);
      const Extracted_mesh inserted = extract_by_insertion(surface, samples),
                           restricted = extract_restricted_delaunay(surface, samples);
      check_topology(surface, samples, restricted);
      CHECK(inserted.points == samples.points);
      const std::set<Triangle> a = canonical(inserted.triangles),
                               b = canonical(restricted.triangles);
      CHECK(a.size() == b.size());
      std::vector<Triangle> only_one;
      std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(),
                                    std::back_inserter(only_one));
      CHECK(only_one.size() < a.size() / 200); // nearly cocircular
    }
}

TEST_CASE("restricted Delaunay triangulation with borders, in space and in a plane")
{
  for (const auto& soup : {shapes::plane_patch(10, 10), shapes::open_cylinder(20, 10, .5, 2)}) {
    const Surface surface = surface_of(soup);
    std::vector<Place> places(surface.points.size(), {-1, 0, 0, 0}); // borders need samples
    for (int f = 0; f < int(surface.triangles.size()); ++f)
      for (int i = 0; i < 3; ++i)
        places[surface.triangles[f][i]] = {f, double(i == 0), double(i == 1), double(i == 2)};
    for (const Samples& samples : {samples_at(surface, places), samples_on(surface, 500)}) {
      const Extracted_mesh mesh = extract_restricted_delaunay(surface, samples);
      CHECK(mesh.points == samples.points);
      double area = 0, wrong = 0;
      for (const Triangle& t : mesh.triangles) {
        const Vec3d n =
            cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
        area += length(n) / 2;
        wrong += dot(n, samples.normals[t[0]]) < 0;
      }
      CHECK(area == doctest::Approx(surface.area).epsilon(.12));
      CHECK(wrong == 0);
    }
  }
}
