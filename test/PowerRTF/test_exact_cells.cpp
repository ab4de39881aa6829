// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exact cells and their predicates against brute force in rational arithmetic.
// The long version (ten thousand configurations): --no-skip --test-suite=long
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include "exact_brute_force.h"
#include "random_input.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <functional>
#include <random>
#include <string>

using namespace CGAL::PowerRTF;
using namespace exact_test;
using random_input::Random;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cells = Exact_cells<Kernel>;

namespace
{

struct Family {
  std::string name;
  int max_size;
  std::function<void(Configuration&, int, Random&)> fill; // points, normals; weights are 0 before
};

void add(Configuration& c, const Vec3d& p, const Vec3d& n)
{
  c.points.push_back(p);
  c.normals.push_back(n);
}

void sphere(Configuration& c, int n, Random& r)
{
  for (int k = 0; k < n; ++k) {
    const Vec3d d = r.direction();
    add(c, d, d);
  }
}

void scale(Configuration& c, double s)
{
  for (Vec3d& p : c.points) p *= s;
  for (double& w : c.weights) w *= s * s;
}

void random_weights(Configuration& c, double size, Random& r)
{
  c.weights.clear();
  for (std::size_t k = 0; k < c.points.size(); ++k) c.weights.push_back(r.real(-size, size));
}

/// Explicit perturbation, for small integer coordinates and at most 40 samples.
constexpr int perturbation_bits = 120;

Vec3d small_direction(Random& r)
{
  Vec3d v{0, 0, 0};
  while (v == Vec3d{0, 0, 0})
    v = {double(r.integer(-1, 1)), double(r.integer(-1, 1)), double(r.integer(-1, 1))};
  return v;
}

const std::vector<Family>& families()
{
  static const std::vector<Family> all = {
      {"volume", 300,
       [](Configuration& c, int n, Random& r) {
         for (int k = 0; k < n; ++k) add(c, r.in_box(), r.direction());
         random_weights(c, 0.02, r);
       }},
      {"volume, normals that drop neighbours", 300,
       [](Configuration& c, int n, Random& r) {
         for (int k = 0; k < n; ++k) add(c, r.in_box(), r.direction());
         random_weights(c, 0.02, r);
         c.cos_theta = n > 1 && r.integer(0, 1) ? dot(c.normals[0], c.normals[1]) // just not above
                                                : r.real(-0.9, 0.7);
       }},
      {"sphere", 300,
       [](Configuration& c, int n, Random& r) {
         sphere(c, n, r);
         c.cos_theta = r.integer(0, 1) ? 0.5 : -2;
         if (r.integer(0, 1)) random_weights(c, 1. / n, r);
       }},
      {"plane", 300,
       [](Configuration& c, int n, Random& r) {
         const Vec3d u = r.direction(), v = normalized(cross(u, r.direction()));
         for (int k = 0; k < n; ++k) add(c, u * r.real(-1, 1) + v * r.real(-1, 1), cross(u, v));
         if (r.integer(0, 1)) random_weights(c, 1. / n, r);
       }},
      {"coordinate plane", 300,
       [](Configuration& c, int n, Random& r) {
         for (int k = 0; k < n; ++k) add(c, {r.real(-1, 1), 0.25, r.real(-1, 1)}, {0, -1, 0});
         random_weights(c, 1. / n, r);
       }},
      {"cylinder", 300,
       [](Configuration& c, int n, Random& r) {
         for (int k = 0; k < n; ++k) {
           const double a = r.real(0, 6.28);
           add(c, {std::cos(a), std::sin(a), r.real(-2, 2)}, {std::cos(a), std::sin(a), 0});
         }
         c.cos_theta = r.real(-0.5, 0.5);
       }},
      {"two sheets", 300,
       [](Configuration& c, int n, Random& r) {
         const double gap = r.real(0, 1e-3);
         for (int k = 0; k < n; ++k)
           add(c, {r.real(-1, 1), r.real(-1, 1), k % 2 ? gap : 0}, {0, 0, k % 2 ? 1. : -1.});
         c.cos_theta = -0.17;
       }},
      {"large weights", 300,
       [](Configuration& c, int n, Random& r) {
         sphere(c, n, r);
         random_weights(c, 50 * 12.6 / n, r);
         c.cos_theta = r.integer(0, 1) ? 0. : -2;
       }},
      {"tiny scale", 200,
       [](Configuration& c, int n, Random& r) {
         sphere(c, n, r);
         random_weights(c, 2. / n, r);
         scale(c, 1e-12);
       }},
      {"huge scale", 200,
       [](Configuration& c, int n, Random& r) {
         sphere(c, n, r);
         random_weights(c, 2. / n, r);
         scale(c, 1e12);
       }},
      {"far from the origin", 200,
       [](Configuration& c, int n, Random& r) {
         sphere(c, n, r);
         for (Vec3d& p : c.points) p = p * 1e-6 + Vec3d{1, 1, 1};
       }},
      {"nearly cocircular", 200,
       [](Configuration& c, int n, Random& r) {
         const Vec3d u = r.direction(), v = normalized(cross(u, r.direction()));
         for (int k = 0; k < n; ++k)
           add(c,
               u * (0.1 * r.integer(0, 15)) + v * (0.1 * r.integer(0, 15)) + u * r.real(0, 1e-15),
               cross(u, v));
       }},
      {"nearly coincident", 200,
       [](Configuration& c, int n, Random& r) {
         for (int k = 0; k < n; ++k) {
           const bool again = k > 0 && r.integer(0, 1);
           const Vec3d p = again ? c.points[r.integer(0, k - 1)] : r.in_box();
           add(c, p + r.in_box() * 1e-15, normalized(Vec3d{0, 0.1, 1} + r.in_box() * 1e-9));
         }
       }},
      {"grid", 40,
       [](Configuration& c, int n, Random& r) {
         const int side = r.integer(2, 4);
         for (int k = 0; k < n; ++k)
           add(c, {double(k % side), double(k / side % side), double(k / side / side)},
               small_direction(r));
         c.bits = perturbation_bits;
       }},
      {"flat grid", 40,
       [](Configuration& c, int n, Random&) {
         for (int k = 0; k < n; ++k) add(c, {double(k % 6), double(k / 6), 0}, {0, 0, 1});
         c.bits = perturbation_bits;
       }},
      {"grid with weights and duplicates", 40,
       [](Configuration& c, int n, Random& r) {
         for (int k = 0; k < n; ++k) {
           add(c, {double(r.integer(0, 2)), double(r.integer(0, 2)), double(r.integer(0, 1))},
               small_direction(r));
           c.weights[k] = r.integer(-1, 1);
         }
         c.cos_theta = r.integer(0, 1) ? -2 : -0.5;
         c.bits = perturbation_bits;
       }},
      {"collinear", 30,
       [](Configuration& c, int n, Random& r) {
         const Vec3d d = small_direction(r), normal = small_direction(r);
         for (int k = 0; k < n; ++k) {
           add(c, d * double(r.integer(-8, 8)), normal);
           c.weights[k] = r.integer(0, 1) ? 0 : r.integer(-9, 9);
         }
         c.bits = perturbation_bits;
       }},
  };
  return all;
}

Configuration make(const Family& family, int n, std::uint64_t seed)
{
  Random r(seed);
  Configuration c;
  c.weights.assign(n, 0.);
  family.fill(c, n, r);
  // The order decides ties: do not let it follow the coordinates.
  for (int k = n - 1; k > 0; --k) {
    const int other = r.integer(0, k);
    std::swap(c.points[k], c.points[other]);
    std::swap(c.normals[k], c.normals[other]);
    std::swap(c.weights[k], c.weights[other]);
  }
  return c;
}

/// A square about as large as some cells, in a frame that is tangent up to rounding only.
Exact_square make_square(const Configuration& c, int i, Random& r)
{
  const Vec3d n = normalized(c.normals[i]);
  if (c.bits > 0) { // small integers
    const Vec3d a = n.x == 0 ? Vec3d{1, 0, 0} : n.y == 0 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
    const Vec3d u = cross(c.normals[i], a);
    return {u, cross(c.normals[i], u), 0.5 * r.integer(1, 4)};
  }
  const Vec3d u = normalized(cross(n, r.direction()));
  double size = 0;
  for (const Vec3d& p : c.points) size = std::max(size, length(p - c.points[i]));
  return {u, cross(n, u), (size > 0 ? size : 1) * std::pow(10., r.real(-1.5, 0.5))};
}

struct Tally {
  int cells = 0, ties = 0, by_triangulation = 0, unbounded = 0, empty = 0;
  Filter_statistics filter;
};

/// Checks `samples` cells of c (all when negative); for every cell both ways to the neighbours.
void check(const Configuration& c, int samples, std::uint64_t seed, Tally& tally)
{
  const int n = int(c.points.size());
  const Cells cells(c.points, c.normals, c.weights, c.cos_theta);
  const Cells by_search(c.points, c.normals, c.weights, c.cos_theta, Exact_neighbours::search);
  Random r(~seed); // not the stream that made the configuration
  int wrong = 0, differing = 0;
  for (int i = 0; i < n; ++i) {
    if (cells.cell(i).neighbours != by_search.cell(i).neighbours) ++differing;
  }
  CHECK(differing == 0);
  const int count = samples < 0 ? n : std::min(n, samples);
  for (int k = 0; k < count; ++k) {
    const int i = samples < 0 || n <= samples ? k : r.integer(0, n - 1);
    const Exact_square box = make_square(c, i, r);
    const Exact_square* square = r.integer(0, 1) ? &box : nullptr;
    const Exact_cell cell = cells.cell(i, square, &tally.filter);
    const Brute_cell expected = brute_force(c, i, square);
    ++tally.cells;
    if (cell.by_triangulation) ++tally.by_triangulation;
    if (cell.is_empty()) ++tally.empty;
    if (!square && cell.reaches_square()) ++tally.unbounded;
    if (expected.tie) {
      ++tally.ties;
      continue;
    }
    if (cell.neighbours != expected.neighbours || cell.contains_site != expected.contains_site) {
      ++wrong;
      continue;
    }
    if (cell.is_empty() || (!square && cell.reaches_square()) || c.bits > 0) continue;

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

void check_family(const Family& family, int configurations, std::uint64_t first_seed)
{
  Tally tally;
  for (int k = 0; k < configurations; ++k) {
    const std::uint64_t seed = first_seed + k;
    Random r(seed);
    const int n = k < 8 ? k : r.integer(5, r.integer(5, family.max_size));
    CAPTURE(family.name);
    CAPTURE(seed);
    CAPTURE(n);
    check(make(family, n, seed), n <= 12 ? -1 : 6, seed, tally);
  }
  MESSAGE(family.name << ": " << tally.cells << " cells, " << tally.by_triangulation
                      << " by triangulation, " << tally.empty << " empty, " << tally.unbounded
                      << " unbounded, " << tally.ties << " ties not compared, filter "
                      << tally.filter.filtered_share());
  CHECK(tally.cells > configurations);
  CHECK(tally.ties * 4 < tally.cells);
}

} // namespace

TEST_CASE("cells equal brute force")
{
  for (const Family& family : families()) check_family(family, 24, 100);
}

TEST_CASE("cells equal brute force, ten thousand configurations" * doctest::test_suite("long") *
          doctest::skip())
{
  for (const Family& family : families()) check_family(family, 600, 1000);
}

TEST_CASE("triangulation is used where it suffices")
{
  Configuration c = make(families()[0], 200, 5);
  c.weights.assign(200, 0.); // none hidden
  const Cells cells(c.points, c.normals, c.weights, c.cos_theta);
  int used = 0;
  for (int i = 0; i < 200; ++i) used += cells.cell(i).by_triangulation;
  CHECK(used == 200);
}

TEST_CASE("no samples, one sample")
{
  CHECK(Cells({}, {}, {}, 0).size() == 0);
  const Cells one({{1, 2, 3}}, {{0, 0, 2}}, {7}, 0);
  CHECK(one.cell(0).neighbours == std::vector<int>{-4, -1, -2, -3});
  CHECK(one.cell(0).contains_site);
  CHECK(std::isinf(one.geometry(0, one.cell(0)).area));
  const Exact_square square{{1, 0, 0}, {0, 1, 0}, 0.5};
  const Exact_cell cell = one.cell(0, &square);
  CHECK(cell.neighbours == std::vector<int>{-4, -1, -2, -3});
  CHECK(one.geometry(0, cell, &square).area == doctest::Approx(1));
}

TEST_CASE("of duplicates with equal weights the smallest index has the cell")
{
  const std::vector<Vec3d> p{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  const Cells cells(p, std::vector<Vec3d>(5, {0, 0, 1}), std::vector<double>(5, 0.), 0);
  CHECK(cells.cell(0).contains_site);
  CHECK(cells.cell(0).neighbours == std::vector<int>{-4, 1, -2, -3});
  CHECK(cells.cell(1).neighbours == std::vector<int>{-4, -1, -2, 0});
  for (int i = 2; i < 5; ++i) CHECK(cells.cell(i).is_empty());
}

TEST_CASE("cells do not depend on scale or on the samples' order")
{
  for (std::uint64_t seed : {1, 2, 3}) {
    Configuration c = make(families()[1], 120, seed);
    const Cells cells(c.points, c.normals, c.weights, c.cos_theta);
    const int n = int(c.points.size());
    scale(c, 1. / (1 << 20));
    const Cells scaled(c.points, c.normals, c.weights, c.cos_theta);
    std::reverse(c.points.begin(), c.points.end());
    std::reverse(c.normals.begin(), c.normals.end());
    std::reverse(c.weights.begin(), c.weights.end());
    const Cells reversed(c.points, c.normals, c.weights, c.cos_theta);
    for (int i = 0; i < n; ++i) {
      const Exact_cell cell = cells.cell(i);
      CHECK(scaled.cell(i).neighbours == cell.neighbours);
      std::vector<int> other = reversed.cell(n - 1 - i).neighbours;
      for (int& id : other)
        if (id >= 0) id = n - 1 - id;
      std::rotate(other.begin(), std::min_element(other.begin(), other.end()), other.end());
      CHECK(other == cell.neighbours);
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
