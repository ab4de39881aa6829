// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes.h"

#include <CGAL/PowerRTF/quality/distance_bound.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;

namespace {

Facet_tree tree_of(const shapes::Soup& soup) { return {soup.points, soup.triangles}; }

// By brute force: the largest over points that fill every facet.
double sampled(const shapes::Soup& from, const shapes::Soup& to, int steps)
{
  const Facet_tree tree = tree_of(to);
  double most = 0;
  for (const Triangle& t : from.triangles)
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const double u = double(i) / steps, v = double(j) / steps;
        const Vec3d p =
            (1 - u - v) * from.points[t[0]] + u * from.points[t[1]] + v * from.points[t[2]];
        most = std::max(most, tree.nearest_anywhere(p).squared_distance);
      }
  return std::sqrt(most);
}

double bound(const shapes::Soup& from, const shapes::Soup& to)
{
  return internal::distance_bound(tree_of(from), tree_of(to), sampled(from, to, 1),
                                  CGAL::Sequential_tag());
}

// In the unit box.
shapes::Soup small(const shapes::Soup& soup) { return shapes::scaled(soup, 0.2); }

} // namespace

TEST_CASE("the bound is above all distances, and at most 1 % above the largest")
{
  using namespace shapes;
  const std::vector<std::pair<std::string, std::pair<Soup, Soup>>> pairs{
      {"spheres", {icosphere(2), icosphere(4)}},
      {"a sphere turned", {icosphere(3), rotated(icosphere(3), 0.3)}},
      {"ellipsoids", {ellipsoid(1, 0.6, 0.4, 2), ellipsoid(1, 0.6, 0.4, 3)}},
      {"tori", {torus(20, 10, 1, 0.4), torus(31, 17, 1, 0.4)}},
      {"a cube and a sphere", {box(3), icosphere(3)}},
      {"cylinders", {open_cylinder(12, 3, 1, 2), open_cylinder(30, 9, 1, 1.8)}},
      {"two sheets", {thin_disc(0.05), thin_disc(0.08)}},
      {"needles", {ball_with_needles(), icosphere(3)}},
      {"a can", {can(20, 8), rotated(can(14, 5), 0.1)}},
      {"a plane moved", {plane_patch(5, 5), translated(plane_patch(7, 3), {0.1, 0.05, 0.2})}},
      {"a plane on edge", {plane_patch(3, 3), rotated(plane_patch(3, 3), 1.5, {1, 0, 0})}},
  };
  for (const auto& pair : pairs) {
    CAPTURE(pair.first);
    const auto& [a, b] = pair.second;
    for (const bool back : {false, true}) {
      const Soup from = small(back ? b : a), to = small(back ? a : b);
      const double most = bound(from, to), known = sampled(from, to, 16);
      CHECK(most >= known);
      CHECK(most <= 1.05 * known + 1e-9); // the points miss a little of the largest
    }
  }
}

TEST_CASE("surfaces that coincide have the distance 0, however they are triangulated")
{
  using namespace shapes;
  for (const auto& [a, b] : {std::pair{box(1), box(7)}, std::pair{box(4), box(5)},
                             std::pair{plane_patch(3, 4), plane_patch(10, 7)},
                             std::pair{icosphere(3), permuted(icosphere(3), 1)}}) {
    CHECK(bound(small(a), small(b)) < 1e-11);
    CHECK(bound(small(b), small(a)) < 1e-11);
  }
}

TEST_CASE("a distance is known in closed form: parallel planes, and where one ends")
{
  const shapes::Soup plane = small(shapes::plane_patch(6, 6));
  for (const double height : {1e-6, 1e-3, 0.3}) {
    const shapes::Soup above = shapes::translated(plane, {0, 0, height});
    CHECK(bound(plane, above) >= height);
    CHECK(bound(plane, above) <= 1.0101 * height);
    const shapes::Soup beside = shapes::translated(plane, {height, 0, 0});
    CHECK(bound(plane, beside) >= height);
    CHECK(bound(plane, beside) <= 1.0101 * height);
  }
}

TEST_CASE("a facet cut into few pieces only has a larger bound")
{
  const shapes::Soup from = small(shapes::icosphere(0)), to = small(shapes::torus(30, 20, 1, 0.4));
  const Facet_tree from_tree = tree_of(from), to_tree = tree_of(to);
  const double known = sampled(from, to, 16);
  double last = 0;
  for (const int pieces : {1, 10, 1000}) {
    const internal::Distance_bound bound(to_tree, 1e-12, 1.01, pieces);
    double most = 0;
    for (int f = 0; f < int(from.triangles.size()); ++f)
      most = std::max(most, bound(from_tree.view().facets[f]));
    CHECK(most >= known);
    if (last > 0) CHECK(most < last);
    last = most;
  }
  CHECK(last <= 1.05 * known);
}

TEST_CASE("the bound is the same for any number of threads")
{
  const shapes::Soup a = small(shapes::icosphere(4)), b = small(shapes::torus(30, 20, 1, 0.4));
  const double one = internal::distance_bound(tree_of(a), tree_of(b), 0.1, CGAL::Sequential_tag());
  const double many =
      internal::distance_bound(tree_of(a), tree_of(b), 0.1, CGAL::Parallel_if_available_tag());
  CHECK(one == many);
}
