// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Quality, lengths and the whole judgment against closed forms.
#include "shapes.h"

#include <CGAL/PowerRTF/quality/assess.h>
#include <CGAL/PowerRTF/quality/triangle_quality.h>

#include <CGAL/tags.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using shapes::Soup;

TEST_CASE("triangle quality: equilateral triangles are perfect")
{
  for (const Soup& s : {shapes::tetrahedron(), shapes::octahedron(), shapes::icosahedron(),
                        shapes::scaled(shapes::icosahedron(), 1e-6)}) {
    const Quality_statistics q = triangle_quality(s.points, s.triangles);
    CHECK(q.q_min == Approx(1));
    CHECK(q.q_avg == Approx(1));
    CHECK(q.theta_min == Approx(60));
    CHECK(q.theta_min_avg == Approx(60));
    CHECK(q.theta_max == Approx(60));
    CHECK(q.below_30 == 0);
    CHECK(q.above_90 == 0);
  }
}

TEST_CASE("triangle quality: known angles")
{
  // 3-4-5: Q = 6/sqrt(3) * 6 / (6 * 5)
  Soup s = Soup{{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{{0, 1, 2}}}};
  Quality_statistics q = triangle_quality(s.points, s.triangles);
  CHECK(q.q_min == Approx(6 / std::sqrt(3.) / 5));
  CHECK(q.theta_min == Approx(std::atan2(3, 4) * 180 / shapes::pi));
  CHECK(q.theta_max == Approx(90));
  CHECK(q.above_90 == 0);
  CHECK(q.below_30 == 0);

  // with a facet of 20, 20, 140 degrees and one of 60, 60, 60: means over the three
  const double u = 20 * shapes::pi / 180;
  s.points.insert(s.points.end(),
                  {{1, 0, 0}, {2, 0, 0}, {1.5, 0.5 * std::tan(u), 0}, {1.5, std::sqrt(3.) / 2, 0}});
  s.triangles.insert(s.triangles.end(), {{{3, 4, 5}}, {{3, 4, 6}}});
  q = triangle_quality(s.points, s.triangles);
  CHECK(q.theta_min == Approx(20));
  CHECK(q.theta_max == Approx(140));
  CHECK(q.theta_min_avg == Approx((20 + 60 + std::atan2(3, 4) * 180 / shapes::pi) / 3));
  CHECK(q.below_30 == Approx(1. / 3));
  CHECK(q.above_90 == Approx(1. / 3));
  CHECK(q.q_min < 0.4);
}

TEST_CASE("angles that are asked for are guarantees: met up to the bound, missed beyond it")
{
  Remeshing_report report;
  report.quality.theta_min = 40;
  report.quality.theta_max = 85;
  const auto missed = [&](double min_angle, double max_angle) {
    report.min_angle = min_angle;
    report.max_angle = max_angle;
    return report.missed_guarantees();
  };
  using Words = std::vector<std::string>;
  CHECK(missed(0, 180).empty());
  CHECK(missed(40, 85).empty());
  CHECK(missed(40.5, 85) == Words{"smallest angle: 40 instead of 40.5"});
  CHECK(missed(40, 84.5) == Words{"largest angle: 85 instead of 84.5"});
  CHECK(missed(45, 80).size() == 2);
}

TEST_CASE("triangle quality: angles are found only where they count, the numbers are those of all")
{
  std::mt19937 random(5);
  const auto unit = [&] { return random() / 4294967296.; };
  for (const double height : {1., 1e-3, 1e-9, 0.}) { // up to needles and flat ones
    Soup s = shapes::icosphere(1);
    for (Vec3d& p : s.points) p.z *= height;
    for (int k = 0; k < 3000; ++k) {
      const int first = int(s.points.size());
      for (int c = 0; c < 3; ++c) s.points.push_back({unit(), height * unit(), height * unit()});
      s.points.back() += s.points[first] * double(k % 2);
      s.triangles.push_back({first, first + 1, first + 2});
    }
    const double degrees = 45 / std::atan(1.0);
    double least = 60, most = 60, sum = 0, below = 0, above = 0, part = 0;
    for (std::size_t f = 0; f < s.triangles.size(); ++f) {
      double smallest = 180, largest = 0;
      for (int k = 0; k < 3; ++k) {
        const Vec3d &a = s.points[s.triangles[f][0]], &b = s.points[s.triangles[f][1]],
                    &c = s.points[s.triangles[f][2]];
        const Vec3d e[3] = {c - b, a - c, b - a};
        const double angle =
            std::atan2(length(cross(e[0], e[1])), -dot(e[(k + 1) % 3], e[(k + 2) % 3])) * degrees;
        smallest = std::min(smallest, angle);
        largest = std::max(largest, angle);
        if (!(length(cross(e[0], e[1])) > 0)) smallest = 0, largest = 180;
      }
      least = std::min(least, smallest);
      most = std::max(most, largest);
      part += smallest;
      below += smallest < 30;
      above += largest > 90 && smallest > 0;
      if (f % 1024 < 1023 && f + 1 < s.triangles.size()) continue; // the chunks of a reduction
      sum += part;
      part = 0;
    }
    const auto n = double(s.triangles.size());
    const Quality_statistics q = triangle_quality(s.points, s.triangles);
    CHECK(q.theta_min == least);
    CHECK(q.theta_max == most);
    CHECK(q.theta_min_avg == sum / n);
    CHECK(q.below_30 == below / n);
    CHECK(q.above_90 == above / n);
  }
}

TEST_CASE("triangle quality: no triangle, no area")
{
  CHECK(triangle_quality({}, {}).q_avg == 0);
  CHECK(triangle_quality({}, {}).theta_max == 0);
  const Soup s =
      Soup{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}, {{0, 0, 0}}, {{0, 1, 3}}}};
  const Quality_statistics q = triangle_quality(s.points, s.triangles);
  CHECK(q.q_min == 0);
  CHECK(q.theta_min == 0);
  CHECK(q.theta_min_avg == Approx(15));
  CHECK(q.theta_max == 180);
  CHECK(q.above_90 == 0);
  CHECK(q.below_30 == Approx(2. / 3));
}

TEST_CASE("edge lengths: every edge once")
{
  // a square of side 1 and its diagonal, which is an edge of both triangles
  const Soup square = shapes::plane_patch(1, 1);
  const Edge_length_statistics s = edge_lengths(square.points, square.triangles);
  CHECK(s.mean == Approx((4 + std::sqrt(2.)) / 5));
  CHECK(s.min == Approx(1));
  CHECK(s.max == Approx(std::sqrt(2.)));

  // whichever way round their facets are
  const Soup octahedron = shapes::octahedron();
  for (unsigned seed = 0; seed < 3; ++seed) {
    Soup turned = shapes::permuted(octahedron, seed);
    std::swap(turned.triangles[seed][0], turned.triangles[seed][1]);
    const Edge_length_statistics o = edge_lengths(turned.points, turned.triangles);
    CHECK(o.mean == Approx(std::sqrt(2.)));
    CHECK(o.min == Approx(std::sqrt(2.)));
    CHECK(o.max == Approx(std::sqrt(2.)));
  }
  const Soup sphere = shapes::ellipsoid(1, 0.7, 0.4, 3); // closed: each edge from one of its facets
  const Edge_length_statistics any = edge_lengths(sphere.points, sphere.triangles),
                               closed = edge_lengths(sphere.points, sphere.triangles,
                                                     CGAL::Sequential_tag(), true);
  CHECK(closed.mean == Approx(any.mean));
  CHECK(closed.median == any.median);
  CHECK(closed.min == any.min);
  CHECK(closed.max == any.max);
  CHECK(edge_lengths({}, {}).mean == 0);
  CHECK(edge_lengths({}, {}).min == 0);
}

TEST_CASE("the same numbers in all threads")
{
  const CGAL::Parallel_if_available_tag at_once;
  const Soup soup = shapes::permuted(shapes::ellipsoid(1, 0.7, 0.4, 4), 2);
  const Quality_statistics q = triangle_quality(soup.points, soup.triangles),
                           r = triangle_quality(soup.points, soup.triangles, at_once);
  CHECK(r.q_avg == q.q_avg);
  CHECK(r.q_min == q.q_min);
  CHECK(r.theta_min_avg == q.theta_min_avg);
  CHECK(r.below_30 == q.below_30);
  const Edge_length_statistics l = edge_lengths(soup.points, soup.triangles),
                               k = edge_lengths(soup.points, soup.triangles, at_once);
  CHECK(k.mean == l.mean);
  CHECK(k.min == l.min);
  CHECK(k.max == l.max);
}

TEST_CASE("assess: a surface against itself has no distance, and its own topology")
{
  const Surface surface = shapes::make_surface(shapes::torus(40, 20, 3, 1));
  Remeshing_report report;
  report.samples_asked = surface.points.size();
  assess(surface, {surface.points, surface.triangles, {}}, report);
  CHECK(report.distance.max < 1e-6);
  CHECK(report.topology.euler_characteristic == 0);
  CHECK(report.diagonal == Approx(std::sqrt(8. * 8 + 8 * 8 + 2 * 2))); // in the torus's own unit
  // the shortest edges are chords of 1/20 of the tube
  CHECK(report.edge_length.min == Approx(2 * std::sin(shapes::pi / 20)));
  CHECK(report.missed_guarantees().empty());

  Soup open{surface.points, surface.triangles};
  open.triangles.pop_back();
  assess(surface, {open.points, open.triangles, {}}, report);
  CHECK(report.missed_guarantees().size() == 2); // Euler characteristic, borders
}
