// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The density that a backend computes, against the other steps to it.
#include "../density_cases.h"

#include <CGAL/PowerRTF/fields/density_by_curvature.h>
#include <CGAL/PowerRTF/fields/normal_diffusion.h>
#include <CGAL/PowerRTF/fields/smooth_normals.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>

#include <doctest/doctest.h>

#include <cstddef>
#include <utility>
#include <vector>

using namespace density_cases;

namespace {

/// What computes densities by a backend of the host.
Compute_density by_backend(internal::Concurrency concurrency)
{
  return
      [=](const Surface& surface, const Remeshing_options& options, std::vector<double>& density) {
        return internal::with_host_backend(concurrency, [&](auto backend) {
          return internal::density_by_curvature(backend, surface, options, density);
        });
      };
}

} // namespace

TEST_CASE("the density of a backend is the host's bit for bit, with any number of threads")
{
  for (const shapes::Soup& soup : small_shapes()) {
    const Surface surface = shapes::make_surface(soup);
    CAPTURE(surface.points.size());
    for (const Remeshing_options& o : all_options(2 * surface.points.size())) {
      CAPTURE(o.density_power);
      CAPTURE(o.gradation);
      CAPTURE(o.density_smoothing);
      Surface expected = surface;
      set_density(expected, o);
      for (const internal::Concurrency c :
           {internal::Concurrency(CGAL::Sequential_tag()),
            internal::Concurrency(CGAL::Parallel_if_available_tag())}) {
        std::vector<double> density;
        REQUIRE(by_backend(c)(surface, o, density));
        CHECK(density == expected.vertex_density);
      }
    }
  }
}

TEST_CASE("where there are creases or clusters the density is left to the host")
{
  const Surface ellipsoid = shapes::make_surface(shapes::ellipsoid(4, 1, 1, 4));
  const std::size_t many = 2 * ellipsoid.points.size(), few = ellipsoid.points.size() / 30;
  for (const auto& [surface, n] : {std::pair(creased(ellipsoid), many), std::pair(ellipsoid, few)})
    for (const Remeshing_options& o : all_options(n)) {
      std::vector<double> density{7};
      CHECK_FALSE(by_backend(CGAL::Sequential_tag())(surface, o, density));
      CHECK(density == std::vector<double>{7});
      Surface here = surface, there = surface;
      set_density(here, o);
      set_density(there, o, CGAL::Sequential_tag(), by_backend(CGAL::Sequential_tag()));
      CHECK(here.vertex_density == there.vertex_density);
    }
}

TEST_CASE("a backend computes no density where the host would use clusters")
{
  int there = 0, not_there = 0;
  for (const shapes::Soup& soup : {shapes::ellipsoid(4, 1, 1, 4), noisy_sphere(4),
                                   shapes::torus(200, 20, 3, 1), shapes::ball_with_finger(.1)}) {
    Surface surface = shapes::make_surface(soup);
    for (std::size_t n = surface.points.size() / 50; n < 2 * surface.points.size(); n += n / 4) {
      const Remeshing_options o = options_of(n, 1, 0, 0); // where clusters would change nothing
      set_density(surface, o);
      std::vector<double> density;
      if (!by_backend(CGAL::Sequential_tag())(surface, o, density)) {
        ++not_there;
        continue;
      }
      ++there;
      CHECK_FALSE(
          internal::near_vertices(surface, surface_edges(surface), n, CGAL::Sequential_tag()));
    }
  }
  CHECK(there > 20);
  CHECK(not_there > 20);
}

TEST_CASE_TEMPLATE("a backend diffuses normals as the host does", Tag, CGAL::Sequential_tag,
                   CGAL::Parallel_if_available_tag)
{
  int times = 0;
  const auto there = [&](const Surface& surface, double variance, Vec3d* normals) {
    Host_backend<Tag> backend;
    ++times;
    return internal::diffuse_normals(backend, surface, variance, normals);
  };
  for (const shapes::Soup& soup :
       {shapes::octahedron(), shapes::plane_patch(30, 7), shapes::torus(50, 30, 1, .3)}) {
    const Surface smooth = shapes::make_surface(soup);
    Surface here = smooth;
    for (std::size_t v = 0; v < here.points.size(); ++v)
      here.vertex_normals[v] =
          normalized(here.vertex_normals[v] + Vec3d{0.3 * double(v % 3), 0.2 * double(v % 5), 0});
    Surface other = here;
    smooth_normals(here, 100, 1.5);
    smooth_normals(other, 100, 1.5, CGAL::Parallel_if_available_tag(), there);
    CHECK(here.vertex_normals == other.vertex_normals);
    CHECK(here.vertex_normals != smooth.vertex_normals);
  }
  CHECK(times == 3);
}
