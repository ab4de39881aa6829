// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fast cells against the oracle on more than a million cells: the families of
// test_certificates, and real models (environment variable POWER_RTF_DATA) at several stages of
// the optimization.
#include <doctest/doctest.h>

#include "fast_cells.h"

#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/input/import_surface.h>
#include <CGAL/PowerRTF_remesher.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>

#include <cstdlib>

using namespace fast_cells;
using random_input::Random;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Tag = CGAL::Parallel_if_available_tag;
using Remesher = CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<Kernel, Tag>>;

namespace {

void report(const std::string& name, const Cell_comparison& c)
{
  MESSAGE(name << ": " << c.cells << " cells, " << c.equal_cycles << " equal, wrong "
               << c.certified_wrong << ", incomplete " << c.uncertified_right << " right and "
               << c.uncertified_wrong << " wrong, " << c.differing_edges << " edges differ, worst "
               << c.worst_edge << ", area error 99 % " << c.area.p99 << " largest " << c.area.max
               << ", centroid " << c.centroid.p99 << " " << c.centroid.max << ", filtered "
               << c.predicates.filtered_share());
  CHECK(c.cells > 0);
  CHECK(c.certified_wrong == 0);
}

struct Checking_visitor : Remeshing_default_visitor {
  Remesher* remesher = nullptr;
  std::string name;
  std::size_t cells = 0;

  void check(const std::string& stage)
  {
    const double cos_angle = compatibility_cosine(remesher->options().normal_angle);
    const Cell_comparison c = check_cells<Tag>(remesher->samples(), remesher->cells(), cos_angle);
    report(name + ", " + stage, c);
    cells += c.cells;
  }
  void on_iteration(const Iteration_report&, double)
  {
    const std::size_t done = remesher->report().iterations.size() - 1;
    if (done == 0 || done == 20 || done == 99)
      check("after " + std::to_string(done) + " iterations");
  }
};

} // namespace

TEST_CASE("families")
{
  std::size_t cells = 0;
  for (const Family& family : families())
    for (std::uint64_t seed = 1000; seed < 1006; ++seed) {
      const int n = seed == 1000 ? 30000 : 6000;
      Random r(seed);
      Cloud cloud = family.make(n, r);
      Vec3d lo = cloud.samples.points[0], hi = lo;
      for (const Vec3d& p : cloud.samples.points) {
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
      }
      const double guess = length(hi - lo) / std::sqrt(double(n)) * std::pow(10., r.real(-1, .5));
      const auto fast = construct<Filtered_construction, Tag>(cloud, {}, guess);
      CAPTURE(seed);
      const Cell_comparison c = check_cells<Tag>(cloud.samples, fast, cloud.cos_angle);
      report(family.name, c);
      cells += c.cells;
    }
  CHECK(cells > 1000000);
}

TEST_CASE("models")
{
  const char* folder = std::getenv("POWER_RTF_DATA");
  if (!folder) {
    MESSAGE("skipped: POWER_RTF_DATA is not set");
    return;
  }
  std::size_t cells = 0;
  for (const char* model : {"elk", "homer", "retinal", "fandisk_large"}) {
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> polygons;
    REQUIRE(
        CGAL::IO::read_polygon_soup(std::string(folder) + "/" + model + ".off", points, polygons));
    for (Density density : {Density::uniform, Density::curvature}) {
      Repair_counts repairs;
      Remeshing_options options;
      options.number_of_samples = 15000;
      options.density = density;
      options.centroid_tolerance = 0; // cells of 100 steps are checked
      Surface surface = import_soup(points, polygons, repairs);
      set_density(surface, options);
      Remesher remesher(std::move(surface), options);
      Checking_visitor visitor;
      visitor.remesher = &remesher;
      visitor.name = model;
      REQUIRE(remesher.optimize(visitor));
      visitor.check("after the capacities");
      cells += visitor.cells;
    }
  }
  MESSAGE(cells << " cells of models");
  CHECK(cells > 400000);
}
