// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Packed trees and the searches in them, against exact arithmetic and brute force.
#include "shapes.h"

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/hilbert_code.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/squared_distance_3.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using doctest::Approx;

namespace {

constexpr double every_angle = -2; // cosine of Theta: all pairs are compatible

double unit(std::mt19937& random) { return random() / 4294967296.; }

Vec3d random_direction(std::mt19937& random)
{
  for (;;) {
    const Vec3d v{2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1};
    if (squared_length(v) < 1 && squared_length(v) > 0.01) return normalized(v);
  }
}

} // namespace

TEST_CASE("layout of packed trees: every item in one leaf, every node below the root")
{
  for (int n : {0, 1, 2, 7, 8, 9, 63, 64, 65, 511, 512, 513, 4095, 4096, 4097, 100000}) {
    CAPTURE(n);
    const Packed_tree_layout tree(n);
    int levels = n > 0 ? 1 : 0, below = (n + 7) / 8, nodes = below;
    for (; below > 1; ++levels) nodes += below = (below + 7) / 8;
    CHECK(tree.levels == levels);
    CHECK(tree.nodes() == nodes);
    if (n > 0) CHECK(tree.nodes(tree.levels - 1) == 1);

    std::vector<int> visits(n, 0), entered(nodes, 0);
    traverse(
        tree,
        [&](int node) {
          ++entered[node];
          return true;
        },
        [&](int begin, int end) {
          CHECK(end - begin <= 8);
          for (int k = begin; k < end; ++k) ++visits[k];
        });
    CHECK(std::count(visits.begin(), visits.end(), 1) == n);
    CHECK(std::count(entered.begin(), entered.end(), 1) == std::max(0, nodes - 1)); // not the root
  }
}

TEST_CASE("nearest point of a triangle against exact arithmetic")
{
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  std::mt19937 random(1);
  const auto point = [&]() { return Vec3d{unit(random), unit(random), unit(random)}; };
  const auto exact = [](const Vec3d& p) { return Kernel::Point_3(p.x, p.y, p.z); };
  for (int k = 0; k < 300; ++k) {
    const Vec3d a = point(), b = point(), c = point(), p = 2 * point() - Vec3d{0.5, 0.5, 0.5};
    const Vec3d q = nearest_point_on_triangle(p, a, b, c);
    const double expected = CGAL::to_double(
        CGAL::squared_distance(exact(p), Kernel::Triangle_3(exact(a), exact(b), exact(c))));
    CHECK(squared_length(q - p) == Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("nearest facet against brute force")
{
  for (const shapes::Soup& soup : {shapes::torus(30, 15, 1, 0.4), shapes::box(1),
                                   shapes::thin_disc(0.05, 8), shapes::tetrahedron()}) {
    const Surface surface = shapes::make_surface(soup);
    const Facet_tree tree(surface.points, surface.triangles);
    const int facets = int(surface.triangles.size());
    std::mt19937 random(7);
    for (int k = 0; k < 200; ++k) {
      const Vec3d p{1.4 * unit(random) - 0.7, 1.4 * unit(random) - 0.7, 1.4 * unit(random) - 0.7};
      const Vec3d normal = random_direction(random);
      for (double cos_angle : {every_angle, 0.5}) {
        double least = std::numeric_limits<double>::infinity();
        for (int f = 0; f < facets; ++f) {
          if (!(dot(surface.facet_normals[f], normal) > cos_angle)) continue;
          const Triangle& t = surface.triangles[f];
          const Vec3d q = nearest_point_on_triangle(p, surface.points[t[0]], surface.points[t[1]],
                                                    surface.points[t[2]]);
          least = std::min(least, squared_length(q - p));
        }
        for (int hint : {-1, int(random() % facets)}) {
          const Surface_point<double> q = tree.nearest(p, normal, cos_angle, hint);
          if (std::isinf(least)) {
            CHECK(q.facet == -1);
            continue;
          }
          REQUIRE(q.facet >= 0);
          CHECK(q.squared_distance == least);
          CHECK(squared_length(q.point - p) == least);
          CHECK(dot(surface.facet_normals[q.facet], normal) > cos_angle);
        }
      }
    }
  }
}

TEST_CASE("the Hilbert curve visits every cube once and has no leaps")
{
  constexpr int side = 16;
  std::vector<std::pair<std::uint64_t, int>> along;
  for (int i = 0; i < side * side * side; ++i) {
    const std::uint32_t x = i % side, y = i / side % side, z = i / (side * side);
    along.emplace_back(hilbert_index(x, y, z), i);
  }
  std::sort(along.begin(), along.end());
  for (std::size_t k = 0; k + 1 < along.size(); ++k) {
    const int a = along[k].second, b = along[k + 1].second;
    const int distance = std::abs(a % side - b % side) +
                         std::abs(a / side % side - b / side % side) +
                         std::abs(a / (side * side) - b / (side * side));
    CHECK(distance == 1);
  }
  CHECK(along.front().first == 0);
  CHECK(along.back().first == std::uint64_t(side * side * side - 1));
  // Points outside are taken as at the border, and rounding decides on no plane of symmetry.
  CHECK(hilbert_code(Vec3d{-7, -7, -7}) == hilbert_index(0, 0, 0));
  for (const double x : {-0.5, -0.25, 0., 0.25, 0.5})
    CHECK(hilbert_code(Vec3d{x - 1e-15, x, x}) == hilbert_code(Vec3d{x + 1e-15, x, x}));
}

TEST_CASE("the Hilbert curve is the same from the table")
{
  const auto& table = CGAL::PowerRTF::internal::Hilbert_table::get();
  std::uint64_t bits = 1;
  const auto coordinate = [&bits] {
    bits = bits * 6364136223846793005u + 1442695040888963407u;
    return std::uint32_t(bits >> 43);
  };
  const std::uint32_t last = 0x1fffff;
  for (const std::uint32_t x : {0u, 1u, last})
    for (const std::uint32_t y : {0u, 2u, last})
      for (const std::uint32_t z : {0u, 4u, last})
        CHECK(table.index({x, y, z}) == hilbert_index(x, y, z));
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t x = coordinate(), y = coordinate(), z = coordinate();
    REQUIRE(table.index({x, y, z}) == hilbert_index(x, y, z));
  }
}
