// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tuned cells of the GPU, their tree and their polygons in a ring, run on the host. (The
// kernels themselves: cuda/test/test_cuda_cells.cu.)
#include "host_groups.h"

using namespace host_groups;

TEST_CASE("the tree's layout has a root, and every item under it")
{
  for (int n : {0, 1, 2, 31, 32, 33, 1024, 1025, 40000}) {
    const Group_layout tree(n);
    CHECK((tree.levels == 0) == (n == 0));
    if (n == 0) continue;
    CHECK(tree.nodes(tree.levels - 1) == 1);
    CHECK(tree.below(0) == n);
    for (int level = 0; level < tree.levels; ++level)
      CHECK(tree.nodes(level) * 32 >= tree.below(level));
  }
}

TEST_CASE("a ring polygon cuts like the shared polygon")
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  auto memory = std::make_unique<Ring_memory<double, 32>>();
  for (int trial = 0; trial < 2000; ++trial) {
    Ring_polygon<double, 32> ring(*memory, trial % 32);
    Tangent_polygon<double> shared;
    ring.set_square(1);
    shared.set_square(1);
    for (int k = 0; k < 30; ++k) {
      const double a = uniform(random), b = uniform(random), c = 0.3 + 0.3 * uniform(random);
      ring.clip(a, b, c, k);
      shared.clip(a, b, c, k);
      if (ring.overflow) break;
      REQUIRE(ring.size == shared.size);
      if (ring.size == 0) break;
      int first = 0;
      while (first < ring.size &&
             std::hypot(ring.x(first) - shared.x[0], ring.y(first) - shared.y[0]) > 1e-12)
        ++first;
      REQUIRE(first < ring.size);
      for (int v = 0; v < ring.size; ++v) {
        const int r = (first + v) % ring.size;
        CHECK(std::hypot(ring.x(r) - shared.x[v], ring.y(r) - shared.y[v]) < 1e-12);
        CHECK(ring.edge(r) ==
              (shared.neighbor[v] < 0 ? 251 - shared.neighbor[v] : shared.neighbor[v]));
      }
    }
  }
}

TEST_CASE_TEMPLATE("regular cells are finished and right", Real, float, double)
{
  Input in = sphere(4000, 0.45, 1);
  const double tolerance = sizeof(Real) == 4 ? 4e-6 : 1e-13;
  SUBCASE("no weights") {}
  SUBCASE("weights")
  {
    std::mt19937 random(5);
    for (double& w : in.weights) w = 1e-4 * (random() % 1000) / 1000.0;
  }
  SUBCASE("large smooth weights")
  {
    for (std::size_t i = 0; i < in.points.size(); ++i)
      in.weights[i] = 0.01 * std::sin(3 * in.points[i].x);
  }
  const Comparison c = in.compare<Real>();
  CHECK(c.finished >= 0.98 * c.cells);
  CHECK(c.wrong_cycles == 0);
  CHECK(c.area_error < tolerance);
  CHECK(c.centroid_error < tolerance);
  CHECK(c.candidates < 40); // the tree finds them without looking at everything
}

TEST_CASE("smooth weights much larger than the squared spacing cost no precision")
{
  Input in = sphere(4000, 0.45, 1);
  const double h2 = 4 * 3.14159265358979 * 0.45 * 0.45 / 4000;
  for (const double amplitude : {30.0, 140.0}) { // rms about 20 and 100
    for (std::size_t i = 0; i < in.points.size(); ++i)
      in.weights[i] = amplitude * h2 * std::sin(3 * in.points[i].x + 2 * in.points[i].y);
    const Comparison c = in.compare<float>();
    CHECK(c.finished >= 0.1 * c.cells); // many lie far from their sites, near the guard radius
    CHECK(c.wrong_cycles == 0);
    CHECK(c.area_p99 <= 5e-7);
    CHECK(c.centroid_p99 <= 5e-7);
  }
}

TEST_CASE("two sheets: sites of the other sheet or patch do not count")
{
  Input in = sphere(2000, 0.45, 2);
  const Input inner = sphere(2000, 0.44, 3);
  SUBCASE("by normals")
  {
    for (std::size_t i = 0; i < inner.points.size(); ++i)
      in.add(inner.points[i], -inner.normals[i]);
  }
  SUBCASE("by patches")
  {
    for (std::size_t i = 0; i < inner.points.size(); ++i)
      in.add(inner.points[i], inner.normals[i], 0, 1);
  }
  const Comparison c = in.compare<float>();
  CHECK(c.finished >= 0.9 * c.cells);
  CHECK(c.wrong_cycles == 0);
  CHECK(c.area_error < 1e-5);
}

TEST_CASE("nothing wrong is called finished")
{
  Input in;
  SUBCASE("one site") { in.add({0, 0, 0}, {0, 0, 1}); }
  SUBCASE("two sites")
  {
    in.add({0, 0, 0}, {0, 0, 1});
    in.add({0.1, 0, 0}, {0, 0, 1});
  }
  SUBCASE("three sites")
  {
    in.add({0, 0, 0}, {0, 0, 1});
    in.add({0.1, 0, 0}, {0, 0, 1});
    in.add({0, 0.1, 0}, {0, 0, 1});
  }
  SUBCASE("all at one point")
  {
    for (int k = 0; k < 100; ++k) in.add({0.1, 0.2, 0.3}, {0, 0, 1});
  }
  SUBCASE("a huge weight")
  {
    in = sphere(500, 0.45, 4);
    in.weights[17] = 1;
  }
  SUBCASE("cocircular: a grid")
  {
    for (int x = 0; x < 20; ++x)
      for (int y = 0; y < 20; ++y) in.add({x / 64.0, y / 64.0, 0}, {0, 0, 1});
    const Comparison c = in.compare<float>();
    CHECK(c.area_error < 1e-6); // neighbors at corners may or may not have an edge of length 0
    return;
  }
  SUBCASE("a wheel: 40 cocircular sites around one")
  {
    in.add({0, 0, 0}, {0, 0, 1});
    for (int k = 0; k < 40; ++k)
      in.add({0.1 * std::cos(k * 0.15707963), 0.1 * std::sin(k * 0.15707963), 0}, {0, 0, 1});
  }
  const Comparison c = in.compare<float>();
  CHECK(c.wrong_cycles == 0);
  CHECK(c.area_error < 1e-5);
}

TEST_CASE("groups: sites above each other give each other no edge")
{
  // The tangent plane of the lower one is at a distance of rounding from the plane between them,
  // and parallel to it but for rounding.
  const double height = 0.1;
  const Input flat = sphere(1000, 0.45, 3);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> tilt(-0.1, 0.1);
  Input in;
  for (std::size_t i = 0; i < flat.points.size(); ++i) {
    const Vec3d normal =
        normalized(flat.normals[i] + Vec3d{tilt(random), tilt(random), tilt(random)});
    in.add(flat.points[i], normal);
    in.add(flat.points[i] + normal * height, normal, height * height);
  }
  const Comparison c = in.compare<double>();
  CHECK(c.finished > 300);
  CHECK(c.wrong_cycles == 0);
  CHECK(c.area_error < 1e-10);
}
