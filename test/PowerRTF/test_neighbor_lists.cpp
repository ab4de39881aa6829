// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cells from neighbor lists that were made when sites and weights were others, against the oracle.
#include "fast_cells.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace CGAL::PowerRTF;
using namespace fast_cells;
using random_input::Random;
using Backend = Host_backend<CGAL::Sequential_tag>;
using Tree = Tree_cells<double, Backend>;

namespace {

double spacing(const Cloud& cloud)
{
  double r2 = 0;
  for (const Vec3d& p : cloud.samples.points)
    r2 = std::max(r2, squared_length(p - cloud.samples.points[0]));
  return std::sqrt(r2 / double(cloud.size()));
}

/// Moves the sites by up to `size` times h, and changes the weights by as much times h^2.
void change(Cloud& cloud, double h, double size, Random& r)
{
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Vec3d& n = cloud.samples.normals[i];
    cloud.samples.points[i] += r.direction() * (size * h * r.real(0, 1));
    cloud.samples.weights[i] += size * h * h * r.real(-1, 1);
    n = normalized(n + r.direction() * (0.1 * size));
  }
}

Cell_comparison compare(Tree& tree, const Cloud& cloud)
{
  return check_cells<CGAL::Sequential_tag>(cloud.samples, construct(tree, cloud), cloud.cos_angle);
}

/// The cells of `tree`, which has seen other sites, and those of one that has not.
void check(Tree& tree, const Cloud& cloud, double h)
{
  const Cell_comparison c = compare(tree, cloud);
  Tree other(tree.backend(), int(cloud.size()), cloud.cos_angle, h, {});
  const Cell_comparison d = compare(other, cloud);
  CHECK(c.cells == cloud.size());
  CHECK(c.worst_edge <= 1);
  CHECK(c.certified_wrong == 0);
  CHECK(d.certified_wrong == 0);
}

} // namespace

TEST_CASE("cells from old lists are the oracle's")
{
  for (const Family& family : families()) {
    CAPTURE(family.name);
    Random r(7);
    Cloud cloud = family.make(400, r);
    sort(cloud);
    const double h = spacing(cloud);
    Backend backend;
    Tree tree(backend, int(cloud.size()), cloud.cos_angle, h, {});
    for (const double size : {0., 0., 1e-9, 1e-3, 0.02, 0.05, 0.2, 0.02, 1., 0.1, 0.}) {
      CAPTURE(size);
      change(cloud, h, size, r);
      check(tree, cloud, h);
    }
  }
}

TEST_CASE("weights that vary smoothly, and by far more than the distances")
{
  Random r(3);
  Cloud cloud = sample_families::even_sphere(2000, 0.2, r);
  sort(cloud);
  const double h = std::sqrt(sample_families::pi / 2000); // radius 1/2
  Backend backend;
  Tree tree(backend, 2000, cloud.cos_angle, h, {});
  check(tree, cloud, h);
  for (int step = 0; step < 6; ++step) {
    for (int i = 0; i < 2000; ++i)
      cloud.samples.weights[i] = (0.3 + 0.002 * step) * h * cloud.samples.points[i].z;
    check(tree, cloud, h);
  }
  CHECK(tree.lists().misses() < 200);
}

TEST_CASE("lists last while sites move little, and are made again when they have moved far")
{
  Random r(5);
  Cloud cloud = sample_families::even_sphere(3000, 0.1, r);
  sort(cloud);
  const double h = std::sqrt(sample_families::pi / 3000);
  Backend backend;
  Tree tree(backend, 3000, cloud.cos_angle, h, {});
  const auto misses = [&] {
    check(tree, cloud, h);
    return tree.lists().misses();
  };
  CHECK(misses() == 3000); // no radii are known
  for (int step = 0; step < 5; ++step) {
    CHECK(misses() == 0);
    change(cloud, h, 0.01, r);
  }
  change(cloud, h, 1.5, r);
  CHECK(misses() > 1500);
  CHECK(misses() < 500); // the order along the curve is no longer a good one
}
