// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface as the samples see it: long facets whose corners' normals are far from their own are
// split, and everything keeps its place.
#include "shapes.h"

#include <CGAL/PowerRTF/features/Surface_patches.h>
#include <CGAL/PowerRTF/features/half_surface.h>
#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/features/split_bent_facets.h>
#include <CGAL/PowerRTF/geometry/cut_surface.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/halve_edges.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/geometry/split_at_centers.h>
#include <CGAL/PowerRTF/quality/topology.h>

#include <doctest/doctest.h>

#include <cmath>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using shapes::Soup;

namespace {

/// The side of a cone of radius 1 and height 3 with its base, one row of facets each.
Soup cone(int sides)
{
  Soup s;
  s.points = {{0, 0, 3}, {0, 0, 0}};
  for (int k = 0; k < sides; ++k)
    s.points.push_back(
        {std::cos(2 * shapes::pi * k / sides), std::sin(2 * shapes::pi * k / sides), 0});
  for (int k = 0; k < sides; ++k) {
    const int a = 2 + k, b = 2 + (k + 1) % sides;
    s.triangles.insert(s.triangles.end(), {{0, a, b}, {1, b, a}});
  }
  return s;
}

double area(const Surface& s, int f)
{
  const Triangle& t = s.triangles[f];
  return length(cross(s.points[t[1]] - s.points[t[0]], s.points[t[2]] - s.points[t[0]])) / 2;
}

bool knows_its_adjacency(const Surface& s)
{
  return s.adjacency.opposite == facet_adjacency(s.triangles, s.points.size()).opposite;
}

} // namespace

TEST_CASE("long facets at a tip are split; the pieces make up their facets")
{
  const std::size_t n = 3000;
  Surface whole = shapes::make_surface(cone(64));
  whole.vertex_density.assign(whole.points.size(), 1);
  Surface surface = whole;
  REQUIRE(has_long_bent_facets(surface, n));
  const std::vector<int> parents = split_bent_facets(surface, n);
  CHECK(!has_long_bent_facets(surface, n));
  REQUIRE(parents.size() == surface.triangles.size());
  CHECK(knows_its_adjacency(surface));

  std::vector<double> areas(whole.triangles.size(), 0);
  for (std::size_t f = 0; f < parents.size(); ++f) {
    const int p = parents[f];
    areas[p] += area(surface, int(f));
    CHECK(dot(surface.facet_normals[f], whole.facet_normals[p]) > 1 - 1e-12);
  }
  for (std::size_t f = 0; f < areas.size(); ++f) CHECK(areas[f] == Approx(whole.facet_areas[f]));
  CHECK(surface.area == Approx(whole.area));
  const auto before = topology(whole.triangles), after = topology(surface.triangles);
  CHECK(after.euler_characteristic == before.euler_characteristic);
  CHECK(after.border_edges == 0);
  CHECK(after.non_manifold_edges + after.non_manifold_vertices == 0);
  for (std::size_t v = 0; v < whole.points.size(); ++v) CHECK(surface.points[v] == whole.points[v]);

  // where the normal of the tip says little about the side, no facet feels it any more
  const double h = std::sqrt(surface.area / double(n));
  for (const Triangle& t : surface.triangles)
    for (const int v : t)
      if (v == 0)
        for (const int u : t) CHECK(length(surface.points[u] - surface.points[0]) < 3.5 * h);
}

TEST_CASE("a cut surface knows its adjacency: both sides of each crease are borders")
{
  Surface surface = shapes::make_surface(shapes::box(6));
  set_creases(surface, Remeshing_options());
  REQUIRE(surface.creases.size() == 12 * 6);
  const Surface cut = cut_along_creases(surface).surface;
  CHECK(knows_its_adjacency(cut));
  CHECK(cut.adjacency.border_edges == 2 * surface.creases.size());
}

TEST_CASE("facets that are short, or whose corners' normals agree, stay as they are")
{
  Surface sphere = shapes::make_surface(shapes::icosphere(2));
  CHECK(!has_long_bent_facets(sphere, 1000000)); // long, but nearly flat
  Surface coarse = shapes::make_surface(shapes::octahedron());
  CHECK(!has_long_bent_facets(coarse, 10)); // bent, but short
  CHECK(has_long_bent_facets(coarse, 1000));
}

TEST_CASE("density is interpolated, and asks for more pieces where it is high")
{
  Surface surface = shapes::make_surface(cone(16));
  for (std::size_t v = 0; v < surface.points.size(); ++v)
    surface.vertex_density[v] = surface.points[v].z > 0 ? 1 : 0.01;
  const std::vector<double> corners = surface.vertex_density;
  split_bent_facets(surface, 500);
  REQUIRE(surface.points.size() > corners.size());
  const double top = surface.points[0].z, bottom = surface.points[1].z;
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    const double at = (surface.points[v].z - bottom) / (top - bottom);
    CHECK(surface.vertex_density[v] == Approx(0.01 + at * 0.99));
  }
}

TEST_CASE("samples keep the facets of the whole surface")
{
  for (const bool has_creases : {false, true}) {
    CAPTURE(has_creases);
    Surface surface = shapes::make_surface(cone(32));
    Remeshing_options options;
    options.number_of_samples = 1000;
    options.feature_angle = has_creases ? 40 : 180;
    set_creases(surface, options);
    const Surface_patches patches(surface, options);
    const Surface& split = patches.surface();
    REQUIRE(split.triangles.size() > surface.triangles.size());
    CHECK((patches.features().size() > 0) == has_creases);
    CHECK(knows_its_adjacency(split));

    Samples centers; // of the facets
    for (std::size_t f = 0; f < split.triangles.size(); ++f) {
      const Triangle& t = split.triangles[f];
      centers.points.push_back((1 / 3.) *
                               (split.points[t[0]] + split.points[t[1]] + split.points[t[2]]));
      centers.facets.push_back(int(f));
    }
    const Samples on_whole = patches.on_whole(centers);
    for (std::size_t k = 0; k < centers.size(); ++k) {
      const Triangle& t = surface.triangles[on_whole.facets[k]];
      const Vec3d nearest = nearest_point_on_triangle(centers.points[k], surface.points[t[0]],
                                                      surface.points[t[1]], surface.points[t[2]]);
      CHECK(length(nearest - centers.points[k]) < 1e-12);
    }
    for (std::size_t k = 0; k < patches.features().sites.size(); ++k)
      CHECK(split.facet_patches[patches.features().sites.facets[k]] ==
            patches.features().sites.patches[k]);
  }
}

TEST_CASE("pieces of facets have their labels")
{
  Surface whole = shapes::make_surface(shapes::plane_patch(8, 5));
  const double left = whole.points.front().x, width = whole.points.back().x - left;
  const auto label = [&](const Surface& s, const Triangle& t) {
    return int(8 * ((s.points[t[0]].x + s.points[t[1]].x + s.points[t[2]].x) / 3 - left) / width);
  };
  const auto check = [&](const Surface& s) {
    REQUIRE(s.facet_labels.size() == s.triangles.size());
    for (std::size_t f = 0; f < s.triangles.size(); ++f)
      CHECK(s.facet_labels[f] == label(s, s.triangles[f]));
  };
  for (const Triangle& t : whole.triangles) whole.facet_labels.push_back(label(whole, t));
  check(half_surface(whole, {1, (whole.points.front().y + whole.points.back().y) / 2}));
  Surface halved = whole, split = whole;
  halve_edges(halved, {0, 7, 8, 40, 41});
  CHECK(halved.triangles.size() > whole.triangles.size());
  check(halved);
  split_at_centers(split, {3, 30});
  check(split);
}
