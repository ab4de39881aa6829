// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_lattice.h"
#include "shapes.h"

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/sampling/lattice_defects.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numeric>
#include <vector>

using namespace CGAL::PowerRTF;

namespace {

/// The integers of all nodes of a flat lattice.
struct Flat_defects {
  int nodes = 0, open = 0; ///< all, and those without a loop
  int around = 0;          ///< nodes whose loops contain the middle
  int wrong = 0;           ///< integers that are not as expected
};

/// \param index, dislocations of the loops that contain the middle of the square
Flat_defects flat_defects(Flat_lattice& flat, int index, int dislocations)
{
  std::vector<Lattice_edge> edges(flat.points.size() * Lattice_view::degree);
  Host_backend<CGAL::Sequential_tag> backend;
  const Point_tree tree(backend, flat.points.data(), static_cast<int>(flat.points.size()));
  Lattice_view view = flat.view();
  view.edges = edges.data();
  Flat_defects result;
  for (int leaf = 0; leaf < tree.view().leaves(); ++leaf)
    Find_neighbors_of_leaf{{view, tree.view(), 0, 0.85f}}(leaf);
  for (int i = 0; i < view.size; ++i) {
    const Node_loop loop(view, i);
    double turns = 0; // of the loop around the middle
    loop.for_each_step([&](int j, int k) {
      const Vec3f p = view.points[j], q = view.points[k];
      turns += std::atan2(p.x * q.y - p.y * q.x, p.x * q.x + p.y * q.y) / (2 * Flat_lattice::pi);
    });
    const bool is_around = std::lround(turns) == 1;
    ++result.nodes;
    result.open += loop.empty();
    result.around += is_around;
    result.wrong += orientation_index(view, loop) != (is_around ? index : 0);
    if (index == 0) result.wrong += dislocation(view, loop) != (is_around ? dislocations : 0);
  }
  return result;
}

Lattice_fields fields_of(const Surface& s, std::size_t n, unsigned seed)
{
  Remeshing_options o;
  o.number_of_samples = n;
  o.random_seed = seed;
  return lattice_fields(s, o, {}, Facet_tree(s.points, s.triangles));
}

} // namespace

TEST_CASE("a perfect lattice has no defects")
{
  for (unsigned seed = 0; seed < 5; ++seed) {
    Flat_lattice flat(600, seed, 0.3 + seed, 0.1f, {0.01 * seed, 0.02, 0});
    const Flat_defects defects = flat_defects(flat, 0, 0);
    CHECK(defects.wrong == 0);
    CHECK(defects.open < 0.25 * defects.nodes); // along the border
  }
}

TEST_CASE("loops around a singularity have its index, all others 0")
{
  for (const int index : {-1, 1})
    for (unsigned seed = 0; seed < 5; ++seed) {
      Flat_lattice flat(600, seed, 0.3 + seed, 0.1f, {0, 0, 0});
      flat.wind_directions(index);
      const Flat_defects defects = flat_defects(flat, index, 0);
      CHECK(defects.wrong == 0);
      CHECK(defects.around >= 3);
    }
}

TEST_CASE("loops around a dislocation count its rows, all others none")
{
  const float h = 0.1f;
  for (unsigned seed = 0; seed < 5; ++seed) {
    const double angle = 0.3 + seed;
    const Vec3d u{h * std::cos(angle), h * std::sin(angle), 0};
    const Vec3d v{h * std::cos(angle + Flat_lattice::pi / 3),
                  h * std::sin(angle + Flat_lattice::pi / 3), 0};
    for (const Vec3d& burgers : {u, v, u - v, -u}) {
      Flat_lattice flat(600, seed, angle, h, {0, 0, 0});
      flat.dislocate(burgers);
      const Flat_defects defects = flat_defects(flat, 0, 1);
      CHECK(defects.wrong == 0);
      CHECK(defects.around >= 3);
    }
  }
}

TEST_CASE("the indices on a closed surface add up to six times the Euler characteristic")
{
  // Each singularity is inside three loops, those of the corners of its triangle of nodes, but for
  // a few where four cells nearly meet.
  constexpr int loops = 3, few = 2;
  for (unsigned seed = 0; seed < 6; ++seed) {
    const auto sum = [&](const shapes::Soup& soup) {
      const std::vector<int> indices = fields_of(shapes::make_surface(soup), 800, seed).indices;
      CHECK(std::count_if(indices.begin(), indices.end(), [](int i) { return i != 0; }) >= 30);
      return std::accumulate(indices.begin(), indices.end(), 0);
    };
    CHECK(std::abs(sum(shapes::icosphere(4)) - loops * 12) <= few);
    CHECK(std::abs(sum(shapes::ellipsoid(3, 2, 1, 4)) - loops * 12) <= few);
    CHECK(std::abs(sum(shapes::torus(60, 30, 2, 0.8))) <= few); // thin enough to have some
    CHECK(std::abs(sum(shapes::two_spheres(3)) - loops * 24) <= few);
  }
}

TEST_CASE("the fields are tangent, have the lattice's spacing and about as many points as samples")
{
  const std::size_t n = 1000;
  for (const shapes::Soup& soup : {shapes::icosphere(4), shapes::torus(60, 30, 2, 0.8)}) {
    const Surface s = shapes::make_surface(soup);
    const Lattice_fields fields = fields_of(s, n, 0);
    const double h = std::sqrt(2 / std::sqrt(3.) * s.area / double(n));
    REQUIRE(fields.nodes.size() == 4 * n);
    double worst = 0, least = 2 * h, most = 0;
    for (std::size_t i = 0; i < fields.nodes.size(); ++i) {
      worst = std::max({worst, std::abs(length(fields.normals[i]) - 1),
                        std::abs(length(fields.axes[i]) - 1),
                        std::abs(dot(fields.normals[i], fields.axes[i]))});
      least = std::min(least, fields.spacing[i]);
      most = std::max(most, fields.spacing[i]);
    }
    CHECK(worst < 1e-5);
    CHECK(least > 0.9 * h);
    CHECK(most < 1.05 * h);
    CHECK(fields.points.size() > 0.9 * n);
    CHECK(fields.points.size() < 1.3 * n); // twins among them
    REQUIRE(fields.point_nodes.size() == fields.points.size());
    double farthest = 0;
    for (std::size_t k = 0; k < fields.points.size(); ++k)
      farthest =
          std::max(farthest, length(fields.points[k] - fields.nodes[fields.point_nodes[k]]) / h);
    CHECK(farthest < 1);
  }
}

TEST_CASE("components too small for a lattice have no points of one")
{
  const Surface s = shapes::make_surface(
      shapes::joined(shapes::icosphere(3),
                     shapes::translated(shapes::scaled(shapes::icosphere(2), 0.1), {3, 0, 0})));
  const Lattice_fields fields = fields_of(s, 500, 0);
  // The small one, a tenth as large, is 3 of 4.1 lengths away.
  double low = 1, high = -1;
  for (const Vec3d& p : s.points) {
    low = std::min(low, p.x);
    high = std::max(high, p.x);
  }
  const auto is_small = [&](const Vec3d& p) { return p.x > 0.3 * low + 0.7 * high; };
  CHECK(std::any_of(fields.nodes.begin(), fields.nodes.end(), is_small));
  CHECK(std::none_of(fields.points.begin(), fields.points.end(), is_small));
  CHECK(fields.points.size() > 400);
}

TEST_CASE("other samples than a lattice's have no fields")
{
  const Surface s = shapes::make_surface(shapes::icosphere(2));
  const Facet_tree tree(s.points, s.triangles);
  Remeshing_options o;
  o.number_of_samples = 100;
  o.sampling = Sampling::stratified;
  CHECK_THROWS_AS(lattice_fields(s, o, {}, tree), Invalid_input_error);
}
