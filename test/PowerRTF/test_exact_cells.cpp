// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exact cells and their predicates against brute force in rational arithmetic.
// The long version (ten thousand clouds): --no-skip --test-suite=long
#include <doctest/doctest.h>

#include "exact_brute_force.h"
#include "tangent_predicates.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using namespace exact_test;
using namespace sample_families;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cells = Exact_cells<Kernel>;

namespace {

/// Explicit perturbation, for small integers and at most `max_integer_size` samples.
constexpr int perturbation_bits = 120, max_integer_size = 40, max_size = 300;

Cells cells_by_search(const Cloud& c)
{
  const Samples& s = c.samples;
  return Cells(s.points, s.normals, s.weights, c.cos_angle);
}

Cells exact_cells(const Cloud& c)
{
  Cells cells = cells_by_search(c);
  cells.triangulate();
  return cells;
}

Cloud shuffled(Cloud c, Random& r)
{
  for (int k = int(c.size()) - 1; k > 0; --k) {
    const int other = r.integer(0, k);
    std::swap(c.samples.points[k], c.samples.points[other]);
    std::swap(c.samples.normals[k], c.samples.normals[other]);
    std::swap(c.samples.weights[k], c.samples.weights[other]);
  }
  return c;
}

/// The order decides ties: it shall not follow the coordinates.
Cloud make(const Family& family, int n, std::uint64_t seed)
{
  Random r(seed);
  const Cloud ordered = family.make(n, r);
  return shuffled(ordered, r);
}

/// A square about as large as some cells, in a frame that is tangent up to rounding only.
Exact_square make_square(const Samples& samples, int i, bool among_integers, Random& r)
{
  const Vec3d &normal = samples.normals[i], n = normalized(normal);
  if (among_integers) {
    const Vec3d a = n.x == 0 ? Vec3d{1, 0, 0} : n.y == 0 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
    const Vec3d u = cross(normal, a);
    return {u, cross(normal, u), 0.5 * r.integer(1, 4)};
  }
  const Vec3d u = normalized(cross(n, r.direction()));
  double size = 0;
  for (const Vec3d& p : samples.points) size = std::max(size, length(p - samples.points[i]));
  return {u, cross(n, u), (size > 0 ? size : 1) * std::pow(10., r.real(-1.5, 0.5))};
}

struct Tally {
  int cells = 0, ties = 0, by_triangulation = 0, unbounded = 0, empty = 0;
  Filter_statistics filter;
};

/// Checks `samples` cells of c (all when negative), for every cell both ways to the neighbors.
/// `bits`: of the explicit perturbation.
void check(const Cloud& c, int bits, int samples, std::uint64_t seed, Tally& tally)
{
  const int n = int(c.size());
  const Cells cells = exact_cells(c), by_search = cells_by_search(c);
  Random r(~seed); // not the stream that made the cloud
  int wrong = 0, differing = 0;
  for (int i = 0; i < n; ++i) {
    if (cells.cell(i).neighbors != by_search.cell(i).neighbors) ++differing;
  }
  CHECK(differing == 0);
  const int count = samples < 0 ? n : std::min(n, samples);
  for (int k = 0; k < count; ++k) {
    const int i = samples < 0 || n <= samples ? k : r.integer(0, n - 1);
    const Exact_square box = make_square(c.samples, i, bits > 0, r);
    const Exact_square* square = r.integer(0, 1) ? &box : nullptr;
    const Exact_cell cell = cells.cell(i, square, &tally.filter);
    const Brute_cell expected = brute_force(c, bits, i, square);
    ++tally.cells;
    if (cell.by_triangulation) ++tally.by_triangulation;
    if (cell.is_empty()) ++tally.empty;
    if (!square && cell.reaches_square()) ++tally.unbounded;
    if (expected.tie) {
      ++tally.ties;
      continue;
    }
    if (cell.neighbors != expected.neighbors || cell.contains_site != expected.contains_site) {
      ++wrong;
      continue;
    }
    if (cell.is_empty() || (!square && cell.reaches_square()) || bits > 0) continue;

    const Exact_cell_geometry g = cells.geometry(i, cell, square);
    double radius = 0;
    for (const Vec3d& v : g.vertices) radius = std::max(radius, length(v));
    if (std::fabs(g.area - expected.area) > 1e-13 * radius * radius) ++wrong;
    for (std::size_t e = 0; e < expected.lengths.size(); ++e) {
      if (g.edge_lengths[e] < expected.lengths[e] * (1 - 1e-15) ||
          g.edge_lengths[e] > expected.lengths[e] * (1 + 1e-12))
        ++wrong;
    }
    if (expected.area > 1e-6 * radius * radius &&
        length(g.centroid - expected.centroid) > 1e-9 * radius)
      ++wrong;
  }
  CHECK(wrong == 0);
}

void check_family(const Family& family, int clouds, std::uint64_t first_seed)
{
  const bool among_integers = family.ties == Ties::among_integers;
  Tally tally;
  for (int k = 0; k < clouds; ++k) {
    const std::uint64_t seed = first_seed + k;
    Random r(seed);
    const int n =
        k < 8 ? k : r.integer(5, r.integer(5, among_integers ? max_integer_size : max_size));
    CAPTURE(family.name);
    CAPTURE(seed);
    CAPTURE(n);
    check(make(family, n, seed), among_integers ? perturbation_bits : 0, n <= 12 ? -1 : 6, seed,
          tally);
  }
  MESSAGE(family.name << ": " << tally.cells << " cells, " << tally.by_triangulation
                      << " by triangulation, " << tally.empty << " empty, " << tally.unbounded
                      << " unbounded, " << tally.ties << " ties not compared, filter "
                      << tally.filter.filtered_share());
  CHECK(tally.cells > clouds);
  if (family.ties != Ties::frequent) CHECK(tally.ties * 4 < tally.cells);
}

} // namespace

TEST_CASE("cells equal brute force")
{
  for (const Family& family : families()) check_family(family, 24, 100);
}

TEST_CASE("cells equal brute force, ten thousand clouds" * doctest::test_suite("long") *
          doctest::skip())
{
  for (const Family& family : families()) check_family(family, 600, 1000);
}

TEST_CASE("triangulation is used where it suffices")
{
  Cloud c = make(family("white noise with normals of white noise"), 200, 5); // none hidden
  c.cos_angle = -2;
  const Cells cells = exact_cells(c);
  int used = 0;
  for (int i = 0; i < 200; ++i) used += cells.cell(i).by_triangulation;
  CHECK(used == 200);
}

TEST_CASE("no samples, one sample")
{
  CHECK(Cells({}, {}, {}, 0).size() == 0);
  const Cells one({{1, 2, 3}}, {{0, 0, 2}}, {7}, 0);
  CHECK(one.cell(0).neighbors == std::vector<int>{-4, -1, -2, -3});
  CHECK(one.cell(0).contains_site);
  CHECK(std::isinf(one.geometry(0, one.cell(0)).area));
  const Exact_square square{{1, 0, 0}, {0, 1, 0}, 0.5};
  const Exact_cell cell = one.cell(0, &square);
  CHECK(cell.neighbors == std::vector<int>{-4, -1, -2, -3});
  CHECK(one.geometry(0, cell, &square).area == doctest::Approx(1));
}

TEST_CASE("of duplicates with equal weights the smallest index has the cell")
{
  const std::vector<Vec3d> p{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  const Cells cells(p, std::vector<Vec3d>(5, {0, 0, 1}), std::vector<double>(5, 0.), 0);
  CHECK(cells.cell(0).contains_site);
  CHECK(cells.cell(0).neighbors == std::vector<int>{-4, 1, -2, -3});
  CHECK(cells.cell(1).neighbors == std::vector<int>{-4, -1, -2, 0});
  for (int i = 2; i < 5; ++i) CHECK(cells.cell(i).is_empty());
}

TEST_CASE("cells do not depend on scale or on the samples' order")
{
  for (std::uint64_t seed : {1, 2, 3}) {
    Cloud c = make(family("volume with weights, just incompatible normals"), 120, seed);
    const Cells cells = exact_cells(c);
    const int n = int(c.size());
    scale(c, 1. / (1 << 20));
    const Cells scaled = exact_cells(c);
    std::reverse(c.samples.points.begin(), c.samples.points.end());
    std::reverse(c.samples.normals.begin(), c.samples.normals.end());
    std::reverse(c.samples.weights.begin(), c.samples.weights.end());
    const Cells reversed = exact_cells(c);
    for (int i = 0; i < n; ++i) {
      const Exact_cell cell = cells.cell(i);
      CHECK(scaled.cell(i).neighbors == cell.neighbors);
      std::vector<int> other = reversed.cell(n - 1 - i).neighbors;
      for (int& id : other)
        if (id >= 0) id = n - 1 - id;
      std::rotate(other.begin(), std::min_element(other.begin(), other.end()), other.end());
      CHECK(other == cell.neighbors);
    }
  }
}

TEST_CASE("unusable input is refused")
{
  const Vec3d o{0, 0, 0}, z{0, 0, 1};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(Cells({o}, {z, z}, {0}, 0), Invalid_input_error);
  CHECK_THROWS_AS(Cells({o}, {z}, {}, 0), Invalid_input_error);
  CHECK_THROWS_AS(Cells({o}, {o}, {0}, 0), Invalid_input_error);
  CHECK_THROWS_AS(Cells({{nan, 0, 0}}, {z}, {0}, 0), Invalid_input_error);
  CHECK_THROWS_AS(Cells({o}, {z}, {nan}, 0), Invalid_input_error);
  const Cells cells({o}, {z}, {0}, 0);
  const Exact_square left_handed{{0, 1, 0}, {1, 0, 0}, 1}, no_size{{1, 0, 0}, {0, 1, 0}, 0};
  CHECK_THROWS_AS(cells.cell(0, &left_handed), Invalid_input_error);
  CHECK_THROWS_AS(cells.cell(0, &no_size), Invalid_input_error);
}

TEST_CASE_TEMPLATE("predicates equal rational determinants", K,
                   CGAL::Exact_predicates_inexact_constructions_kernel,
                   CGAL::Exact_predicates_exact_constructions_kernel,
                   CGAL::Simple_cartesian<double>)
{
  using Traits = Tangent_cell_traits_3<K>;
  using Sample = Indexed_sample_3<Traits>;
  Filter_statistics statistics;
  const Orientation_in_tangent_plane_3<Traits> orientation;
  const Side_of_tangent_vertex_3<Traits> side(Traits(), &statistics);
  Random r(11);
  int vertices = 0;
  for (int round = 0; round < 3000; ++round) {
    const bool integers = round % 2 == 0;
    const Vec3d normal = integers ? small_direction(r) : r.direction();
    const typename K::Vector_3 n(normal.x, normal.y, normal.z);
    std::vector<Sample> s;
    std::vector<Q3> p;
    std::vector<Q> w;
    for (int k = 0; k < 4; ++k) {
      const Vec3d x = integers ? Vec3d{double(r.integer(0, 3)), double(r.integer(0, 3)),
                                       double(r.integer(0, 3))}
                               : r.in_box();
      const double weight = integers ? r.integer(0, 2) : r.real(-1, 1);
      s.push_back({typename K::Point_3(x.x, x.y, x.z), typename K::FT(weight), k});
      p.push_back(Q3(x));
      w.push_back(Q(weight) + (integers ? power_of_two(-perturbation_bits * (k + 1)) : Q(0)));
    }
    // The linear system n.x = 0, 2 v_j.x = c_j, 2 v_k.x = c_k by Cramer's rule with 3D vectors.
    const Q3 m(normal), v_j = minus(p[1], p[0]), v_k = minus(p[2], p[0]), v_l = minus(p[3], p[0]);
    const auto offset = [&](const Q3& v, int k) { return Q((dot(v, v) + w[0] - w[k]) / 2); };
    const Q det = dot(m, cross(v_j, v_k));
    CHECK(orientation(s[0], n, s[1], s[2]) == CGAL::sign(det));
    const auto answer = side(s[0], n, s[1], s[2], s[3]);
    CHECK(answer == side(s[0], n, s[2], s[1], s[3]));
    if (det == 0) {
      CHECK(answer == CGAL::ON_ORIENTED_BOUNDARY);
      continue;
    }
    ++vertices;
    const Q3 e_j = cross(v_k, m), e_k = cross(m, v_j);
    const Q along_l = (offset(v_j, 1) * dot(e_j, v_l) + offset(v_k, 2) * dot(e_k, v_l)) / det;
    const Q slack = offset(v_l, 3) - along_l;
    REQUIRE(slack != 0);
    CHECK(answer == CGAL::sign(slack));
  }
  CHECK(vertices > 2000);
  CHECK(statistics.ties > 0);
  CHECK(statistics.exact >= statistics.ties);
  CHECK(statistics.filtered > statistics.exact);
}
