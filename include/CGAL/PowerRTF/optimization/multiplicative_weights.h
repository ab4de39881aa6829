// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One weight's change in Algorithm 2. What the paper leaves open is filled in so that the rule is
// scale invariant and ends: Delta s = tau gamma D_i / 4 (for a hexagonal cell and tau = 1 a Jacobi
// step), and alpha rounded up (rounded down it is 0 between one and two half-intervals, where cells
// then park).
#ifndef CGAL_POWER_RTF_OPTIMIZATION_MULTIPLICATIVE_WEIGHTS_H
#define CGAL_POWER_RTF_OPTIMIZATION_MULTIPLICATIVE_WEIGHTS_H

#include <CGAL/PowerRTF/geometry/vector.h>

namespace CGAL::PowerRTF {

struct Multiplicative_weight_rule {
  double tolerance; ///< gamma; 0: the limit of the rule (CCCPD), a step in proportion
  double step;      ///< tau
  bool round_down;  ///< alpha as printed in the paper
  double mean_mass; ///< the interval is [(1 - gamma), (1 + gamma)] times this

  /// The change of w_i for a cell of mass `mass` whose nearest neighbor is at `distance` (D_i).
  CGAL_POWER_RTF_HD double operator()(double mass, double distance) const
  {
    const double d2 = distance * distance;
    if (!(mass > 0)) return 0.2 * d2; // empty: grow until it meets its tangent plane again
    const double excess = mass / mean_mass - 1, size = excess < 0 ? -excess : excess;
    if (size <= tolerance) return 0;
    // alpha * gamma, with alpha = round(Delta m / Delta c - 1)
    double alpha_gamma = size;
    if (tolerance > 0) {
      const double alpha = size / tolerance - 1;
      alpha_gamma = tolerance * (round_down ? std::floor(alpha) : std::ceil(alpha));
    }
    const double change = step * alpha_gamma * d2 / 2; // alpha * 2 D_i Delta s
    return excess < 0 ? change : -change;
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_MULTIPLICATIVE_WEIGHTS_H
