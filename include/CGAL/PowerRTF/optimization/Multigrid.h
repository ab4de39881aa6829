// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Multigrid for the Laplacian of the cells, as a preconditioner of conjugate gradients: the number
// of iterations hardly grows with n (with the diagonal alone it grows with sqrt(n)). Four cells in
// a row make one of the next level, as they are numbered along a space-filling curve. (Braess,
// "Toward algebraic multigrid for elliptic problems of second order", 1995.)
#ifndef CGAL_POWER_RTF_OPTIMIZATION_MULTIGRID_H
#define CGAL_POWER_RTF_OPTIMIZATION_MULTIGRID_H

#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/optimization/Laplacian_rows.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

constexpr int multigrid_aggregate = 4; // cells
constexpr double multigrid_damping = 0.85;
// What is constant on an aggregate has too much energy: it is changed by more than would be best.
constexpr double multigrid_overcorrection = 1.5;

/// The end of the cells of aggregate `i` among n.
CGAL_POWER_RTF_HD inline int end_of_aggregate(int i, int n)
{
  const int end = (i + 1) * multigrid_aggregate;
  return end < n ? end : n;
}

/// Writes the rows of the aggregates. Edges for which a row has no room are left out.
template <class Real, class Backend>
void aggregate_rows(Backend& backend, const Laplacian_rows<Real>& fine,
                    const Laplacian_rows<Real>& rows)
{
  constexpr int capacity = Laplacian_rows<Real>::capacity;
  const int n = rows.n;
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    int size = 0;
    double tie = 0; // of the cells with sites that have none
    for (int f = i * multigrid_aggregate; f < end_of_aggregate(i, fine.n); ++f) {
      double rest = fine.diagonal[f];
      for (int k = 0; k < fine.size[f]; ++k) {
        const int j = fine.column[fine.place(k, f)] / multigrid_aggregate;
        const Real value = fine.value[fine.place(k, f)];
        rest -= value;
        if (j == i) continue;
        const int at = rows.entry(i, j, size);
        if (at == capacity) continue;
        if (at == size) {
          rows.column[rows.place(at, i)] = j;
          rows.value[rows.place(at, i)] = 0;
          ++size;
        }
        rows.value[rows.place(at, i)] += value;
      }
      if (rest > 1e-6 * fine.diagonal[f]) tie += rest; // else it is rounding
    }
    rows.size[i] = size;
    rows.diagonal[i] = tie;
  });
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    double sum = rows.diagonal[i];
    for (int k = 0; k < rows.size[i]; ++k) {
      Real& value = rows.value[rows.place(k, i)];
      const int j = rows.column[rows.place(k, i)];
      if (rows.size[j] == capacity && rows.entry(j, i, capacity) == capacity)
        value = 0; // the other row had no room
      sum += value;
    }
    rows.diagonal[i] = sum;
  });
}

/// The first step of Jacobi's method for the right side r.
template <class Real, class Backend>
void smooth_first(Backend& backend, const Laplacian_rows<Real>& a, const double* r, Real* smoothed)
{
  backend.for_each(a.n, [=] CGAL_POWER_RTF_HD(int i) {
    smoothed[i] = Real(multigrid_damping * a.inverse_diagonal(i) * r[i]);
  });
}

/// Adds up over aggregates what the first step `before` has left of r, and makes the first step of
/// their rows b.
template <class Real, class Backend>
void restrict_residual(Backend& backend, const Laplacian_rows<Real>& a, const Real* before,
                       const double* r, const Laplacian_rows<Real>& b, double* residual,
                       Real* smoothed)
{
  backend.for_each(b.n, [=] CGAL_POWER_RTF_HD(int i) {
    const auto entry = [=](int j) { return double(before[j]); };
    double sum = 0;
    for (int f = i * multigrid_aggregate; f < end_of_aggregate(i, a.n); ++f)
      sum += r[f] - a.product(f, entry);
    residual[i] = sum;
    smoothed[i] = Real(multigrid_damping * b.inverse_diagonal(i) * sum);
  });
}

/// Adds the correction of the aggregates (null: there are none), and makes another step.
template <class Real, class Backend>
void correct(Backend& backend, const Laplacian_rows<Real>& a, const double* r, const Real* smoothed,
             const Real* correction, Real* result)
{
  backend.for_each(a.n, [=] CGAL_POWER_RTF_HD(int i) {
    const auto entry = [=](int j) {
      const double change = correction ? double(correction[j / multigrid_aggregate]) : 0;
      return smoothed[j] + multigrid_overcorrection * change;
    };
    const double inverse = a.inverse_diagonal(i);
    result[i] = inverse > 0
                    ? Real(entry(i) + multigrid_damping * inverse * (r[i] - a.product(i, entry)))
                    : Real(0);
  });
}

} // namespace internal

/// \tparam Backend owns the memory and runs the loops: `Host_backend`, or a device's.
template <class Real, class Backend>
class Multigrid {
public:
  explicit Multigrid(Backend& backend) : m_backend(backend) {}

  /// What the levels of a matrix with n rows take.
  static std::size_t bytes(int n)
  {
    std::size_t sum = internal::bytes_of_listed<Level>(n, true);
    while (n > 1) {
      n = aggregates(n);
      sum += internal::bytes_of_listed<Level>(n, false);
    }
    return sum;
  }

  /// Takes the matrix, which must live as long as `apply()` is called, and makes its levels: up to
  /// aggregates over which a change fades, where the rows are screened. Larger ones would do harm,
  /// as what is constant on them has no more energy than it should.
  void set_rows(const Laplacian_rows<Real>& rows)
  {
    m_size = 0;
    add_level(rows.n).rows = rows;
    constexpr double most = 0.5;
    double cells = internal::multigrid_aggregate; // of the next level
    for (; last().rows.n > 1 && cells * rows.screening < most;
         cells *= internal::multigrid_aggregate)
      coarsen(last().rows);
  }

  /// Approximates the solution for the right side r by one V-cycle, a linear operator that is
  /// symmetric and positive definite where the diagonal is positive. The result is valid until the
  /// next call.
  const Real* apply(const double* r)
  {
    const auto right_side = [&](std::size_t l) {
      return l == 0 ? r : m_levels[l]->residual.data();
    };
    internal::smooth_first(m_backend, m_levels[0]->rows, r, m_levels[0]->smoothed.data());
    for (std::size_t l = 1; l < m_size; ++l) {
      Level &fine = *m_levels[l - 1], &coarse = *m_levels[l];
      internal::restrict_residual(m_backend, fine.rows, fine.smoothed.data(), right_side(l - 1),
                                  coarse.rows, coarse.residual.data(), coarse.smoothed.data());
    }
    for (std::size_t l = m_size; l-- > 0;) {
      Level& level = *m_levels[l];
      const Real* const correction = l + 1 < m_size ? m_levels[l + 1]->result.data() : nullptr;
      internal::correct(m_backend, level.rows, right_side(l), level.smoothed.data(), correction,
                        level.result.data());
    }
    return m_levels[0]->result.data();
  }

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;
  struct Level {
    Laplacian_rows<Real> rows;
    Buffer<int> size, column; // of the rows; not of the first level
    Buffer<Real> value;
    Buffer<double> diagonal;
    Buffer<double> residual;       // the right side; not of the first level
    Buffer<Real> smoothed, result; // after a first step of Jacobi's method; in the end

    template <class F>
    static void for_each_array(F&& f, std::size_t n, bool is_first)
    {
      f(&Level::smoothed, n);
      f(&Level::result, n);
      if (is_first) return;
      f(&Level::size, n);
      f(&Level::column, n * Laplacian_rows<Real>::capacity);
      f(&Level::value, n * Laplacian_rows<Real>::capacity);
      f(&Level::diagonal, n);
      f(&Level::residual, n);
    }
  };

  static int aggregates(int n)
  {
    return (n + internal::multigrid_aggregate - 1) / internal::multigrid_aggregate;
  }

  Level& last() { return *m_levels[m_size - 1]; }
  Level& add_level(int n)
  {
    if (m_size == m_levels.size()) m_levels.push_back(std::make_unique<Level>());
    Level& level = *m_levels[m_size];
    internal::allocate_listed(m_backend, level, n, m_size == 0);
    ++m_size;
    return level;
  }

  /// Adds the level of the aggregates.
  void coarsen(const Laplacian_rows<Real>& fine)
  {
    const int n = aggregates(fine.n);
    Level& level = add_level(n);
    level.rows = {level.size.data(), level.column.data(), level.value.data(), level.diagonal.data(),
                  n};
    internal::aggregate_rows(m_backend, fine, level.rows);
  }

  Backend& m_backend;
  std::vector<std::unique_ptr<Level>> m_levels; // some may be left from a larger matrix
  std::size_t m_size = 0;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_MULTIGRID_H
