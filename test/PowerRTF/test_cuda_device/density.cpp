// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The density of a surface on a GPU, against the host.
#include "../density_cases.h"

#ifdef CGAL_POWER_RTF_WITH_CUDA

#include <CGAL/PowerRTF/engines/Cuda_engine.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace density_cases;

namespace {

bool compute_there(const Surface& surface, const Remeshing_options& o, std::vector<double>& density)
{
  return Cuda_engine<float>::surface_work(o).compute_density(surface, o, density);
}

/// The largest difference relative to the second.
double largest_difference(const std::vector<double>& a, const std::vector<double>& b)
{
  double most = 0;
  for (std::size_t i = 0; i < b.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]) / b[i]);
  return most;
}

void check_density(Surface surface, const Remeshing_options& o)
{
  CAPTURE(surface.points.size());
  CAPTURE(o.density_power);
  CAPTURE(o.gradation);
  CAPTURE(o.density_smoothing);
  std::vector<double> density, again;
  REQUIRE(compute_there(surface, o, density)); // not the host
  REQUIRE(compute_there(surface, o, again));
  CHECK(density == again);
  set_density(surface, o, CGAL::Parallel_if_available_tag());
  REQUIRE(density.size() == surface.points.size());
  CHECK(largest_difference(density, surface.vertex_density) < 1e-12);
}

} // namespace

TEST_CASE("the density on a GPU is the host's but for rounding")
{
  for (const shapes::Soup& soup : small_shapes()) {
    const Surface surface = shapes::make_surface(soup);
    for (const Remeshing_options& o : all_options(2 * surface.points.size()))
      check_density(surface, o);
  }
  for (const shapes::Soup& soup : {shapes::torus(1200, 400, 1, .3), noisy_sphere(8)}) {
    const Surface surface = shapes::make_surface(soup); // more vertices than threads at a time
    for (const double power : {1., 2.})
      check_density(surface, options_of(surface.points.size(), power, 0.1, 3));
  }
}

TEST_CASE("a GPU leaves the density to the host where there are creases or clusters")
{
  const Surface ellipsoid = shapes::make_surface(shapes::ellipsoid(4, 1, 1, 4));
  const std::size_t n = ellipsoid.points.size();
  const auto is_there = [](const Surface& surface, std::size_t samples) {
    std::vector<double> density;
    return compute_there(surface, options_of(samples, 1, 0.1, 3), density);
  };
  CHECK(is_there(ellipsoid, 2 * n));
  CHECK_FALSE(is_there(creased(ellipsoid), 2 * n));
  CHECK_FALSE(is_there(ellipsoid, n / 30));
}

#endif // CGAL_POWER_RTF_WITH_CUDA
