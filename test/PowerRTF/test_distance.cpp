// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distance of two surfaces against closed forms.
#include "shapes.h"

#include <CGAL/PowerRTF/quality/surface_distance.h>

#include <doctest/doctest.h>

#include <cmath>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using shapes::Soup;

namespace {

Distance_statistics distance(const Soup& a, const Soup& b)
{
  return surface_distance(a.points, a.triangles, b.points, b.triangles);
}

} // namespace

TEST_CASE("distance: parallel squares")
{
  const Soup square = shapes::plane_patch(7, 7);
  for (const double d : {0., 1e-3, 0.25}) {
    const Distance_statistics s =
        distance(square, shapes::translated(shapes::plane_patch(3, 5), {0, 0, d}));
    const double percent = 100 * d / std::sqrt(2.);
    CHECK(s.mean == Approx(percent));
    CHECK(s.rms == Approx(percent));
    CHECK(s.max == Approx(percent));
  }
}

TEST_CASE("distance: the worse direction counts")
{
  // the unit square, and its half x <= 1/2: mean over the square 1/8, RMS sqrt(1/24), maximum 1/2
  const Soup square = shapes::plane_patch(8, 8);
  Soup half = shapes::plane_patch(8, 8);
  for (Vec3d& p : half.points) p.x /= 2;
  for (const bool turned : {false, true}) {
    const Distance_statistics s = turned ? distance(half, square) : distance(square, half);
    const double percent = 100 / (turned ? std::sqrt(1.25) : std::sqrt(2.));
    CHECK(s.mean == Approx(percent / 8).epsilon(0.01));
    CHECK(s.rms == Approx(percent * std::sqrt(1. / 24)).epsilon(0.01));
    CHECK(s.max == Approx(percent / 2));
  }
}

TEST_CASE("distance: a vertex counts for the maximum, however small its facets")
{
  Soup spike = shapes::plane_patch(10, 10);
  const int tip = static_cast<int>(spike.points.size());
  spike.points.push_back({0.5, 0.5, 0.2});
  spike.points.push_back({0.5 + 1e-9, 0.5, 0});
  spike.points.push_back({0.5, 0.5 + 1e-9, 0});
  spike.triangles.push_back({tip, tip + 1, tip + 2});
  const Distance_statistics s = distance(shapes::plane_patch(10, 10), spike);
  CHECK(s.max == Approx(100 * 0.2 / std::sqrt(2.)));
  CHECK(s.mean < 1e-3);
}

TEST_CASE("distance: spheres, and invariance")
{
  const Soup fine = shapes::icosphere(5);
  Soup larger = shapes::icosphere(5);
  for (Vec3d& p : larger.points) p = 1.1 * p;
  const Distance_statistics s = distance(fine, larger);
  const double percent = 100 / (2 * std::sqrt(3.));
  CHECK(s.mean == Approx(0.1 * percent).epsilon(0.01));
  CHECK(s.max == Approx(0.1 * percent).epsilon(0.02));
  CHECK(s.rms >= s.mean);

  const auto moved = [](const Soup& t) {
    return shapes::translated(shapes::rotated(shapes::scaled(t, 1000), 0.7), {5000, -3000, 800});
  };
  const auto coarse = shapes::icosphere(3);
  const Distance_statistics before = distance(fine, coarse),
                            after = distance(moved(fine), moved(coarse));
  const auto diagonal = [](const Soup& t) {
    const Box3<double> box = internal::bounding_box(t.points, t.triangles);
    return length(box.hi - box.lo);
  };
  const double change = 1000 * diagonal(fine) / diagonal(moved(fine)); // the box turns too
  CHECK(after.mean == Approx(before.mean * change).epsilon(0.02));
  CHECK(after.rms == Approx(before.rms * change).epsilon(0.02));

  const Distance_statistics parallel =
      surface_distance(fine.points, fine.triangles, coarse.points, coarse.triangles,
                       CGAL::Parallel_if_available_tag());
  CHECK(parallel.mean == before.mean);
  CHECK(parallel.rms == before.rms);
  CHECK(parallel.max == before.max);
  CHECK(distance(fine, Soup()).max == 0);
  CHECK(distance(Soup(), fine).max == 0);
}
