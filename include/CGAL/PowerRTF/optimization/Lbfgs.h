// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Limited-memory BFGS directions for points on a surface (Liu, Wang, Levy et al., "On centroidal
// Voronoi tessellation - energy smoothness and fast computation", 2009). There is no line search:
// the caller limits the steps. The two loops work on the products of the vectors, all of which one
// pass computes; a second pass combines the vectors. (Compact form: Byrd, Nocedal, Schnabel,
// "Representations of quasi-Newton matrices", 1994.)
#ifndef CGAL_POWER_RTF_OPTIMIZATION_LBFGS_H
#define CGAL_POWER_RTF_OPTIMIZATION_LBFGS_H

#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>

namespace CGAL::PowerRTF {

/// The memory's book-keeping and the coefficients of the next direction
/// -(D (g - sum alpha_k y_k) + sum gamma_k s_k).
template <int Memory>
struct Lbfgs_state {
  static constexpr int slots = Memory + 1; // one for the pair that is tried
  int memory = Memory;                     // pairs kept at most
  int count = 0;                           // pairs in memory
  int order[slots] = {}; // their slots, oldest first; order[count]: the slot to try next
  int has_last = 0;      // whether the last position and gradient are known
  double step_change[slots][slots] = {};       // s_a . y_b by slots, a no younger than b
  double alpha[slots] = {}, gamma[slots] = {}; // by age

  CGAL_POWER_RTF_HD void clear(int max_pairs)
  {
    *this = Lbfgs_state();
    memory = max_pairs;
    for (int k = 0; k < slots; ++k) order[k] = k;
  }
};

/// Places of the products among the totals of the first pass. Pairs are numbered by age; the pair
/// that is tried has number `count`.
template <int Memory>
struct Lbfgs_products {
  static constexpr int slots = Memory + 1;
  static constexpr int step_gradient = 0;         // s_k . g
  static constexpr int change_gradient = slots;   // y_k . D g
  static constexpr int step_change = 2 * slots;   // s_k . y_new
  static constexpr int change_change = 3 * slots; // y_k . D y_l, l <= k
  static constexpr int size = 3 * slots + slots * (slots + 1) / 2;
  CGAL_POWER_RTF_HD static constexpr int pair(int k, int l)
  {
    return change_change + k * (k + 1) / 2 + l;
  }
};

/// The two loops over the products of `count` pairs by age: from the newest to the oldest and back.
/// (All loops have constant bounds: one thread does this, and arrays in registers make it quick.)
template <int Memory, int slots>
CGAL_POWER_RTF_HD inline void run_two_loops(Lbfgs_state<Memory>& state, int count,
                                            const double (&sg)[slots], const double (&yg)[slots],
                                            const double (&sy)[slots][slots],
                                            const double (&yy)[slots][slots])
{
  double alpha[slots] = {}, gamma[slots] = {};
  CGAL_POWER_RTF_UNROLL
  for (int k = slots - 1; k >= 0; --k) {
    if (k >= count) continue;
    double a = sg[k];
    CGAL_POWER_RTF_UNROLL
    for (int l = 0; l < slots; ++l)
      if (l > k && l < count) a -= alpha[l] * sy[k][l];
    alpha[k] = a / sy[k][k];
  }
  CGAL_POWER_RTF_UNROLL
  for (int k = 0; k < slots; ++k) {
    if (k >= count) continue;
    double b = yg[k];
    CGAL_POWER_RTF_UNROLL
    for (int l = 0; l < slots; ++l)
      if (l < count) b -= alpha[l] * (l <= k ? yy[k][l] : yy[l][k]);
    CGAL_POWER_RTF_UNROLL
    for (int l = 0; l < slots; ++l)
      if (l < k) b += gamma[l] * sy[l][k];
    gamma[k] = alpha[k] - b / sy[k][k];
  }
  CGAL_POWER_RTF_UNROLL
  for (int k = 0; k < slots; ++k) {
    state.alpha[k] = alpha[k];
    state.gamma[k] = gamma[k];
  }
}

/// Takes in the tried pair when the energy is convex along it, and does the two loops.
template <int Memory, class T>
CGAL_POWER_RTF_HD inline void finish_products(Lbfgs_state<Memory>& state, const T& totals)
{
  using P = Lbfgs_products<Memory>;
  constexpr int slots = P::slots;
  const int before = state.count, memory = state.memory;
  int order[slots];
  CGAL_POWER_RTF_UNROLL
  for (int k = 0; k < slots; ++k) order[k] = state.order[k];

  // By age: s_k . g, y_k . D g, s_k . y_l for k <= l, y_k . D y_l for l <= k.
  double sg[slots], yg[slots], sy[slots][slots], yy[slots][slots];
  bool is_taken = false;
  CGAL_POWER_RTF_UNROLL
  for (int k = 0; k < slots; ++k) {
    sg[k] = totals.sum(P::step_gradient + k);
    yg[k] = totals.sum(P::change_gradient + k);
    CGAL_POWER_RTF_UNROLL
    for (int l = 0; l < slots; ++l) {
      const bool is_new = l == before;
      sy[k][l] = k > l    ? 0
                 : is_new ? totals.sum(P::step_change + k)
                          : state.step_change[order[k]][order[l]];
      yy[k][l] = l > k ? 0 : totals.sum(P::pair(k, l));
    }
    if (k == before) is_taken = state.has_last && sy[k][k] > 0;
  }
  int count = before;
  if (is_taken) {
    CGAL_POWER_RTF_UNROLL
    for (int l = 0; l < slots; ++l) CGAL_POWER_RTF_UNROLL
    for (int k = 0; k < slots; ++k)
      if (k <= l && l == before) state.step_change[order[k]][order[l]] = sy[k][l];
    ++count;
  }
  if (count > memory) { // the oldest pair goes; its slot is the next to try
    const int oldest = order[0];
    --count;
    CGAL_POWER_RTF_UNROLL
    for (int k = 0; k + 1 < slots; ++k) {
      order[k] = order[k + 1];
      sg[k] = sg[k + 1];
      yg[k] = yg[k + 1];
      CGAL_POWER_RTF_UNROLL
      for (int l = 0; l + 1 < slots; ++l) {
        sy[k][l] = sy[k + 1][l + 1];
        yy[k][l] = yy[k + 1][l + 1];
      }
    }
    order[slots - 1] = oldest;
    CGAL_POWER_RTF_UNROLL
    for (int k = 0; k < slots; ++k) state.order[k] = order[k];
  }

  run_two_loops(state, count, sg, yg, sy, yy);
  state.count = count;
  state.has_last = 1;
}

/// \tparam Memory the largest number of pairs that can be kept
template <class Real, class Backend, int Memory>
class Lbfgs {
public:
  using State = Lbfgs_state<Memory>;
  using Products = Lbfgs_products<Memory>;
  static constexpr int slots = State::slots;

  explicit Lbfgs(Backend& backend) : m_backend(backend)
  {
    m_state.allocate(backend, 1);
    m_products.allocate(backend, 1);
  }

  /// Of n points; see listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t n)
  {
    f(&Lbfgs::m_steps, n * slots);
    f(&Lbfgs::m_changes, n * slots);
    f(&Lbfgs::m_last_points, n);
    f(&Lbfgs::m_last_gradient, n);
  }

  /// `memory`: pairs to keep, at most `Memory`.
  void resize(int n, int memory)
  {
    internal::allocate_listed(m_backend, *this, n);
    m_n = n;
    m_pairs = memory;
    clear();
  }

  void clear()
  {
    State* const state = m_state.data();
    const int pairs = m_pairs;
    m_backend.for_each(1, [=] CGAL_POWER_RTF_HD(int) { state->clear(pairs); });
  }

  /// Prepares `direction()`: `gradient(i, g, inverse)` gives gradient and inverse diagonal of the
  /// Hessian of point i, `point(i)` its position.
  template <class Point, class Gradient>
  void prepare(Point point, Gradient gradient)
  {
    State* const state = m_state.data();
    Totals<Products::size, 0>* const products = m_products.data();
    Vec3<Real>*const steps = m_steps.data(), *const changes = m_changes.data();
    Vec3<Real>*const last_points = m_last_points.data(), *const last_gradient =
                                                             m_last_gradient.data();
    const int n = m_n;
    m_backend.template reduce<Products::size, 0>(
        n,
        [=] CGAL_POWER_RTF_HD(int i, Totals<Products::size, 0>& totals) {
          Vec3<Real> g;
          Real inverse;
          gradient(i, g, inverse);
          const Vec3<Real> p = point(i);
          const int count = state->count, pairs = count + (state->has_last ? 1 : 0);
          Vec3<Real> y[slots];
          if (state->has_last) {
            const std::size_t place = std::size_t(state->order[count]) * n + i;
            const Vec3<Real> unknown{0, 0, 0}; // what such a point did is not remembered
            const bool is_known = !(g == unknown) && !(last_gradient[i] == unknown);
            steps[place] = is_known ? p - last_points[i] : unknown;
            changes[place] = is_known ? g - last_gradient[i] : unknown;
          }
          last_points[i] = p;
          last_gradient[i] = g;
          const Vec3<Real> dg = g * inverse;
          CGAL_POWER_RTF_UNROLL
          for (int k = 0; k < slots; ++k) {
            if (k >= pairs) continue;
            y[k] = changes[std::size_t(state->order[k]) * n + i];
            totals.add(Products::change_gradient + k, dot_product(y[k], dg));
            CGAL_POWER_RTF_UNROLL
            for (int l = 0; l < slots; ++l)
              if (l <= k) totals.add(Products::pair(k, l), inverse * dot_product(y[k], y[l]));
          }
          const Vec3<Real> newest = state->has_last
                                        ? changes[std::size_t(state->order[count]) * n + i]
                                        : Vec3<Real>{0, 0, 0};
          CGAL_POWER_RTF_UNROLL
          for (int k = 0; k < slots; ++k) {
            if (k >= pairs) continue;
            const Vec3<Real> s = steps[std::size_t(state->order[k]) * n + i];
            totals.add(Products::step_gradient + k, dot_product(s, g));
            totals.add(Products::step_change + k, dot_product(s, newest));
          }
        },
        [=] CGAL_POWER_RTF_HD(const Totals<Products::size, 0>& totals) { *products = totals; });
    // A kernel of its own: its registers would slow the other one down.
    m_backend.for_each(1, [=] CGAL_POWER_RTF_HD(int) { finish_products(*state, *products); });
  }

  /// What gives the direction at point i after `prepare()`, to be called in a kernel.
  struct Direction {
    const State* state;
    const Vec3<Real>*steps, *changes;
    int n;

    CGAL_POWER_RTF_HD Vec3<Real> operator()(int i, const Vec3<Real>& gradient, Real inverse) const
    {
      Vec3<Real> q = gradient, s{0, 0, 0};
      CGAL_POWER_RTF_UNROLL
      for (int k = 0; k < Memory; ++k) {
        if (k >= state->count) break;
        const std::size_t place = std::size_t(state->order[k]) * n + i;
        q -= Real(state->alpha[k]) * changes[place];
        s += Real(state->gamma[k]) * steps[place];
      }
      return -(q * inverse + s);
    }
  };
  Direction direction() const { return {m_state.data(), m_steps.data(), m_changes.data(), m_n}; }

private:
  CGAL_POWER_RTF_HD static double dot_product(const Vec3<Real>& a, const Vec3<Real>& b)
  {
    return dot(a, b);
  } // three terms in `Real`, all sums of them in double

  Backend& m_backend;
  int m_n = 0, m_pairs = 0;
  typename Backend::template Buffer<State> m_state;
  typename Backend::template Buffer<Totals<Products::size, 0>> m_products;
  typename Backend::template Buffer<Vec3<Real>> m_steps, m_changes, m_last_points, m_last_gradient;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_LBFGS_H
