// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rules and solvers of weights and positions against closed forms.
#include <doctest/doctest.h>

#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/optimization/Cell_summary.h>
#include <CGAL/PowerRTF/optimization/Lbfgs.h>
#include <CGAL/PowerRTF/optimization/Newton_solver.h>
#include <CGAL/PowerRTF/optimization/multiplicative_weights.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

using namespace CGAL::PowerRTF;
using doctest::Approx;

namespace {

using Backend = Host_backend<CGAL::Sequential_tag>;

/// An edge of cell i with cell j: its length over the distance of the sites.
struct Capacity_edge {
  int i, j;
  double ratio;
};

std::vector<double> newton_direction(const std::vector<double>& areas,
                                     const std::vector<double>& density,
                                     const std::vector<Capacity_edge>& edges,
                                     const std::vector<unsigned char>& keeps_area,
                                     double capacity_tolerance = 0,
                                     const Newton_goal& goal = global_newton_goal)
{
  const int n = int(areas.size());
  Backend backend;
  Newton_solver<double, Backend> solver(backend);
  Cell_outputs<double> out;
  solver.add_outputs(n, out);
  std::fill(out.edge_count, out.edge_count + n, 0);
  for (const Capacity_edge& e : edges) {
    if (out.edge_count[e.i] == out.edge_capacity) continue;
    const std::size_t place = std::size_t(out.edge_count[e.i]++) * n + e.i;
    out.edge_neighbor[place] = e.j;
    out.edge_ratio[place] = float(e.ratio);
  }
  solver.solve(n, areas.data(), density.data(), keeps_area.data(), capacity_tolerance, goal, true);
  return {solver.direction(), solver.direction() + n};
}

/// L-BFGS over vectors.
class Directions {
public:
  explicit Directions(int memory) : m_memory(memory), m_lbfgs(m_backend) {}

  std::vector<Vec3d> operator()(const std::vector<Vec3d>& x, const std::vector<Vec3d>& g,
                                const std::vector<double>& inverse_diagonal)
  {
    const int n = int(x.size());
    if (m_size != n) m_lbfgs.resize(m_size = n, m_memory);
    m_lbfgs.prepare([&](int i) { return x[i]; },
                    [&](int i, Vec3d& gradient, double& inverse) {
                      gradient = g[i];
                      inverse = inverse_diagonal[i];
                    });
    std::vector<Vec3d> result;
    for (int i = 0; i < n; ++i) result.push_back(m_lbfgs.direction()(i, g[i], inverse_diagonal[i]));
    return result;
  }
  void clear() { m_lbfgs.clear(); }

private:
  int m_memory, m_size = 0;
  Backend m_backend;
  Lbfgs<double, Backend, 5> m_lbfgs;
};

} // namespace

TEST_CASE("the paper's rule for one weight")
{
  const double d = 0.5, d2 = d * d;
  const Multiplicative_weight_rule up{0.04, 1, false, 2}, down{0.04, 1, true, 2};
  for (const auto& rule : {up, down}) {
    CHECK(rule(2.0, d) == 0);
    CHECK(rule(2.079, d) == 0); // inside the interval
    CHECK(rule(1.921, d) == 0);
    CHECK(rule(0, d) == Approx(0.2 * d2)); // empty
  }
  // alpha = (excess / gamma - 1), rounded; the change is alpha tau gamma D^2 / 2.
  CHECK(up(2.2, d) == Approx(-2 * 0.04 * d2 / 2)); // 1.5
  CHECK(down(2.2, d) == Approx(-1 * 0.04 * d2 / 2));
  CHECK(up(1.9, d) == Approx(0.04 * d2 / 2)); // 0.25
  CHECK(down(1.9, d) == 0);                   // the printed form parks here
  const Multiplicative_weight_rule slow{0.04, 0.25, false, 2};
  CHECK(slow(2.2, d) == Approx(up(2.2, d) / 4));
  const Multiplicative_weight_rule limit{0, 1, false, 2}; // CCCPD: in proportion
  CHECK(limit(2.2, d) == Approx(-0.1 * d2 / 2));
  CHECK(limit(1.9, d) == Approx(0.05 * d2 / 2));
}

TEST_CASE("Newton's direction in closed form")
{
  // Two cells of areas 1 and 3 with one common edge, as long as the sites are apart.
  const std::vector<Capacity_edge> edges = {{0, 1, 1}, {1, 0, 1}};
  const std::vector<double> direction = newton_direction({1, 3}, {1, 1}, edges, {0, 0});
  REQUIRE(direction.size() == 2);
  CHECK(direction[0] == Approx(1).epsilon(1e-6)); // dA = (dw_0 - dw_1) e / (2 d) = 1
  CHECK(direction[1] == Approx(-1).epsilon(1e-6));
  // Area in inverse proportion to the density: nothing is left to do.
  for (double dw : newton_direction({1, 3}, {3, 1}, edges, {0, 0})) CHECK(std::abs(dw) < 1e-9);
  // The second one keeps its area: nothing can change.
  for (double dw : newton_direction({1, 3}, {1, 1}, edges, {0, 1})) CHECK(std::abs(dw) < 1e-9);
  // Two components: each keeps its area.
  const std::vector<double> apart = newton_direction(
      {1, 3, 10, 10}, {1, 1, 1, 1}, {{0, 1, 1}, {1, 0, 1}, {2, 3, 1}, {3, 2, 1}}, {0, 0, 0, 0});
  CHECK(apart[0] == Approx(1).epsilon(1e-6));
  CHECK(std::abs(apart[2]) < 1e-9);
}

TEST_CASE("Newton's direction for shares within a slack")
{
  const std::vector<Capacity_edge> edges = {{0, 1, 1}, {1, 0, 1}};
  // The mean is 2, so the targets are 1.5 and 2.5; L + diag L / 2 is [.75 -.5; -.5 .75].
  const std::vector<double> direction =
      newton_direction({1, 3}, {1, 1}, edges, {0, 0}, 0.5, {0.5, 1});
  CHECK(direction[0] == Approx(0.5 / 1.25).epsilon(1e-6));
  CHECK(direction[1] == Approx(-0.5 / 1.25).epsilon(1e-6));
  for (double dw : newton_direction({1.6, 2.4}, {1, 1}, edges, {0, 0}, 0.5, {0.5, 1}))
    CHECK(dw == 0); // both are near enough
  // One cell of many is too small: only those around it change.
  const int n = 4000, middle = n / 2;
  std::vector<double> areas(n, 1), density(n, 1);
  areas[middle] = 0.5;
  std::vector<Capacity_edge> chain;
  for (int i = 0; i < n; ++i)
    for (const int j : {(i + 1) % n, (i + n - 1) % n}) chain.push_back({i, j, 1});
  const auto reach = [&](const Newton_goal& goal) { // the largest change far away, of the largest
    const std::vector<double> direction =
        newton_direction(areas, density, chain, std::vector<unsigned char>(n, 0), 0.04, goal);
    double far = 0;
    for (int i = 0; i < n; ++i)
      if (std::abs(i - middle) > n / 4) far = std::max(far, std::abs(direction[i]));
    return far / direction[middle];
  };
  CHECK(reach(local_newton_goal) < 1e-3);
  CHECK(reach(global_newton_goal) > 0.1);
}

TEST_CASE("Newton's goal: changes are confined twice at most, and steps that lead no further tell")
{
  Newton_goal goal = local_newton_goal;
  CHECK(confine(goal));
  CHECK(confine(goal));
  CHECK_FALSE(confine(goal));
  CHECK(goal.screening == Approx(16 * local_newton_goal.screening));
  CHECK(goal.slack == local_newton_goal.slack);
  goal = global_newton_goal; // nothing is confined
  CHECK_FALSE(confine(goal));

  Capacity_statistics before;
  before.inside_interval = 0.9;
  before.rms = before.largest_deviation = 0.1;
  Capacity_statistics after = before;
  CHECK(has_stagnated(before, after));
  CHECK(has_overshot(before, after));
  after.inside_interval = 0.91;
  CHECK_FALSE(has_stagnated(before, after));
  CHECK_FALSE(has_overshot(before, after));
  after = before;
  after.rms = 0.09;
  CHECK_FALSE(has_stagnated(before, after));
  after = before;
  after.largest_deviation = 0.05;
  CHECK_FALSE(has_stagnated(before, after));
  CHECK_FALSE(has_overshot(before, after));
}

TEST_CASE("Newton's direction for many cells: the residual falls as far as is promised")
{
  // Unit squares around a torus whose areas are waves.
  const int m = 320;
  const double angle = 2 * 3.14159265358979 / m;
  std::vector<double> areas, density(m * m, 1);
  std::vector<Capacity_edge> edges;
  for (int i = 0; i < m * m; ++i) {
    const int row = i / m, column = i % m;
    areas.push_back(1 + 0.1 * std::cos(angle * column));
    for (const int j : {(row + 1) % m * m + column, (row + m - 1) % m * m + column,
                        row * m + (column + 1) % m, row * m + (column + m - 1) % m})
      edges.push_back({i, j, 1});
  }
  // Two cells with more edges than there is room for: the first ones stay, on both sides.
  std::vector<Capacity_edge> kept = edges;
  const int room = Laplacian_rows<float>::capacity - 4;
  for (const int hub : {0, m / 2})
    for (int row = 2; row < 42; ++row)
      for (const Capacity_edge& e :
           {Capacity_edge{hub, hub + row * m, 5}, {hub + row * m, hub, 5}}) {
        edges.push_back(e);
        if (row < 2 + room) kept.push_back(e);
      }
  const std::vector<double> direction =
      newton_direction(areas, density, edges, std::vector<unsigned char>(m * m, 0));
  REQUIRE(direction.size() == areas.size());
  std::vector<double> residual;
  double squares = 0, before = 0;
  for (const double area : areas) residual.push_back(1 - area);
  for (const double r : residual) before += r * r;
  for (const Capacity_edge& e : kept)
    residual[e.i] -= e.ratio / 2 * (direction[e.i] - direction[e.j]);
  for (const double r : residual) squares += r * r;
  CHECK(squares <= 0.03 * 0.03 * before);
}

TEST_CASE("L-BFGS on a quadratic energy")
{
  // A chain of points, each pulled to its place and to its neighbors.
  constexpr int n = 200;
  const auto gradient_at = [](const std::vector<Vec3d>& x) {
    std::vector<Vec3d> g(n);
    for (int i = 0; i < n; ++i) {
      g[i] = 0.01 * (1 + i % 5) * (x[i] - Vec3d{double(i), std::sin(i), 1});
      if (i > 0) g[i] += x[i] - x[i - 1];
      if (i + 1 < n) g[i] += x[i] - x[i + 1];
    }
    return g;
  };
  const std::vector<double> inverse_diagonal(n, 0.5);
  const auto residual_after = [&](int iterations, int memory) {
    Directions lbfgs(memory);
    std::vector<Vec3d> x(n, {0, 0, 0});
    for (int k = 0; k < iterations; ++k) {
      const std::vector<Vec3d> step = lbfgs(x, gradient_at(x), inverse_diagonal);
      for (int i = 0; i < n; ++i) x[i] += step[i];
    }
    double squares = 0;
    for (const Vec3d& g : gradient_at(x)) squares += squared_length(g);
    return std::sqrt(squares);
  };
  const double before = residual_after(0, 5), descent = residual_after(100, 0);
  CHECK(residual_after(100, 5) < 1e-4 * before);
  CHECK(residual_after(100, 5) < 0.01 * descent);

  // The first direction, and the one after clear(), is the scaled gradient.
  Directions lbfgs(5);
  const std::vector<Vec3d> x(n, {1, 2, 3}), g = gradient_at(x);
  for (int k = 0; k < 2; ++k) {
    const std::vector<Vec3d> step = lbfgs(x, g, inverse_diagonal);
    for (int i = 0; i < n; ++i) CHECK(length(step[i] + 0.5 * g[i]) < 1e-14);
    lbfgs.clear();
  }
}

TEST_CASE("L-BFGS: a point without a gradient has no say")
{
  // The first point in a bowl that is twice as steep one way; the other leaps about, its gradient
  // unknown (0) in most iterations: it is known in no two in a row.
  const auto gradient_at = [](const Vec3d& p) { return Vec3d{p.x, 2 * p.y, 1.5 * p.z}; };
  Directions alone(5), both(5);
  Vec3d p{1, 2, 3}, leap{10, -20, 30};
  for (int k = 0; k < 8; ++k) {
    const Vec3d one = alone({p}, {gradient_at(p)}, {0.7})[0];
    const bool is_known = k % 3 == 1;
    const Vec3d two = both({p, leap}, {gradient_at(p), is_known ? leap : Vec3d{0, 0, 0}},
                           {0.7, is_known ? 0.5 : 0.0})[0];
    CHECK(length(one - two) <= 1e-14 * length(one));
    p += one;
    leap = Vec3d{leap.y, -leap.z, 1.5 * leap.x};
  }
  CHECK(length(p) < 1e-3); // it has learnt something
}

TEST_CASE("capacity: statistics against the mean")
{
  const auto of = [](const std::vector<double>& masses, double gamma,
                     const std::vector<unsigned char>& is_left_out = {}) {
    const int n = int(masses.size());
    const std::vector<double> ones(n, 1);
    const std::vector<Vec3d> offsets(n, {0, 0, 0});
    const std::vector<unsigned char> status(n, 0);
    Cell_summary summary, shared;
    Backend().reduce_twice(
        n, Summary_rule<double>{{masses.data(), ones.data(), ones.data(), status.data(), 0},
                                offsets.data(),
                                gamma,
                                is_left_out.empty() ? nullptr : is_left_out.data(),
                                n,
                                nullptr,
                                &summary,
                                &shared});
    return shared.capacity;
  };
  const Capacity_statistics s = of({1, 1, 1.5, 0.5}, 0.1);
  CHECK(s.inside_interval == Approx(0.5));
  CHECK(s.rms == Approx(std::sqrt(0.125)));
  CHECK(s.largest_deviation == Approx(0.5));
  CHECK(of({2, 2, 2}, 0).inside_interval == 1);
  CHECK(of({2, 2, 2}, 0).rms == 0);
  CHECK(of({0, 2}, 0.04).largest_deviation == Approx(1));
  CHECK(of({}, 0.04).inside_interval == 0);
  CHECK(of({0, 0}, 0.04).rms == 0);

  const Capacity_statistics most = of({1, 9, 1.2, 0, 0.8}, 0.1, {0, 1, 0, 1, 0});
  CHECK(most.left_out == 2);
  CHECK(most.mean == Approx(1));
  CHECK(most.least == 0.8);
  CHECK(most.inside_interval == Approx(1. / 3));
  CHECK(most.rms == Approx(std::sqrt(0.08 / 3)));
  CHECK(most.largest_deviation == Approx(0.2));
  CHECK(of({1, 2}, 0.1, {1, 1}).left_out == 2);
  CHECK(of({1, 2}, 0.1, {1, 1}).inside_interval == 0);
}

TEST_CASE("what a summary counts, and the residual of the usable cells")
{
  // Four cells, of which one is much too large and one is empty.
  const double area[] = {1, 9, 0, 1}, mass[] = {1, 9, 0, 1}, density[] = {2, 2, 2, 2};
  const unsigned char status[] = {0, 1, 2, 0};
  const Vec3d offset[] = {{3, 0, 4}, {1, 0, 0}, {0, 0, 0}, {0, 2, 0}};
  Cell_summary summary, shared;
  Backend().reduce_twice(
      4,
      Summary_rule<double>{
          {area, mass, density, status, 2}, offset, 0.1, nullptr, 4, nullptr, &summary, &shared});
  CHECK(shared.mass == 22);
  CHECK(shared.displacement == 25 + 1 + 4);
  CHECK(shared.residual == 25 + 4);
  CHECK(shared.counts[int(Cell_status::ok)] == 2);
  CHECK(shared.counts[int(Cell_status::guarded)] == 1);
  CHECK(shared.counts[int(Cell_status::empty)] == 1);
  CHECK(shared.counts[int(Cell_status::incomplete)] == 0);
  CHECK(summary.residual == shared.residual);
}
