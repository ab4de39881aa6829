// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Creases: found, pruned, thinned out where they are close, and cut along.
#include <doctest/doctest.h>

#include "creased_surface.h"

#include <CGAL/PowerRTF/features/creases.h>
#include <CGAL/PowerRTF/features/flat_boundaries.h>
#include <CGAL/PowerRTF/features/narrow_patches.h>
#include <CGAL/PowerRTF/geometry/cut_surface.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

using namespace CGAL::PowerRTF;

TEST_CASE("creases of clean shapes are found, whatever size and place")
{
  for (const double scale : {1., 1e-6, 1e9}) {
    CHECK(find_creases(shapes::make_surface(shapes::scaled(shapes::box(7), scale)), 40, 3000)
              .size() == 12 * 7);
    CHECK(find_creases(shapes::make_surface(shapes::scaled(shapes::can(50, 6), scale)), 40, 3000)
              .size() == 100);
  }
  const shapes::Soup turned = shapes::rotated(shapes::translated(shapes::box(5), {3, 1, 2}), 1.1);
  CHECK(find_creases(shapes::make_surface(turned), 40, 3000).size() == 60);
  CHECK(find_creases(shapes::make_surface(shapes::permuted(turned, 3)), 40, 3000).size() == 60);
  CHECK(find_creases(shapes::make_surface(turned), 91, 3000).empty());
}

TEST_CASE("smooth and noisy shapes have no creases")
{
  CHECK(find_creases(shapes::make_surface(shapes::icosphere(3)), 40, 3000).empty());
  CHECK(find_creases(shapes::make_surface(shapes::torus(40, 20, 2, 1)), 40, 3000).empty());
  for (unsigned seed : {1, 2, 3}) {
    std::mt19937_64 random(seed);
    shapes::Soup rough = shapes::icosphere(4);
    for (Vec3d& p : rough.points) p *= 1 + 0.03 * (double(random() % 1000) / 1000);
    const Surface surface = shapes::make_surface(rough);
    CHECK(find_creases(surface, 180. - 1e-9, 3000).empty());
    CHECK(find_creases(surface, 40, 3000).empty());
  }
}

TEST_CASE("short dangling creases are noise")
{
  const Surface plane =
      shapes::make_surface(shapes::plane_patch(10, 10)); // vertex = 11 row + column
  const auto on_border = internal::border_vertices(plane);
  const auto pruned = [&](std::vector<Edge> edges) {
    internal::prune_creases(plane, on_border, 0.25, edges);
    return edges.size();
  };
  std::vector<Edge> across; // from border to border, 10 edges of length 0.1
  for (int v = 44; v < 54; ++v) across.push_back({v, v + 1});
  CHECK(pruned(across) == 10);
  std::vector<Edge> twig = across;
  twig.push_back({48, 59}); // a twig of two edges
  twig.push_back({59, 70});
  CHECK(pruned(twig) == 10);
  twig.push_back({70, 81}); // of three
  CHECK(pruned(twig) == 13);
  CHECK(pruned({{24, 25}, {25, 26}, {26, 27}, {27, 28}}) == 0); // a piece of 0.4
  CHECK(pruned({{24, 25}, {25, 26}, {26, 27}, {27, 28}, {28, 29}, {29, 30}}) == 6); // of 0.6
  CHECK(pruned({{24, 25}, {25, 36}, {35, 36}, {24, 35}}) == 0);                     // a small ring
}

TEST_CASE("a surface is cut into its patches")
{
  const Surface box = shapes::with_creases(shapes::box(4), 1000);
  const Cut_surface cut = cut_along_creases(box);
  const auto& patches = cut.surface.facet_patches;
  CHECK(std::set<int>(patches.begin(), patches.end()).size() == 6);
  CHECK(cut.surface.points.size() == 6 * 25);
  for (std::size_t v = 0; v < cut.originals.size(); ++v) {
    CHECK(cut.surface.points[v] == box.points[cut.originals[v]]);
    const Vec3d n = cut.surface.vertex_normals[v]; // that of one face
    CHECK(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) ==
          doctest::Approx(1).epsilon(1e-14));
  }
  for (std::size_t f = 0; f < box.triangles.size(); ++f)
    for (int i = 0; i < 3; ++i)
      CHECK(cut.originals[cut.surface.triangles[f][i]] == box.triangles[f][i]);

  SUBCASE("a crease that ends inside is a slit")
  {
    Surface plane = shapes::make_surface(shapes::plane_patch(4, 4));
    plane.creases = {{6, 7}, {7, 8}};
    const Cut_surface slit = cut_along_creases(plane);
    CHECK(slit.surface.points.size() == plane.points.size() + 1);
    CHECK(std::set<int>(slit.surface.facet_patches.begin(), slit.surface.facet_patches.end())
              .size() == 1);
  }
}

TEST_CASE("narrow patches are joined to a neighbor")
{
  shapes::Soup slab = shapes::box(6);
  for (Vec3d& p : slab.points) p.z *= 0.02;
  Surface surface = shapes::make_surface(slab);
  surface.creases = find_creases(surface, 40, 1000);
  CHECK(surface.creases.size() == 72);
  join_narrow_patches(surface, 0.001);
  CHECK(surface.creases.size() == 72);
  const double width = 0.1 * surface.normalization.scale; // wider than the four walls
  join_narrow_patches(surface, width);
  const Cut_surface cut = cut_along_creases(surface);
  const auto& patches = cut.surface.facet_patches;
  std::vector<double> areas(*std::max_element(patches.begin(), patches.end()) + 1, 0);
  for (std::size_t f = 0; f < patches.size(); ++f) areas[patches[f]] += surface.facet_areas[f];
  CHECK(areas.size() == 2); // the two large faces stay apart
  for (double area : areas) CHECK(area > 0.45 * surface.area);
}

TEST_CASE("of two close creases the one around the larger flat patch stays")
{
  // the box [-1, 1]^3 with the edges around its top cut off
  const double cut = 0.05;
  shapes::Soup box = shapes::box(8);
  for (Vec3d& p : box.points)
    if (p.z == 1)
      p = {p.x * (1 - cut), p.y * (1 - cut), 1};
    else if (p.z == 0.75)
      p.z = 1 - cut;
  for (const double height : {0.3, 3.}) { // the top is larger than a side, or smaller
    CAPTURE(height);
    shapes::Soup soup = box;
    for (Vec3d& p : soup.points)
      if (p.z < 1) p.z = 1 - cut - height * (1 - cut - p.z);
    Surface surface = shapes::make_surface(soup);
    surface.creases = find_creases(surface, 40, 500);
    join_narrow_patches(surface, 0.2 * surface.normalization.scale);
    double at_top = 0, at_sides = 0;
    for (const Edge& e : surface.creases) {
      const Vec3d a = surface.normalization.to_outside(surface.points[e[0]]);
      const Vec3d b = surface.normalization.to_outside(surface.points[e[1]]);
      if (std::abs(a.z - b.z) > 1e-9 || a.z < 1 - 2 * cut) continue;
      (a.z > 1 - 1e-9 ? at_top : at_sides) += length(b - a);
    }
    CHECK((height < 1 ? at_top : at_sides) > 7);
    CHECK((height < 1 ? at_sides : at_top) < 0.5);
  }
}

TEST_CASE("large flat faces end in creases where round ones begin")
{
  // a quarter of a tube of radius 1 between two plates of length 4, width 3
  const auto bent_plate = [](int steps) {
    std::vector<Vec3d> profile;
    for (int k = 0; k <= 16; ++k) profile.push_back({-4 + 0.25 * k, 0, 0});
    for (int k = 1; k < steps; ++k) {
      const double u = shapes::pi / 2 * k / steps;
      profile.push_back({std::sin(u), 0, 1 - std::cos(u)});
    }
    for (int k = 0; k <= 8; ++k) profile.push_back({1, 0, 1 + 0.5 * k});
    shapes::Soup s;
    for (const Vec3d& p : profile)
      for (int j = 0; j <= 6; ++j) s.points.push_back({p.x, 0.5 * j, p.z});
    for (int i = 0; i + 1 < int(profile.size()); ++i)
      for (int j = 0; j < 6; ++j)
        shapes::add_quad(s, 7 * i + j, 7 * i + 7 + j, 7 * i + 8 + j, 7 * i + j + 1);
    return s;
  };
  const Surface surface = shapes::make_surface(bent_plate(12));
  const double scale = surface.normalization.scale;
  const auto lengths = [&](const std::vector<Edge>& edges) {
    double sum = 0;
    for (const Edge& e : edges) {
      const Vec3d a = surface.points[e[0]], b = surface.points[e[1]];
      CHECK(length(b - a) == doctest::Approx(std::abs(b.y - a.y))); // across, not along
      sum += length(b - a) / scale;
    }
    return sum;
  };
  CHECK(lengths(flat_patch_boundaries(surface, {}, 0.3 * scale)) == doctest::Approx(6));
  // too narrow for rows of triangles
  CHECK(flat_patch_boundaries(surface, {}, 0.6 * scale).empty());
  // with so many samples every strip of the tube is wide: the surface is a polyhedron
  CHECK(flat_patch_boundaries(surface, {}, 0.01 * scale).empty());
  // a crease that comes too near
  std::vector<Edge> creases;
  for (int j = 0; j < 6; ++j) creases.push_back({15 * 7 + j, 15 * 7 + j + 1}); // at x = -0.25
  CHECK(lengths(flat_patch_boundaries(surface, creases, 0.3 * scale)) == doctest::Approx(6));
  CHECK(lengths(flat_patch_boundaries(surface, creases, 0.55 * scale)) == doctest::Approx(3));
}
