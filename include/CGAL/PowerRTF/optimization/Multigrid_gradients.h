// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_OPTIMIZATION_MULTIGRID_GRADIENTS_H
#define CGAL_POWER_RTF_OPTIMIZATION_MULTIGRID_GRADIENTS_H

#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/optimization/Multigrid.h>

#include <cmath>

namespace CGAL::PowerRTF {

namespace internal {

struct Gradients_state { // where the loops run
  double rz, alpha, beta, curvature, squares, above;
};

/// x and the first direction become 0.
template <class Real, class Backend>
void begin_gradients(Backend& backend, const Laplacian_rows<Real>& a, double* x, double* r,
                     const double* limits, double* direction, Gradients_state* state)
{
  backend.template reduce<2, 0>(
      a.n,
      [=] CGAL_POWER_RTF_HD(int i, Totals<2, 0>& t) {
        if (!(a.diagonal[i] > 0)) r[i] = 0; // nothing can be done for this cell
        x[i] = direction[i] = 0;
        t.add(0, r[i] * r[i]);
        t.add(1, !limits || std::fabs(r[i]) > limits[i]);
      },
      [=] CGAL_POWER_RTF_HD(const Totals<2, 0>& t) { *state = {0, 0, 0, 0, t.sum(0), t.sum(1)}; });
}

/// The next direction from the preconditioned residual z, and its product with the matrix.
template <class Real, class Backend>
void find_direction(Backend& backend, const Laplacian_rows<Real>& a, const double* r, const Real* z,
                    bool is_first, const double* before, double* direction, double* product,
                    Gradients_state* state)
{
  backend.template reduce<1, 0>(
      a.n, [=] CGAL_POWER_RTF_HD(int i, Totals<1, 0>& t) { t.add(0, r[i] * z[i]); },
      [=] CGAL_POWER_RTF_HD(const Totals<1, 0>& t) {
        state->beta = is_first ? 0 : t.sum(0) / state->rz;
        state->rz = t.sum(0);
      });
  backend.template reduce<1, 0>(
      a.n,
      [=] CGAL_POWER_RTF_HD(int i, Totals<1, 0>& t) {
        const double beta = state->beta;
        const auto entry = [=](int j) { return z[j] + beta * before[j]; };
        const double own = entry(i);
        direction[i] = own;
        product[i] = a.product(i, entry);
        t.add(0, own * product[i]);
      },
      [=] CGAL_POWER_RTF_HD(const Totals<1, 0>& t) {
        state->curvature = t.sum(0);
        state->alpha = t.sum(0) > 0 ? state->rz / t.sum(0) : 0;
      });
}

template <class Backend>
void step_along(Backend& backend, int n, const double* direction, const double* product, double* x,
                double* r, const double* limits, Gradients_state* state)
{
  backend.template reduce<2, 0>(
      n,
      [=] CGAL_POWER_RTF_HD(int i, Totals<2, 0>& t) {
        x[i] += state->alpha * direction[i];
        r[i] -= state->alpha * product[i];
        t.add(0, r[i] * r[i]);
        t.add(1, !limits || std::fabs(r[i]) > limits[i]);
      },
      [=] CGAL_POWER_RTF_HD(const Totals<2, 0>& t) {
        state->squares = t.sum(0);
        state->above = t.sum(1);
      });
}

} // namespace internal

/// Conjugate gradients for the Laplacian of the cells, preconditioned by `Multigrid`.
template <class Real, class Backend>
class Multigrid_gradients {
public:
  explicit Multigrid_gradients(Backend& backend) : m_backend(backend), m_multigrid(backend)
  {
    m_state.allocate(backend, 1);
  }

  /// Of n unknowns, without the preconditioner's; see listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t n)
  {
    f(&Multigrid_gradients::m_directions, 2 * n);
    f(&Multigrid_gradients::m_product, n);
  }
  /// What n unknowns take.
  static std::size_t bytes(int n)
  {
    return internal::bytes_of_listed<Multigrid_gradients>(n) + Multigrid<Real, Backend>::bytes(n);
  }

  /// Solves for x. `r`: the right side before, the residual after. It is enough where all residuals
  /// are at most `limits` (or null), or their norm is at most `tolerance` times the first.
  /// \returns the number of iterations; -1 if there were numbers that are none, x is then 0.
  int solve(const Laplacian_rows<Real>& rows, double* x, double* r, const double* limits,
            double tolerance);

private:
  static constexpr int max_iterations = 200; // some 40 are usual
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  using State = internal::Gradients_state;

  State state()
  {
    State s;
    m_backend.download(&s, m_state.data(), 1);
    return s;
  }

  Backend& m_backend;
  Multigrid<Real, Backend> m_multigrid;
  int m_now = 0;               // which of the two directions
  Buffer<double> m_directions; // one after the other
  Buffer<double> m_product;
  Buffer<State> m_state;
};

template <class Real, class Backend>
int Multigrid_gradients<Real, Backend>::solve(const Laplacian_rows<Real>& rows, double* x,
                                              double* r, const double* limits, double tolerance)
{
  internal::allocate_listed(m_backend, *this, rows.n);
  m_multigrid.set_rows(rows);
  double* const directions[] = {m_directions.data(), m_directions.data() + rows.n};
  internal::begin_gradients(m_backend, rows, x, r, limits, directions[m_now], m_state.data());
  State s = state();
  const double enough = tolerance * tolerance * s.squares;
  int iterations = 0;
  for (; iterations < max_iterations && s.squares > enough && s.above > 0; ++iterations) {
    const Real* const z = m_multigrid.apply(r);
    const double* const before = directions[m_now];
    m_now = 1 - m_now;
    double *const direction = directions[m_now], *const product = m_product.data();
    internal::find_direction(m_backend, rows, r, z, iterations == 0, before, direction, product,
                             m_state.data());
    internal::step_along(m_backend, rows.n, direction, product, x, r, limits, m_state.data());
    s = state();
    if (!(s.curvature > 0)) break;
  }
  if (s.squares < 1e300) return iterations;
  m_backend.fill(x, 0., rows.n);
  return -1;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_MULTIGRID_GRADIENTS_H
