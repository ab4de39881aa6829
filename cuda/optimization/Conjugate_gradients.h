// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Conjugate gradients for the Laplacian of the cells, in one kernel.
#ifndef CGAL_POWER_RTF_CUDA_CONJUGATE_GRADIENTS_H
#define CGAL_POWER_RTF_CUDA_CONJUGATE_GRADIENTS_H

#include "../device/Totals.h"

#include <cmath>
#include <cstddef>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// The matrix rows, padded: entry k of row i at [k * n + i].
template <class Real>
struct Laplacian_rows {
  static constexpr int capacity = 24; // 16 edges of its own and some of others'
  int* size;
  int* column;
  Real* value; ///< -L_ij > 0
  double* diagonal;
  int n;
};

/// Conjugate gradients with the diagonal as preconditioner, by all threads of a team together.
/// Solves for x; r is the right side before and the residual after.
template <class Real>
struct Conjugate_gradients {
  Laplacian_rows<Real> a;
  double *x, *r, *z, *q, *p[2]; ///< z, q and p are scratch
  const double* limits;         ///< where all residuals are below these, it is enough
  double tolerance;             ///< or where their norm is, relative to the first
  int most;                     ///< iterations

  template <class Team>
  CGAL_POWER_RTF_HD void operator()(Team& team) const
  {
    const int n = a.n, first = team.first(), stride = team.stride();
    Totals<3, 0> sums; // r . z, r . r, residuals above their limits
    sums.clear();
    for (int i = first; i < n; i += stride) {
      const double inverse = inverse_diagonal(i);
      if (!(inverse > 0)) r[i] = 0; // nothing can be done for this cell
      x[i] = p[0][i] = 0;
      z[i] = r[i] * inverse;
      add_residual(i, sums);
    }
    team.join(sums);
    const double enough = tolerance * tolerance * sums.sum(1);
    double rz = sums.sum(0), beta = 0;
    for (int iteration = 0; iteration < most && sums.sum(1) > enough && sums.sum(2) > 0;
         ++iteration) {
      const double* const before = p[iteration % 2];
      double* const now = p[1 - iteration % 2];
      Totals<1, 0> curvature;
      curvature.clear();
      for (int i = first; i < n; i += stride) {
        const double own = z[i] + beta * before[i];
        double sum = a.diagonal[i] * own;
        const int size = a.size[i];
        for (int k = 0; k < size;
             k += 4) { // four at a time: their loads need not wait for each other
          double term[4];
          CGAL_POWER_RTF_UNROLL
          for (int l = 0; l < 4; ++l) {
            const bool is_there = k + l < size;
            const std::size_t place = std::size_t(k + l) * n + i;
            const int j = is_there ? a.column[place] : i;
            const double value = is_there ? double(a.value[place]) : 0;
            term[l] = value * (z[j] + beta * before[j]);
          }
          sum -= (term[0] + term[1]) + (term[2] + term[3]);
        }
        now[i] = own;
        q[i] = sum;
        curvature.add(0, own * sum);
      }
      team.join(curvature);
      if (!(curvature.sum(0) > 0)) break;
      const double alpha = rz / curvature.sum(0);
      sums.clear();
      for (int i = first; i < n; i += stride) {
        x[i] += alpha * now[i];
        r[i] -= alpha * q[i];
        z[i] = r[i] * inverse_diagonal(i);
        add_residual(i, sums);
      }
      team.join(sums);
      beta = sums.sum(0) / rz;
      rz = sums.sum(0);
    }
    if (sums.sum(1) < 1e300) return;
    for (int i = first; i < n; i += stride) x[i] = 0; // not a number: no direction
  }

  CGAL_POWER_RTF_HD void add_residual(int i, Totals<3, 0>& sums) const
  {
    sums.add(0, r[i] * z[i]);
    sums.add(1, r[i] * r[i]);
    sums.add(2, std::fabs(r[i]) > limits[i]);
  }
  CGAL_POWER_RTF_HD double inverse_diagonal(int i) const
  {
    return a.diagonal[i] > 0 ? 1 / a.diagonal[i] : 0;
  }
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_CONJUGATE_GRADIENTS_H
