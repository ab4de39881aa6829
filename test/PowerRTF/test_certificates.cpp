// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Attacks on the completeness certificate of the fast cells, judged by the oracle; and the fast
// cells with certified combinatorics. (A million cells: test_certificates_long.)
#include <doctest/doctest.h>

#include "fast_cells.h"

using namespace fast_cells;
using random_input::Random;
using Tag = CGAL::Sequential_tag;

namespace {

double extent(const Cloud& c)
{
  double r2 = 0;
  for (const Vec3d& p : c.samples.points)
    r2 = std::max(r2, squared_length(p - c.samples.points[0]));
  return std::sqrt(r2);
}

Cell_comparison compare(const Cloud& c, const std::vector<Cell_polygon>& cells)
{
  return check_cells<Tag>(c.samples, cells, c.cos_angle);
}

void attack(const Family& family, int n, std::uint64_t seed)
{
  CAPTURE(family.name);
  CAPTURE(n);
  CAPTURE(seed);
  Random r(seed);
  Cloud cloud = family.make(n, r);
  const double guess = extent(cloud) / std::sqrt(double(n)) * std::pow(10., r.real(-1, 0.5));
  Remeshing_options options;
  const Cell_comparison c = compare(cloud, construct<Filtered_construction>(cloud, options, guess));
  CHECK(c.certified_wrong == 0);
  CHECK(c.cells == cloud.size());
  CHECK(c.worst_edge <= 1);

  options.certified_combinatorics = true;
  const Cell_comparison d = compare(cloud, construct<Filtered_construction>(cloud, options, guess));
  CHECK(d.equal_cycles == cloud.size());
  CHECK(d.passed());
  MESSAGE(family.name << ", " << cloud.size() << ": " << c.equal_cycles << " equal, "
                      << c.differing_edges << " edges differ, worst " << c.worst_edge << "; wrong "
                      << c.certified_wrong << "; incomplete " << c.uncertified_right << " + "
                      << c.uncertified_wrong << "; area " << c.area.p50 << " " << c.area.p99 << " "
                      << c.area.max << "; centroid " << c.centroid.p50 << " " << c.centroid.p99
                      << " " << c.centroid.max);
}

} // namespace

TEST_CASE("no certified cell is wrong")
{
  for (const Family& family : families())
    for (std::uint64_t seed : {1, 2}) attack(family, seed == 1 ? 3000 : 400, seed);
}

TEST_CASE("few samples")
{
  for (const Family& family : families())
    for (int n = 1; n < 10; ++n) attack(family, n, 100 + n);
}
