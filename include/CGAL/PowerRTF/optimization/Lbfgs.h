// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Limited-memory BFGS directions for points on a surface (Liu, Wang, Levy et al., "On centroidal
// Voronoi tessellation - energy smoothness and fast computation", 2009). There is no line search:
// the caller limits the steps.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_LBFGS_H
#define CGAL_POWER_RTF_OPTIMIZATION_LBFGS_H

#include <CGAL/PowerRTF/cells/vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <deque>
#include <utility>
#include <vector>

namespace CGAL {
namespace PowerRTF {

template <class ConcurrencyTag>
class Lbfgs {
public:
  using Vectors = std::vector<Vec3d>;

  explicit Lbfgs(std::size_t memory) : m_memory(memory) {}

  void clear()
  {
    m_pairs.clear();
    m_last_positions.clear();
  }

  /// The descent direction at `positions` with gradient `gradient`; `inverse_diagonal[i]` is the
  /// initial inverse Hessian of point i. The first call after `clear()` gives a scaled gradient step.
  /// A gradient of 0 says that none is known: what the point did is not remembered.
  Vectors direction(const Vectors& positions, const Vectors& gradient,
                    const std::vector<double>& inverse_diagonal)
  {
    const int n = static_cast<int>(positions.size());
    if (!m_last_positions.empty()) remember(positions, gradient);
    m_last_positions = positions;
    m_last_gradient = gradient;

    Vectors q = gradient;
    std::vector<double> alpha(m_pairs.size());
    for (std::size_t k = m_pairs.size(); k-- > 0;) {
      const Pair& p = m_pairs[k];
      alpha[k] = dot_product(p.step, q) / p.curvature;
      add(q, -alpha[k], p.change);
    }
    internal::for_each_index<ConcurrencyTag>(n, [&](int i) { q[i] *= inverse_diagonal[i]; });
    for (std::size_t k = 0; k < m_pairs.size(); ++k) {
      const Pair& p = m_pairs[k];
      add(q, alpha[k] - dot_product(p.change, q) / p.curvature, p.step);
    }
    internal::for_each_index<ConcurrencyTag>(n, [&](int i) { q[i] = -q[i]; });
    return q;
  }

private:
  struct Pair {
    Vectors step, change; ///< of the positions, of the gradient
    double curvature;     ///< their product, > 0
  };

  void remember(const Vectors& positions, const Vectors& gradient)
  {
    const int n = static_cast<int>(positions.size());
    Pair p{Vectors(n), Vectors(n), 0};
    const Vec3d unknown{0, 0, 0};
    internal::for_each_index<ConcurrencyTag>(n, [&](int i) {
      p.step[i] = p.change[i] = unknown;
      if (gradient[i] == unknown || m_last_gradient[i] == unknown) return;
      p.step[i] = positions[i] - m_last_positions[i];
      p.change[i] = gradient[i] - m_last_gradient[i];
    });
    p.curvature = dot_product(p.step, p.change);
    if (!(p.curvature > 0)) return; // not convex along the step: the pair would spoil the memory
    m_pairs.push_back(std::move(p));
    if (m_pairs.size() > m_memory) m_pairs.pop_front();
  }

  static double dot_product(const Vectors& a, const Vectors& b)
  {
    return internal::sum<ConcurrencyTag>(static_cast<int>(a.size()),
                                         [&](int i) { return dot(a[i], b[i]); });
  }

  static void add(Vectors& a, double factor, const Vectors& b)
  {
    internal::for_each_index<ConcurrencyTag>(static_cast<int>(a.size()),
                                             [&](int i) { a[i] += factor * b[i]; });
  }

  std::size_t m_memory;
  std::deque<Pair> m_pairs;
  Vectors m_last_positions, m_last_gradient;
};

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_OPTIMIZATION_LBFGS_H
