// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Multigrid for the Laplacian of the cells, as a preconditioner of conjugate gradients: the number
// of iterations hardly grows with n (with the diagonal alone it grows with sqrt(n)). Four cells in
// a row make one of the next level, as they are numbered along a space-filling curve. (Braess,
// "Towards algebraic multigrid for elliptic problems of second order", 1995.)
#ifndef CGAL_POWER_RTF_OPTIMIZATION_MULTIGRID_H
#define CGAL_POWER_RTF_OPTIMIZATION_MULTIGRID_H

#include <CGAL/PowerRTF/optimization/Laplacian_rows.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL {
namespace PowerRTF {

/// \tparam Backend owns the memory and runs the loops: `Host_loops`, or a device's.
template <class Real, class Backend>
class Multigrid {
public:
  explicit Multigrid(Backend& backend) : m_backend(backend) {}

  /// Takes the matrix, which must live as long as `apply()` is called, and makes its levels.
  void set_rows(const Laplacian_rows<Real>& rows)
  {
    m_size = 0;
    add_level().rows = rows;
    while (last().rows.n > 1) coarsen(last().rows);
    for (std::size_t l = 0; l < m_size; ++l) {
      m_levels[l]->smoothed.allocate(m_backend, m_levels[l]->rows.n);
      m_levels[l]->result.allocate(m_backend, m_levels[l]->rows.n);
    }
  }

  /// Approximates the solution for the right side r by one V-cycle, a linear operator that is
  /// symmetric and positive definite where the diagonal is positive. The result is valid until the
  /// next call.
  const Real* apply(const double* r)
  {
    smooth(*m_levels[0], r);
    for (std::size_t l = 1; l < m_size; ++l)
      restrict_residual(*m_levels[l - 1], l == 1 ? r : m_levels[l - 1]->residual.data(),
                        *m_levels[l]);
    for (std::size_t l = m_size; l-- > 0;)
      correct(*m_levels[l], l == 0 ? r : m_levels[l]->residual.data(),
              l + 1 < m_size ? m_levels[l + 1]->result.data() : nullptr);
    return m_levels[0]->result.data();
  }

  // Public for the device compiler alone.
  struct Level;
  void coarsen(Laplacian_rows<Real> fine);
  void smooth(Level& level, const double* r);
  void restrict_residual(Level& fine, const double* r, Level& coarse);
  void correct(Level& level, const double* r, const Real* coarse_result);

  template <class T>
  using Buffer = typename Backend::template Buffer<T>;
  struct Level {
    Laplacian_rows<Real> rows;
    Buffer<int> size, column; // of the rows; not of the first level
    Buffer<Real> value;
    Buffer<double> diagonal;
    Buffer<double> residual;       // the right side; not of the first level
    Buffer<Real> smoothed, result; // after a first step of Jacobi's method; in the end
  };

private:
  static constexpr int aggregate = 4;
  static constexpr double damping = 0.85;
  // What is constant on an aggregate has too much energy: it is changed by more than would be best.
  static constexpr double overcorrection = 1.5;

  Level& last() { return *m_levels[m_size - 1]; }
  Level& add_level()
  {
    if (m_size == m_levels.size()) m_levels.push_back(std::make_unique<Level>());
    return *m_levels[m_size++];
  }

  Backend& m_backend;
  std::vector<std::unique_ptr<Level>> m_levels; // some may be left from a larger matrix
  std::size_t m_size = 0;
};

/// Adds the level of the aggregates. Edges for which a row has no room are left out.
template <class Real, class Backend>
void Multigrid<Real, Backend>::coarsen(Laplacian_rows<Real> fine)
{
  constexpr int capacity = Laplacian_rows<Real>::capacity;
  const int n = (fine.n + aggregate - 1) / aggregate;
  Level& level = add_level();
  level.size.allocate(m_backend, n);
  level.column.allocate(m_backend, std::size_t(n) * capacity);
  level.value.allocate(m_backend, std::size_t(n) * capacity);
  level.diagonal.allocate(m_backend, n);
  level.residual.allocate(m_backend, n);
  level.rows = {level.size.data(), level.column.data(), level.value.data(), level.diagonal.data(),
                n};
  const Laplacian_rows<Real> rows = level.rows;
  m_backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    int size = 0;
    double tie = 0; // of the cells with sites that have none
    const int end = (i + 1) * aggregate < fine.n ? (i + 1) * aggregate : fine.n;
    for (int f = i * aggregate; f < end; ++f) {
      double rest = fine.diagonal[f];
      for (int k = 0; k < fine.size[f]; ++k) {
        const int j = fine.column[fine.place(k, f)] / aggregate;
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
  m_backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
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

template <class Real, class Backend>
void Multigrid<Real, Backend>::smooth(Level& level, const double* r)
{
  const Laplacian_rows<Real> a = level.rows;
  Real* const smoothed = level.smoothed.data();
  m_backend.for_each(a.n, [=] CGAL_POWER_RTF_HD(int i) {
    smoothed[i] = Real(damping * a.inverse_diagonal(i) * r[i]);
  });
}

/// Adds up what the first step has left of r, and makes the first step there.
template <class Real, class Backend>
void Multigrid<Real, Backend>::restrict_residual(Level& fine, const double* r, Level& coarse)
{
  const Laplacian_rows<Real> a = fine.rows, b = coarse.rows;
  const Real* const before = fine.smoothed.data();
  double* const residual = coarse.residual.data();
  Real* const smoothed = coarse.smoothed.data();
  m_backend.for_each(b.n, [=] CGAL_POWER_RTF_HD(int i) {
    const auto entry = [=](int j) { return double(before[j]); };
    double sum = 0;
    const int end = (i + 1) * aggregate < a.n ? (i + 1) * aggregate : a.n;
    for (int f = i * aggregate; f < end; ++f) sum += r[f] - a.product(f, entry);
    residual[i] = sum;
    smoothed[i] = Real(damping * b.inverse_diagonal(i) * sum);
  });
}

/// Adds the correction of the next level, and makes another step.
template <class Real, class Backend>
void Multigrid<Real, Backend>::correct(Level& level, const double* r, const Real* coarse_result)
{
  const Laplacian_rows<Real> a = level.rows;
  const Real* const smoothed = level.smoothed.data();
  Real* const result = level.result.data();
  m_backend.for_each(a.n, [=] CGAL_POWER_RTF_HD(int i) {
    const auto entry = [=](int j) {
      const double correction = coarse_result ? double(coarse_result[j / aggregate]) : 0;
      return smoothed[j] + overcorrection * correction;
    };
    const double inverse = a.inverse_diagonal(i);
    result[i] =
        inverse > 0 ? Real(entry(i) + damping * inverse * (r[i] - a.product(i, entry))) : Real(0);
  });
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_OPTIMIZATION_MULTIGRID_H
