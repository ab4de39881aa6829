// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Newton's direction for the weights that give every cell its share of the area: the semi-discrete
// optimal transport problem (Kitagawa, Merigot, Thibert 2019) on the restricted tangent faces.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_NEWTON_WEIGHTS_H
#define CGAL_POWER_RTF_OPTIMIZATION_NEWTON_WEIGHTS_H

#include <CGAL/PowerRTF/internal/host_loops.h>
#include <CGAL/PowerRTF/optimization/Multigrid_gradients.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
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

/// The solution of L x = r by a factor of L; empty when there is none.
inline std::vector<double> solve_by_factor(const std::vector<double>& diagonal,
                                           const std::vector<Capacity_edge>& edges,
                                           const std::vector<double>& r)
{
  using Matrix = Eigen::SparseMatrix<double>;
  const int n = static_cast<int>(r.size());
  std::vector<Eigen::Triplet<double>> entries; // of the lower triangle
  entries.reserve(edges.size() + n);
  for (const Capacity_edge& e : edges)
    if (e.j != Capacity_edge::fixed)
      entries.emplace_back(std::max(e.i, e.j), std::min(e.i, e.j), -e.ratio / 4);
  // L is singular (adding a constant changes nothing): a touch of the diagonal makes it definite.
  const double scale = std::accumulate(diagonal.begin(), diagonal.end(), 0.0) / n;
  for (int i = 0; i < n; ++i) entries.emplace_back(i, i, diagonal[i] + 1e-10 * scale);
  Matrix laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  if (!(scale > 0)) return {};
  Eigen::SimplicialLDLT<Matrix> factor(laplacian);
  if (factor.info() != Eigen::Success) return {};
  const Eigen::VectorXd x = factor.solve(Eigen::Map<const Eigen::VectorXd>(r.data(), n));
  if (factor.info() != Eigen::Success || !x.allFinite()) return {};
  return {x.data(), x.data() + n};
}

/// The same by iterations, until the residual has fallen to a thousandth. Edges of the few cells that
/// have more than there is room for are left out.
template <class ConcurrencyTag>
std::vector<double> solve_by_multigrid(std::vector<double> diagonal,
                                       const std::vector<Capacity_edge>& edges,
                                       std::vector<double> r)
{
  using Rows = Laplacian_rows<double>;
  const int n = static_cast<int>(r.size());
  std::vector<int> size(n, 0), column(std::size_t(n) * Rows::capacity);
  std::vector<double> value(column.size()), x(n);
  const Rows rows{size.data(), column.data(), value.data(), diagonal.data(), n};
  const auto add = [&](int i, int j, int k, double ratio) {
    if (k == size[i]) {
      rows.column[rows.place(k, i)] = j;
      rows.value[rows.place(k, i)] = 0;
      ++size[i];
    }
    rows.value[rows.place(k, i)] += ratio;
  };
  for (const Capacity_edge& e : edges) {
    if (e.j == Capacity_edge::fixed) continue;
    const int k = rows.entry(e.i, e.j, size[e.i]), l = rows.entry(e.j, e.i, size[e.j]);
    if (k == Rows::capacity || l == Rows::capacity) {
      for (const int i : {e.i, e.j}) diagonal[i] -= e.ratio / 4;
      continue;
    }
    add(e.i, e.j, k, e.ratio / 4);
    add(e.j, e.i, l, e.ratio / 4);
  }
  Host_loops<ConcurrencyTag> loops;
  Multigrid_gradients<double, Host_loops<ConcurrencyTag>> gradients(loops);
  if (gradients.solve(rows, x.data(), r.data(), nullptr, 1e-3) < 0) return {};
  return x;
}

} // namespace internal

/// Solves L dw = target - area, L_ij = -(e_ij/d_ij + e_ji/d_ji) / 4. On each connected component of
/// the cells the target areas are c / rho_i with c such that the component's area is kept, and the
/// mean of dw is 0 unless it has an edge with a fixed site. Cells with `keeps_area[i]` have their
/// own area as the target. `edges` has one entry per side of each cell. Empty when the system cannot be solved. Exact up to 100 000 cells; a factor of more costs
/// too much (n^1.5), and there a direction that is near enough does: it is damped, and what a step
/// leaves the next takes. Cells with close numbers should be close to each other.
template <class ConcurrencyTag = Sequential_tag>
std::vector<double> newton_weights_direction(const std::vector<double>& areas,
                                             const std::vector<double>& density,
                                             const std::vector<Capacity_edge>& edges,
                                             const std::vector<char>& keeps_area)
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
    count[root(i)] += 1;
    if (keeps_area[i]) continue;
    area[root(i)] += areas[i];
    share[root(i)] += 1 / density[i];
  }
  std::vector<double> residual(n, 0);
  for (int i = 0; i < n; ++i)
    if (!keeps_area[i]) residual[i] = area[root(i)] / share[root(i)] / density[i] - areas[i];

  std::vector<double> diagonal(n, 0);
  std::vector<char> is_fixed(n, 0); // components with an edge with a fixed site
  for (const Capacity_edge& e : edges) {
    if (e.j == Capacity_edge::fixed) { // the site has no cell that would tell of the edge again
      diagonal[e.i] += e.ratio / 2;
      is_fixed[root(e.i)] = 1;
      continue;
    }
    diagonal[e.i] += e.ratio / 4;
    diagonal[e.j] += e.ratio / 4;
  }
  constexpr int most_factored = 100000;
  const std::vector<double> solution =
      n <= most_factored ? internal::solve_by_factor(diagonal, edges, residual)
                         : internal::solve_by_multigrid<ConcurrencyTag>(diagonal, edges, residual);
  if (solution.empty()) return {};

  for (int i = 0; i < n; ++i) mean[root(i)] += solution[i];
  std::vector<double> direction(n);
  for (int i = 0; i < n; ++i)
    direction[i] = solution[i] - (is_fixed[root(i)] ? 0 : mean[root(i)] / count[root(i)]);
  return direction;
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_OPTIMIZATION_NEWTON_WEIGHTS_H
