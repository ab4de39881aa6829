// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_OPTIMIZATION_LAPLACIAN_ROWS_H
#define CGAL_POWER_RTF_OPTIMIZATION_LAPLACIAN_ROWS_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <cstddef>

namespace CGAL::PowerRTF {

/// The Laplacian of the cells (see `Newton_solver`) in rows that are padded to one
/// length: entry k of row i at [k * n + i].
template <class Real>
struct Laplacian_rows {
  static constexpr int capacity = 16; // of the edges of most cells there are 5 to 7
  int* size;
  int* column;
  Real* value; ///< -L_ij > 0
  double* diagonal;
  int n;
  double screening = 0; ///< of the diagonal, that has been added to it

  CGAL_POWER_RTF_HD std::size_t place(int k, int i) const { return std::size_t(k) * n + i; }
  CGAL_POWER_RTF_HD double inverse_diagonal(int i) const
  {
    return diagonal[i] > 0 ? 1 / diagonal[i] : 0;
  }

  /// Where among the first `length` entries of row i the one of column j is; else `length`.
  CGAL_POWER_RTF_HD int entry(int i, int j, int length) const
  {
    int k = 0;
    while (k < length && column[place(k, i)] != j) ++k;
    return k;
  }

  /// Entry i of the product with the vector that has entries `f(j)`.
  template <class F>
  CGAL_POWER_RTF_HD double product(int i, const F& f) const
  {
    double result = diagonal[i] * f(i);
    const int length = size[i];
    for (int k = 0; k < length; k += 4) { // four at a time: no load need wait for another
      double term[4];
      CGAL_POWER_RTF_UNROLL
      for (int l = 0; l < 4; ++l) {
        const bool is_there = k + l < length;
        const int j = is_there ? column[place(k + l, i)] : i;
        term[l] = is_there ? double(value[place(k + l, i)]) * f(j) : 0;
      }
      result -= (term[0] + term[1]) + (term[2] + term[3]);
    }
    return result;
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_LAPLACIAN_ROWS_H
