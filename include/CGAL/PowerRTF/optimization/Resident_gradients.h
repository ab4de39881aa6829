// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conjugate gradients for the Laplacian of the cells by a thread for each row, which keeps all but
// one vector in registers.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_RESIDENT_GRADIENTS_H
#define CGAL_POWER_RTF_OPTIMIZATION_RESIDENT_GRADIENTS_H

#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/optimization/Laplacian_rows.h>

#include <cmath>
#include <cstddef>

namespace CGAL::PowerRTF {

/// Conjugate gradients in an order in which an iteration waits for the whole team only once.
/// (Ghysels, Vanroose, "Hiding global synchronization latency in the preconditioned conjugate
/// gradient algorithm", 2014.) The preconditioner is the diagonal, and a coarse one: a row for each
/// warp, whose cells are neighbors on a space-filling curve.
template <class Real>
struct Resident_gradients {
  Laplacian_rows<Real> a;
  double *x, *r;        ///< the solution; the right side
  double* exchanged[2]; ///< scratch: the vector that other rows read, in turn
  const double* limits; ///< where all residuals are below these, it is enough
  double tolerance;     ///< or where their norm is, relative to the first
  int most;             ///< iterations

  template <class Team>
  CGAL_POWER_RTF_HD void operator()(Team& team) const
  {
    const int i = team.first();
    const Row row(*this, i, team);
    double residual = row.inverse > 0 ? r[i] : 0; // else nothing can be done for this cell
    const double limit = row.inverse > 0 ? limits[i] : 0;
    double solution = 0, alpha = 0, before = 0;
    double u = row.preconditioned(residual, team); // the names are those of the source
    Totals<4, 0> sums; // r . u, w . u, r . r, residuals above their limits
    sums.clear();
    row.give(u, exchanged[0]);
    team.join(sums);
    double w = row.product(u, exchanged[0]), z = 0, q = 0, s = 0, p = 0, enough = 0;
    for (int iteration = 0; iteration < most; ++iteration) {
      double* const now = exchanged[1 - iteration % 2];
      const double m = row.preconditioned(w, team);
      row.give(m, now);
      sums.clear();
      sums.add(0, residual * u);
      sums.add(1, w * u);
      sums.add(2, residual * residual);
      sums.add(3, std::fabs(residual) > limit);
      team.join(sums);
      if (iteration == 0) enough = tolerance * tolerance * sums.sum(2);
      if (!(sums.sum(2) > enough && sums.sum(3) > 0)) break;
      const double beta = iteration == 0 ? 0 : sums.sum(0) / before;
      const double curvature = sums.sum(1) - (iteration == 0 ? 0 : beta * sums.sum(0) / alpha);
      if (!(curvature > 0)) break;
      alpha = sums.sum(0) / curvature;
      before = sums.sum(0);
      z = row.product(m, now) + beta * z;
      q = m + beta * q;
      s = w + beta * s;
      p = u + beta * p;
      solution += alpha * p;
      residual -= alpha * s;
      u -= alpha * q;
      w -= alpha * z;
    }
    if (i < a.n) x[i] = sums.sum(2) < 1e300 ? solution : 0; // not a number: no direction
  }

private:
  /// What a thread keeps of its row.
  struct Row {
    static constexpr int kept = 8;
    const Laplacian_rows<Real>& a;
    int i, size = 0, column[kept];
    Real value[kept];
    double diagonal = 0, inverse = 0, warp_inverse = 0;

    template <class Team>
    CGAL_POWER_RTF_HD Row(const Resident_gradients& solver, int row, Team& team)
        : a(solver.a), i(row)
    {
      if (i < a.n) {
        size = a.size[i];
        diagonal = a.diagonal[i];
        inverse = a.inverse_diagonal(i);
      }
      double outward = diagonal; // the entries that leave the warp
      CGAL_POWER_RTF_UNROLL
      for (int k = 0; k < kept; ++k) {
        const bool is_there = k < size;
        column[k] = is_there ? a.column[a.place(k, i)] : i < a.n ? i : 0;
        value[k] = is_there ? a.value[a.place(k, i)] : Real(0);
        if (is_there && column[k] / Team::warp == i / Team::warp) outward -= value[k];
      }
      for (int k = kept; k < size; ++k)
        if (a.column[a.place(k, i)] / Team::warp == i / Team::warp)
          outward -= a.value[a.place(k, i)];
      const double sum = team.sum_over_warp(outward), all = team.sum_over_warp(diagonal);
      warp_inverse = sum > 1e-6 * all ? 1 / sum : 0; // else its cells touch no others
    }

    CGAL_POWER_RTF_HD void give(double own, double* vector) const
    {
      if (i < a.n) vector[i] = own;
    }
    template <class Team>
    CGAL_POWER_RTF_HD double preconditioned(double v, Team& team) const
    {
      const double of_warp = team.sum_over_warp(v) * warp_inverse;
      return inverse > 0 ? v * inverse + of_warp : 0;
    }
    /// The row times `vector`, of which this thread has `own`.
    CGAL_POWER_RTF_HD double product(double own, const double* vector) const
    {
      double sum = 0;
      CGAL_POWER_RTF_UNROLL
      for (int k = 0; k < kept; ++k) sum += double(value[k]) * vector[column[k]];
      for (int k = kept; k < size; ++k)
        sum += double(a.value[a.place(k, i)]) * vector[a.column[a.place(k, i)]];
      return diagonal * own - sum;
    }
  };
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_RESIDENT_GRADIENTS_H
