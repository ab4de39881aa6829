// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Newton's direction for the weights that give every cell its share of the area: the semi-discrete
// optimal transport problem (Kitagawa, Merigot, Thibert 2019) on the restricted tangent faces.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_NEWTON_WEIGHTS_H
#define CGAL_POWER_RTF_OPTIMIZATION_NEWTON_WEIGHTS_H

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <numeric>
#include <vector>

namespace CGAL {
namespace PowerRTF {

/// The common edge of cells i and j: when w_i grows, the line moves by dw_i / (2 d_ij) and cell i
/// wins e_ij / (2 d_ij) of area.
struct Capacity_edge {
  static constexpr int fixed = -1;
  int i, j;     ///< j may be `fixed`: a site whose weight does not change
  double ratio; ///< e_ij / d_ij: length of the edge in cell i over the tangential distance
};

namespace internal {

/// The solution of a definite system of which the lower triangle is given; empty when it cannot be
/// solved. Exact up to 100 000 unknowns; a factor of more costs too much (n^1.5), and there the
/// residual falls to a thousandth: the direction is damped, and what a step leaves the next takes.
inline Eigen::VectorXd solve_definite(const Eigen::SparseMatrix<double>& matrix,
                                      const Eigen::VectorXd& right_side)
{
  using Matrix = Eigen::SparseMatrix<double>;
  constexpr Eigen::Index most_factored = 100000;
  const auto solution = [&](auto&& solver) -> Eigen::VectorXd {
    solver.compute(matrix);
    if (solver.info() != Eigen::Success) return {};
    Eigen::VectorXd x = solver.solve(right_side);
    if (solver.info() != Eigen::Success || !x.allFinite()) return {};
    return x;
  };
  if (matrix.rows() <= most_factored) return solution(Eigen::SimplicialLDLT<Matrix>());
  using Preconditioner =
      Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>;
  Eigen::ConjugateGradient<Matrix, Eigen::Lower, Preconditioner> gradients;
  gradients.setTolerance(1e-3);
  return solution(gradients);
}

} // namespace internal

/// Solves L dw = target - area, L_ij = -(e_ij/d_ij + e_ji/d_ji) / 4. On each connected component of
/// the cells the target areas are c / rho_i with c such that the component's area is kept, and the
/// mean of dw is 0 unless it has an edge with a fixed site. `edges` has one entry per side of each
/// cell. Empty when the system cannot be solved.
inline std::vector<double> newton_weights_direction(const std::vector<double>& areas,
                                                    const std::vector<double>& density,
                                                    const std::vector<Capacity_edge>& edges)
{
  const int n = static_cast<int>(areas.size());
  std::vector<int> component(n);
  std::iota(component.begin(), component.end(), 0);
  const auto root = [&](int i) {
    while (component[i] != i) i = component[i] = component[component[i]];
    return i;
  };
  for (const Capacity_edge& e : edges) {
    if (e.j == Capacity_edge::fixed) continue;
    const int a = root(e.i), b = root(e.j);
    component[std::max(a, b)] = std::min(a, b);
  }
  std::vector<double> area(n, 0), share(n, 0), mean(n, 0), count(n, 0);
  for (int i = 0; i < n; ++i) {
    area[root(i)] += areas[i];
    share[root(i)] += 1 / density[i];
    count[root(i)] += 1;
  }
  Eigen::VectorXd residual(n);
  for (int i = 0; i < n; ++i) residual[i] = area[root(i)] / share[root(i)] / density[i] - areas[i];

  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> diagonal(n, 0);
  std::vector<char> is_fixed(n, 0); // components with an edge with a fixed site
  entries.reserve(edges.size() + n);
  for (const Capacity_edge& e : edges) {
    if (e.j == Capacity_edge::fixed) { // the site has no cell that would tell of the edge again
      diagonal[e.i] += e.ratio / 2;
      is_fixed[root(e.i)] = 1;
      continue;
    }
    const double half = e.ratio / 4;
    entries.emplace_back(std::max(e.i, e.j), std::min(e.i, e.j), -half); // lower triangle
    diagonal[e.i] += half;
    diagonal[e.j] += half;
  }
  // L is singular (adding a constant changes nothing): a touch of the diagonal makes it definite.
  const double scale = std::accumulate(diagonal.begin(), diagonal.end(), 0.0) / n;
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, diagonal[i] + 1e-10 * scale);

  Eigen::SparseMatrix<double> laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  if (!(scale > 0)) return {};
  const Eigen::VectorXd solution = internal::solve_definite(laplacian, residual);
  if (solution.size() == 0) return {};

  for (int i = 0; i < n; ++i) mean[root(i)] += solution[i];
  std::vector<double> direction(n);
  for (int i = 0; i < n; ++i)
    direction[i] = solution[i] - (is_fixed[root(i)] ? 0 : mean[root(i)] / count[root(i)]);
  return direction;
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_OPTIMIZATION_NEWTON_WEIGHTS_H
