// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <doctest/doctest.h>

#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/optimization/Multigrid_gradients.h>

#include <CGAL/tags.h>

#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace CGAL::PowerRTF;

/// A Laplacian and the rows that view it.
template <class Real>
struct Graph {
  std::vector<int> size, column;
  std::vector<Real> value;
  std::vector<double> diagonal;
  double screening = 0;

  explicit Graph(int n)
      : size(n, 0), column(std::size_t(n) * Laplacian_rows<Real>::capacity), value(column.size()),
        diagonal(n, 0)
  {}
  Laplacian_rows<Real> rows()
  {
    return {size.data(), column.data(), value.data(), diagonal.data(), int(size.size()), screening};
  }
  void add(int i, int j, Real v)
  {
    const Laplacian_rows<Real> a = rows();
    for (int side = 0; side < 2; ++side, std::swap(i, j)) {
      REQUIRE(size[i] < Laplacian_rows<Real>::capacity);
      a.column[a.place(size[i], i)] = j;
      a.value[a.place(size[i]++, i)] = v;
      diagonal[i] += v;
    }
  }
  void screen(double part)
  {
    screening = part;
    for (double& d : diagonal) d *= 1 + part;
  }
  /// The product, written otherwise than in the solver.
  std::vector<double> times(const std::vector<double>& x)
  {
    const Laplacian_rows<Real> a = rows();
    std::vector<double> y(x.size());
    for (int i = 0; i < a.n; ++i) {
      y[i] = diagonal[i] * x[i];
      for (int k = 0; k < size[i]; ++k) y[i] -= a.value[a.place(k, i)] * x[a.column[a.place(k, i)]];
    }
    return y;
  }
};

int morton(int x, int y)
{
  int code = 0;
  for (int bit = 0; bit < 15; ++bit)
    code |= (x >> bit & 1) << 2 * bit | (y >> bit & 1) << (2 * bit + 1);
  return code;
}

/// m x m cells around a torus, m a power of two, along the Morton curve; with diagonals.
template <class Real>
Graph<Real> torus(int m, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> ratio(0.05, 0.6);
  Graph<Real> g(m * m);
  for (int x = 0; x < m; ++x)
    for (int y = 0; y < m; ++y) {
      const int i = morton(x, y), u = (x + 1) % m, v = (y + 1) % m;
      for (const int j : {morton(u, y), morton(x, v), morton(u, v)}) g.add(i, j, ratio(random));
    }
  return g;
}

std::vector<double> noise(int n, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<double> r(n);
  double mean = 0;
  for (double& x : r) mean += (x = value(random)) / n;
  for (double& x : r) x -= mean;
  return r;
}

double norm(const std::vector<double>& x)
{
  double s = 0;
  for (const double v : x) s += v * v;
  return std::sqrt(s);
}

double dot(const std::vector<double>& x, const std::vector<double>& y)
{
  double s = 0;
  for (std::size_t i = 0; i < x.size(); ++i) s += x[i] * y[i];
  return s;
}

struct Solution {
  std::vector<double> x;
  int iterations;
  double error; // of the residual, relative
};

template <class Tag = CGAL::Sequential_tag, class Real>
Solution solve(Graph<Real>& g, const std::vector<double>& right_side, double tolerance,
               const std::vector<double>* limits = nullptr)
{
  Host_backend<Tag> loops;
  Multigrid_gradients<Real, Host_backend<Tag>> gradients(loops);
  Solution s{std::vector<double>(right_side.size()), 0, 0};
  std::vector<double> r = right_side;
  s.iterations =
      gradients.solve(g.rows(), s.x.data(), r.data(), limits ? limits->data() : nullptr, tolerance);
  std::vector<double> left = g.times(s.x);
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= right_side[i];
  s.error = norm(left) / norm(right_side);
  return s;
}

} // namespace

TEST_CASE_TEMPLATE("The residual falls; iterations hardly grow with n", Real, float, double)
{
  for (const int m : {32, 128, 512})
    for (const bool is_smooth : {false, true}) {
      CAPTURE(m);
      CAPTURE(is_smooth);
      Graph<Real> g = torus<Real>(m, 1);
      std::vector<double> r = noise(m * m, 2);
      if (is_smooth) // a wave around the torus: the diagonal alone would take m iterations and more
        for (int x = 0; x < m; ++x)
          for (int y = 0; y < m; ++y) r[morton(x, y)] = std::sin(2 * 3.14159265358979 * x / m);
      const Solution s = solve(g, r, 1e-4);
      CHECK(s.error <= 1.01e-4);
      CHECK(s.iterations <= 5 + 2.5 * std::log2(m));
    }
}

TEST_CASE("Screened rows take a few iterations, whatever n")
{
  for (const int m : {64, 512})
    for (const double part : {0.1, 0.01, 0.001}) {
      CAPTURE(m);
      CAPTURE(part);
      Graph<float> g = torus<float>(m, 1);
      g.screen(part);
      std::vector<double> r(m * m, 0);
      r[m] = 1; // its sum need not be 0
      const Solution s = solve(g, r, 0.03);
      CHECK(s.error <= 0.0301);
      CHECK(s.iterations <= 5);
    }
}

TEST_CASE("Small systems")
{
  Graph<double> one(1); // no equation
  CHECK(solve(one, {1}, 1e-3).x[0] == 0);
  Graph<double> two(2);
  two.add(0, 1, 0.5);
  const Solution s = solve(two, {1, -1}, 1e-9);
  CHECK(s.x[0] - s.x[1] == doctest::Approx(2));
  for (const int n : {3, 4, 5, 17}) { // a path
    Graph<double> path(n);
    for (int i = 0; i + 1 < n; ++i) path.add(i, i + 1, 1);
    CHECK(solve(path, noise(n, n), 1e-9).error <= 1e-8);
  }
}

TEST_CASE("The same bits for any number of threads")
{
  Graph<double> g = torus<double>(64, 3);
  const std::vector<double> r = noise(64 * 64, 4);
  CHECK(solve(g, r, 1e-6).x == solve<CGAL::Parallel_if_available_tag>(g, r, 1e-6).x);
}

TEST_CASE("Enough is where all residuals are below their limits")
{
  Graph<double> g = torus<double>(64, 5);
  const std::vector<double> r = noise(64 * 64, 6), limits(r.size(), 0.05);
  const Solution s = solve(g, r, 1e-12, &limits), exact = solve(g, r, 1e-12);
  CHECK(s.iterations > 0);
  CHECK(s.iterations < exact.iterations);
  const std::vector<double> left = g.times(s.x);
  for (std::size_t i = 0; i < r.size(); ++i) REQUIRE(std::abs(left[i] - r[i]) <= 0.05);
}

TEST_CASE("Components, cells without edges, and cells that are tied to a fixed site")
{
  const int m = 32, n = m * m;
  Graph<double> one = torus<double>(m, 7), g(2 * n + 3);
  const auto rows = one.rows();
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < rows.size[i]; ++k)
      if (rows.column[rows.place(k, i)] < i) // numbers of both components alternate
        for (int side = 0; side < 2; ++side)
          g.add(2 * i + side, 2 * rows.column[rows.place(k, i)] + side,
                rows.value[rows.place(k, i)]);
  g.diagonal[1] += 0.3; // the second component is tied
  std::vector<double> r(2 * n + 3, 0);
  const std::vector<double> a = noise(n, 8), b = noise(n, 9);
  for (int i = 0; i < n; ++i) {
    r[2 * i] = a[i];
    r[2 * i + 1] = b[i] + 0.1; // its sum need not be 0
  }
  const Solution s = solve(g, r, 1e-9);
  CHECK(s.error <= 1e-8);
  r[2 * n] = 1; // no edge: nothing can be done
  CHECK(solve(g, r, 1e-9).x[2 * n] == 0);
}

/// Four cells in a row, and four more, have an edge with one of each of the others.
template <class Real>
Graph<Real> two_hubs(int n)
{
  constexpr int others = 12; // a row has room for them, but not for those of four rows
  Graph<Real> g(n);
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < others; ++k) g.add(i, 8 + 4 * (others * (i % 4) + k) + i / 4, 1);
  for (int i = 8; i + 1 < n; ++i) g.add(i, i + 1, 1);
  g.add(3, 4, 1);
  return g;
}

TEST_CASE("Where a coarse row has no room, the solution is right all the same")
{
  Graph<double> g = two_hubs<double>(400);
  CHECK(solve(g, noise(400, 10), 1e-9).error <= 1e-8);
}

TEST_CASE_TEMPLATE("A cycle is symmetric and positive definite", Real, float, double)
{
  for (const bool is_regular : {true, false}) {
    Graph<Real> g = is_regular ? torus<Real>(32, 11) : two_hubs<Real>(400);
    const int n = g.rows().n;
    Host_backend<CGAL::Sequential_tag> loops;
    Multigrid<Real, Host_backend<CGAL::Sequential_tag>> multigrid(loops);
    multigrid.set_rows(g.rows());
    const auto apply = [&](const std::vector<double>& r) {
      const Real* z = multigrid.apply(r.data());
      return std::vector<double>(z, z + r.size());
    };
    const double epsilon = sizeof(Real) == 4 ? 1e-4 : 1e-12;
    for (unsigned seed = 0; seed < 5; ++seed) {
      const std::vector<double> r = noise(n, 2 * seed), s = noise(n, 2 * seed + 1);
      CHECK(std::abs(dot(apply(r), s) - dot(r, apply(s))) <= epsilon * norm(r) * norm(s));
      CHECK(dot(r, apply(r)) > 0);
    }
  }
}

TEST_CASE("Numbers that are none give 0")
{
  Graph<double> g = torus<double>(8, 12);
  std::vector<double> r = noise(64, 13);
  r[5] = std::nan("");
  const Solution s = solve(g, r, 1e-3);
  CHECK(s.iterations == -1);
  for (const double x : s.x) CHECK(x == 0);
}
