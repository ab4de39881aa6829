// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distance of two surfaces against closed forms.
#include "shapes.h"

#include <CGAL/PowerRTF/engines/facet_distances.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/quality/surface_distance.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

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

TEST_CASE("distance: in groups as one by one, to the last bit")
{
  using internal::Group_distances;
  const Soup sphere = shapes::scaled(shapes::icosphere(4), 0.7);
  const Facet_tree tree(sphere.points, sphere.triangles);
  const auto check = [&](const std::vector<Vec3d>& points, double enough) {
    Group_distances distances(tree);
    double found[Group_distances::most_points];
    for (int first = 0; first < int(points.size()); first += Group_distances::most_points) {
      const int n = std::min(Group_distances::most_points, int(points.size()) - first);
      distances.find(&points[first], n, found, enough);
      for (int k = 0; k < n; ++k) {
        const double expected = tree.nearest_anywhere(points[first + k]).squared_distance;
        if (expected > enough)
          CHECK(found[k] == expected);
        else
          CHECK((found[k] >= expected && found[k] <= enough));
      }
    }
  };
  std::vector<Vec3d> along, anywhere; // a spiral near the sphere with a leap; points far apart
  for (int i = 0; i < 1500; ++i) {
    const double z = -1 + (i + 0.5) / 750, r = std::sqrt(1 - z * z);
    const double out = i == 700 ? 0.2 : 0.69 + 0.03 * std::sin(0.1 * i);
    along.push_back(out * Vec3d{r * std::cos(0.3 * i), r * std::sin(0.3 * i), z});
    anywhere.push_back(0.9 * Vec3d{std::sin(1.7 * i), std::sin(2.3 * i), std::sin(3.1 * i)});
  }
  for (const auto& points : {along, anywhere, sphere.points})
    for (const double enough : {-1., 0., 1e-4, 1.}) check(points, enough);
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

TEST_CASE("distance: found by a backend")
{
  const Soup fine = shapes::icosphere(4), coarse = shapes::icosphere(2);
  const Distance_statistics expected = distance(fine, coarse);
  const auto check = [&](const Find_distances& find) {
    const Distance_statistics s =
        surface_distance(fine.points, fine.triangles, Facet_tree(fine.points, fine.triangles),
                         coarse.points, coarse.triangles, CGAL::Sequential_tag(), false, find);
    CHECK(s.mean == expected.mean);
    CHECK(s.rms == expected.rms);
    CHECK(s.max == expected.max);
  };
  int calls = 0;
  Host_backend<CGAL::Sequential_tag> backend;
  check([&](const auto& facets, int n, const Vec3d* points, double* squared) {
    ++calls;
    return internal::facet_distances(backend, facets, n, points, squared);
  });
  CHECK(calls == 2);                              // once each way
  check([&](auto&&...) { return ++calls == 0; }); // it has no room
  CHECK(calls == 4);
}
