// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Self-intersections against exact predicates and CGAL's own count.
#include "mesh_of_shape.h"
#include "unknown_mesh.h"

#include <CGAL/PowerRTF/engines/close_faces.h>
#include <CGAL/PowerRTF/geometry/self_intersections.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <iterator>
#include <random>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using shapes::Soup;

namespace {

Soup random_triangles(int n, unsigned seed)
{
  std::mt19937 random(seed);
  const auto unit = [&random] { return random() / 4294967296.; };
  Soup s;
  for (int f = 0; f < n; ++f) {
    const Vec3d c{unit(), unit(), unit()};
    for (int k = 0; k < 3; ++k) s.points.push_back(c + 0.3 * Vec3d{unit(), unit(), unit()});
    s.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  return s;
}

bool do_overlap(const Box3<double>& a, const Box3<double>& b)
{
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
         a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

std::size_t cgal_self_intersections(const Soup& s)
{
  using shapes::Mesh;
  const Mesh mesh = shapes::make_mesh(s);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}

// The pairs that a backend does not prove to be apart.
bool find_close(const Soup& s, Face_pairs& pairs)
{
  Host_backend<CGAL::Parallel_if_available_tag> backend;
  return internal::close_faces(backend, shapes::arrays(s), pairs);
}

// A soup that a backend looks at.
struct Soup_there : unknown::Mesh {
  explicit Soup_there(const Soup& soup) : s(soup) {}
  bool find_close_faces(Face_pairs& pairs) override { return find_close(s, pairs); }
  const Soup& s;
};

// With a backend's help or without.
std::size_t self_intersections(const Soup& s)
{
  const Face_pairs pairs = intersecting_facets(s.points, s.triangles);
  Soup_there there(s);
  CHECK(intersecting_facets(s.points, s.triangles, CGAL::Parallel_if_available_tag(), &there) ==
        pairs);
  return pairs.size();
}

} // namespace

TEST_CASE("triangles are parted where only a plane along an edge of each does")
{
  // No plane along one of them parts them, nor does the one half-way between their centers.
  const auto is_parted = [](double height) {
    const Vec3d p[3] = {{-1, 0, 0}, {1, 0, 0}, {0, 0.9, -1}},
                q[3] = {{0, -1, height}, {0, 1, height}, {0.9, 0, 1 + height}};
    return internal::Parting_plane(p, q).exists();
  };
  CHECK(is_parted(0.01));
  CHECK_FALSE(is_parted(-0.01)); // they meet
  CHECK_FALSE(is_parted(0));     // in a point
}

TEST_CASE("self-intersections: pairs")
{
  const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  const auto pair = [&](std::vector<Vec3d> more, Triangle t) {
    std::vector<Vec3d> points{a, b, c};
    points.insert(points.end(), more.begin(), more.end());
    return self_intersections(Soup{points, {{{0, 1, 2}}, t}});
  };
  // no shared vertex: through, beside, parallel, coplanar and overlapping, touching
  CHECK(pair({{.2, .2, -1}, {.3, .2, 1}, {.2, .3, 1}}, {3, 4, 5}) == 1);
  CHECK(pair({{.8, .8, -1}, {.9, .8, 1}, {.8, .9, 1}}, {3, 4, 5}) == 0);
  CHECK(pair({{0, 0, .1}, {1, 0, .1}, {0, 1, .1}}, {3, 4, 5}) == 0);
  CHECK(pair({{.1, .1, 0}, {2, .1, 0}, {.1, 2, 0}}, {3, 4, 5}) == 1);
  CHECK(pair({{.2, .2, 0}, {.3, .2, 1}, {.2, .3, 1}}, {3, 4, 5}) == 1);
  // a shared vertex: apart, through, overlapping
  CHECK(pair({{-1, 0, 1}, {0, -1, 1}}, {0, 3, 4}) == 0);
  CHECK(pair({{1, 1, 1}, {1, 1, -1}}, {0, 3, 4}) == 1);
  CHECK(pair({{.2, .1, 0}, {.1, .2, 0}}, {0, 3, 4}) == 1);
  // a shared edge: a fold, folded flat onto each other, flat side by side; the edge in both orders
  for (const Triangle& t : {Triangle{1, 0, 3}, Triangle{0, 1, 3}, Triangle{3, 1, 0}}) {
    CHECK(pair({{0, 1, .1}}, t) == 0);
    CHECK(pair({{0, .5, 0}}, t) == 1);
    CHECK(pair({{0, -1, 0}}, t) == 0);
  }
  CHECK(pair({}, {0, 2, 1}) == 1);          // the same facet, turned over
  CHECK(pair({{2, 0, 0}}, {0, 1, 3}) == 1); // no area: a pair with itself
}

TEST_CASE("self-intersections: what floating point proves is what exact predicates say")
{
  using internal::Epick;
  using Points = std::array<Epick::Point_3, 3>;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> digit(0, 3);
  const auto triangle = [](const Points& p) { return Epick::Triangle_3(p[0], p[1], p[2]); };
  std::size_t parted = 0, apart = 0;
  // On a small lattice all the special cases are frequent; drawn out, all triangles are slivers.
  for (const double length : {1., 1e8, 0x1p-40})
    for (int i = 0; i < 20000; ++i) {
      const bool share = i % 2 == 0;
      const auto point = [&] {
        const int x = digit(random), y = digit(random), z = digit(random);
        return Epick::Point_3(length * x + 0.1, y + 0.1 * x, z / 3.);
      };
      Points p{point(), point(), point()}, q{point(), point(), point()};
      if (share) q[1] = p[2];
      if (CGAL::collinear(p[0], p[1], p[2]) || CGAL::collinear(q[0], q[1], q[2])) continue;
      const bool expected = share
                                ? CGAL::do_intersect(triangle(p), Epick::Segment_3(q[2], q[0])) ||
                                      CGAL::do_intersect(triangle(q), Epick::Segment_3(p[0], p[1]))
                                : CGAL::do_intersect(triangle(p), triangle(q));
      const bool is_parted =
          share ? internal::has_parting_plane(p, q, 2, 1) : internal::has_parting_plane(p, q);
      if (is_parted) CHECK_FALSE(expected);
      parted += is_parted;
      apart += !expected;
      const std::array<int, 3> s{0, 1, 2}, t{3, share ? 2 : 4, 5};
      CHECK(internal::triangles_intersect(s, p, t, q) == expected);
    }
  CHECK(parted > apart / 2); // it is worth its while
}

TEST_CASE("self-intersections: the pairs of some faces, in any number of threads")
{
  for (const int size : {0, 1, 2, 9, 600}) {
    const Soup s = random_triangles(size, 5);
    const internal::Soup_triangles triangles{s.points, s.triangles};
    using Finder = internal::Intersecting_pairs<internal::Soup_triangles>;
    const Finder one_by_one(triangles), at_once(triangles, CGAL::Parallel_if_available_tag());
    std::vector<int> faces;
    for (int f = 0; f < size; f += 1 + f % 3) faces.push_back(f);
    std::vector<Finder::Pair> expected, some;
    for (const int f : faces)
      for (const int g : faces)
        if (f < g && one_by_one.intersect(f, g)) expected.emplace_back(f, g);
    const auto is_wanted = [](int f) { return f % 4 == 0; };
    for (const auto& [f, g] : expected)
      if (is_wanted(f) || is_wanted(g)) some.emplace_back(f, g);
    CHECK((size < 600 || some.size() > 20));
    for (const Finder& finder : {one_by_one, at_once}) {
      CHECK(finder.find(faces) == expected);
      CHECK(finder.find_where(faces, is_wanted) == some);
    }
  }
}

TEST_CASE("self-intersections: pairs of boxes, wherever and however large they are")
{
  const auto check = [](int n, double scale, double offset, int wanted) {
    CAPTURE(n);
    CAPTURE(scale);
    CAPTURE(wanted);
    const Soup s = random_triangles(n, n);
    internal::Unset_vector<Box3<double>> boxes(n);
    for (int i = 0; i < n; ++i) {
      const auto at = [&](int k) { return scale * (s.points[3 * i + k] + Vec3d{offset, 0, 0}); };
      boxes[i] = {at(0), at(0)};
      boxes[i].add(at(1));
      boxes[i].add(at(2));
    }
    const auto is_wanted = [&](int i) { return i % wanted == 0; };
    std::vector<std::pair<int, int>> expected;
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j)
        if ((is_wanted(i) || is_wanted(j)) && do_overlap(boxes[i], boxes[j]))
          expected.emplace_back(i, j);
    auto found =
        internal::Box_tree(boxes, CGAL::Sequential_tag()).pairs(is_wanted, [&](int i, int j) {
          return do_overlap(boxes[i], boxes[j]);
        });
    for (auto& [i, j] : found)
      if (i > j) std::swap(i, j);
    std::sort(found.begin(), found.end());
    CHECK(found == expected);
  };
  for (const int n : {0, 1, 2, 7, 8, 9, 64, 65, 600})
    for (const double scale : {1., 1e-300, 1e300})
      for (const int wanted : {1, 3, 1000}) check(n, scale, 1, wanted);
  check(600, 1, 1e12, 1);
  check(600, 0, 0, 1); // all at one point
}

TEST_CASE("self-intersections: boxes far from the origin are told apart")
{
  internal::Unset_vector<Box3<double>> boxes(1000);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p{4e6 + i, 5e6, 0};
    boxes[i] = {p, p + Vec3d{0.5, 1, 1}};
  }
  std::atomic<int> tested{0};
  internal::Box_tree(boxes, CGAL::Parallel_if_available_tag())
      .pairs([](int) { return true; }, [&](int, int) { return ++tested, false; });
  CHECK(tested == 0);
}

TEST_CASE("self-intersections: CGAL's own count")
{
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Soup s = random_triangles(60, seed);
    const std::size_t count = self_intersections(s);
    CHECK(count > 0);
    CHECK(count == cgal_self_intersections(s));
    CHECK(count == self_intersections(shapes::permuted(s, seed)));
    for (const double scale : {1e-150, 1e150}) {
      Soup scaled = s;
      for (Vec3d& p : scaled.points) p *= scale;
      CHECK(count == self_intersections(scaled));
    }
  }
  CHECK(self_intersections(shapes::torus(40, 20, 3, 1)) == 0);
  const Soup spheres = shapes::two_spheres(2, 1.3);
  CHECK(self_intersections(spheres) > 0);
  CHECK(self_intersections(spheres) == cgal_self_intersections(spheres));
  CHECK(self_intersections(Soup()) == 0);
}

TEST_CASE("self-intersections: a backend proves nearly all pairs apart")
{
  for (const Soup& s : {shapes::torus(40, 20, 3, 1), shapes::plane_patch(30, 20),
                        shapes::icosphere(4), shapes::scaled(shapes::icosphere(3), 1e6)}) {
    Face_pairs pairs;
    REQUIRE(find_close(s, pairs));
    CHECK(pairs.empty());
  }
  for (unsigned seed = 0; seed < 4; ++seed) {
    Soup s = random_triangles(400, seed); // apart but for some
    for (std::size_t i = 0; i < s.points.size(); ++i)
      s.points[i] += 0.1 * Vec3d{double(i / 3), 0, 0};
    const std::size_t count = self_intersections(s);
    Face_pairs pairs;
    REQUIRE(find_close(s, pairs));
    CHECK(count > 0);
    CHECK(pairs.size() < count + 10);
  }
}

TEST_CASE("self-intersections: a backend that finds too many pairs says so")
{
  Soup s = shapes::icosphere(2);
  for (Vec3d& p : s.points) p = {p.x, 0, 0}; // no face has an area
  Face_pairs pairs;
  CHECK(!find_close(s, pairs));
  CHECK(self_intersections(s) == s.triangles.size());
}
