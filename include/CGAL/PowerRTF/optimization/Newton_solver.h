// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Newton's direction for the weights that give every cell its share of the area: the semi-discrete
// optimal transport problem (Kitagawa, Merigot, Thibert 2019) on the restricted tangent faces. The
// direction is damped and its step judged afterwards, so the residual need only fall to a small
// part.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_NEWTON_SOLVER_H
#define CGAL_POWER_RTF_OPTIMIZATION_NEWTON_SOLVER_H

#include <CGAL/PowerRTF/cells/Cell_arrays.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/optimization/Multigrid_gradients.h>
#include <CGAL/PowerRTF/optimization/Resident_gradients.h>
#include <CGAL/PowerRTF/optimization/component_trees.h>
#include <CGAL/PowerRTF/optimization/newton_step_rules.h>

#include <cmath>
#include <cstddef>

namespace CGAL::PowerRTF {

/// The areas of the cells that have to become equal, and their shares of them.
template <class Real>
struct Counted_area {
  const Real* area;
  const unsigned char* keeps_area;
  CGAL_POWER_RTF_HD double operator()(int i) const { return keeps_area[i] ? 0 : double(area[i]); }
};
template <class Real>
struct Counted_share {
  const Real* density;
  const unsigned char* keeps_area;
  CGAL_POWER_RTF_HD double operator()(int i) const
  {
    return keeps_area[i] ? 0 : 1 / double(density[i]);
  }
};

/// Residuals and limits of the system whose unknowns are the changes of the weights.
template <class Real>
struct Area_targets {
  const Real *area, *density;
  const unsigned char* keeps_area;
  double slack; ///< part of its share by which an area's target may differ from it
  double part;  ///< of its target, that an area may be off
  double *residual, *limit;

  CGAL_POWER_RTF_HD void set(int i, double ratio) const
  {
    const double own = area[i], share = keeps_area[i] ? own : ratio / density[i];
    const double least = share * (1 - slack), most = share * (1 + slack);
    const double target = own < least ? least : own > most ? most : own;
    residual[i] = target - own;
    limit[i] = part * target;
  }
};

/// Targets in proportion to 1 / density on each component. `scalars`: memory for two numbers;
/// `sums`: for two times n; both null: there is one component.
template <class Real, class Backend>
void set_area_targets(Backend& backend, int n, const Area_targets<Real>& targets, const int* label,
                      double* scalars, long long* areas, long long* shares)
{
  const Counted_area<Real> area_of{targets.area, targets.keeps_area};
  const Counted_share<Real> share_of{targets.density, targets.keeps_area};
  backend.template reduce<2, 0>(
      n,
      [=] CGAL_POWER_RTF_HD(int i, Totals<2, 0>& t) {
        t.add(0, area_of(i));
        t.add(1, share_of(i));
      },
      [=] CGAL_POWER_RTF_HD(const Totals<2, 0>& t) {
        scalars[0] = t.sum(0);
        scalars[1] = t.sum(1);
      });
  if (!areas) {
    backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) { targets.set(i, scalars[0] / scalars[1]); });
    return;
  }
  sum_over_components(backend, n, label, area_of, scalars, areas);
  sum_over_components(backend, n, label, share_of, scalars + 1, shares);
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    const double ratio = double(areas[label[i]]) / double(shares[label[i]]);
    targets.set(i, ratio * scalars[0] / scalars[1]);
  });
}

/// Subtracts the mean of x on each component that is not anchored.
template <class Backend>
void subtract_component_means(Backend& backend, int n, double* x, const Component_view& components,
                              double* scalars, long long* sums, long long* counts)
{
  backend.template reduce<0, 1>(
      n, [=] CGAL_POWER_RTF_HD(int i, Totals<0, 1>& t) { t.raise(0, std::fabs(x[i])); },
      [=] CGAL_POWER_RTF_HD(const Totals<0, 1>& t) {
        scalars[0] = t.maximum(0) > 0 ? n * t.maximum(0) : 1;
        scalars[1] = n;
      });
  const int *const label = components.label, *const is_anchored = components.is_anchored;
  sum_over_components(
      backend, n, label, [=] CGAL_POWER_RTF_HD(int i) { return x[i]; }, scalars, sums);
  sum_over_components(
      backend, n, label, [=] CGAL_POWER_RTF_HD(int) { return 1.; }, scalars + 1, counts);
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    if (is_anchored[label[i]]) return;
    x[i] -= double(sums[label[i]]) / double(counts[label[i]]) * (scalars[0] / scalars[1]);
  });
}

/// Solves (L + s diag L) dw = target - area for the cells' weights, L_ij = -(e_ij/d_ij + e_ji/d_ji)
/// / 4 with e_ij the length of the edge in cell i and d_ij the tangential distance of site j: when
/// w_i grows, the line moves by dw_i / (2 d_ij). On each connected component of the cells the
/// shares are c / rho_i with c such that the component's area is kept; a target is its share, or
/// the nearest area within the slack around it. See newton_step_rules.h.
template <class Real, class Backend>
class Newton_solver {
public:
  /// A direction is near enough when it would bring all areas within this part of the capacity
  /// interval around their targets, or leave this part of the residual's norm: what one step
  /// leaves, the next one takes. On the host, where the cells take longer than the system, only the
  /// norm counts, so that the weights hardly leap when the input changes a little.
  static constexpr double part_of_interval = Backend::works_by_warps ? 0.5 : 0;
  static constexpr double tolerance = 0.03;

  explicit Newton_solver(Backend& backend) : m_backend(backend), m_gradients(backend)
  {
    m_scalars.allocate(backend, 4);
  }

  /// Of n cells, without those of the gradients; see listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t n)
  {
    using S = Newton_solver;
    constexpr std::size_t row = Laplacian_rows<Row>::capacity;
    for (auto array : {&S::m_row_size, &S::m_length, &S::m_label, &S::m_is_anchored}) f(array, n);
    f(&S::m_column, n * row);
    f(&S::m_value, n * row);
    f(&S::m_is_tied, n);
    for (auto array : {&S::m_diagonal, &S::m_x, &S::m_r, &S::m_limits}) f(array, n);
    f(&S::m_exchanged, n <= Backend::max_resident ? 2 * n : 0);
  }
  /// What n cells take, all of them in one component.
  static std::size_t bytes(int n)
  {
    return internal::bytes_of_listed<Newton_solver>(n) +
           (n <= Backend::max_resident ? 0 : Multigrid_gradients<Row, Backend>::bytes(n));
  }

  /// Where `build()` shall write the edges of n cells.
  void add_outputs(int n, Cell_outputs<Real>& out)
  {
    internal::allocate_listed(m_backend, *this, n);
    out.edge_count = m_row_size.data();
    out.edge_neighbor = m_column.data();
    out.edge_ratio = m_value.data();
    out.edge_capacity = Laplacian_rows<Row>::capacity;
  }

  /// Solves for the direction from areas and densities, after the edges have been written, which it
  /// uses up; 0 when the system cannot be solved. Cells with `keeps_area[i]` have their own area as
  /// the target. `find_components`: the cells may hang together in another way than last time.
  void solve(int n, const Real* area, const Real* density, const unsigned char* keeps_area,
             double capacity_tolerance, const Newton_goal& goal, bool find_components);

  /// n weights' changes; their mean on each component is 0 if nothing fixes it.
  const double* direction() const { return m_x.data(); }

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;
  using Row = float; ///< of the matrix: iterations wait for memory

  void iterate();
  Component_view components() { return {m_label.data(), m_is_anchored.data()}; }
  Laplacian_rows<Row> rows()
  {
    return {m_row_size.data(), m_column.data(), m_value.data(), m_diagonal.data(), m_n,
            m_screening};
  }

  Backend& m_backend;
  int m_n = 0;
  double m_screening = 0;
  bool m_is_connected = false;
  Buffer<int> m_row_size, m_column; // of the cells' edges before
  Buffer<Row> m_value;
  Buffer<int> m_length, m_label, m_is_anchored;
  Buffer<unsigned char> m_is_tied;
  Buffer<double> m_diagonal, m_x, m_r, m_limits, m_scalars;
  Buffer<double> m_exchanged; // see `Resident_gradients`: one after the other
  Multigrid_gradients<Row, Backend> m_gradients;
  Buffer<long long> m_sums[2];
};

template <class Real, class Backend>
void Newton_solver<Real, Backend>::solve(int n, const Real* area, const Real* density,
                                         const unsigned char* keeps_area, double capacity_tolerance,
                                         const Newton_goal& goal, bool find_components)
{
  m_n = n;
  m_screening = goal.screening * capacity_tolerance;
  assemble_laplacian(m_backend, rows(), m_length.data(), m_is_tied.data());
  if (find_components)
    m_is_connected = PowerRTF::find_components(m_backend, rows(), m_is_tied.data(), components(),
                                               m_scalars.data()) == 1;
  if (!m_is_connected)
    for (auto& s : m_sums) s.allocate(m_backend, n);
  long long* const sums[] = {m_is_connected ? nullptr : m_sums[0].data(),
                             m_is_connected ? nullptr : m_sums[1].data()};
  set_area_targets(m_backend, n,
                   Area_targets<Real>{area, density, keeps_area, goal.slack * capacity_tolerance,
                                      part_of_interval * capacity_tolerance, m_r.data(),
                                      m_limits.data()},
                   m_label.data(), m_scalars.data(), sums[0], sums[1]);
  iterate();
  if (m_is_connected) return; // the caller subtracts the mean of all weights, unless it is anchored
  subtract_component_means(m_backend, n, m_x.data(), components(), m_scalars.data(), sums[0],
                           sums[1]);
}

template <class Real, class Backend>
void Newton_solver<Real, Backend>::iterate()
{
  if (m_n <= Backend::max_resident) {
    const Resident_gradients<Row> resident{rows(),
                                           m_x.data(),
                                           m_r.data(),
                                           {m_exchanged.data(), m_exchanged.data() + m_n},
                                           m_limits.data(),
                                           tolerance,
                                           200 + 4 * int(std::sqrt(double(m_n)))};
    if (m_backend.run_resident_team(m_n, resident)) return;
  }
  m_gradients.solve(rows(), m_x.data(), m_r.data(), m_limits.data(), tolerance);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_NEWTON_SOLVER_H
