// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CUDA_WEIGHT_PASS_STATE_H
#define CGAL_POWER_RTF_CUDA_WEIGHT_PASS_STATE_H

#include <CGAL/PowerRTF/cells/Cell_arrays.h>

#include <CGAL/PowerRTF/optimization/multiplicative_weights.h>

namespace CGAL::PowerRTF::device {

/// Input of the weight passes by the paper's rule.
template <class Real>
struct Weight_pass_input {
  Sites_arrays<Real> arrays;         ///< the sites that are set
  Site<Real>* sites = nullptr;       ///< those of `arrays`: the weights are written here
  const Real* density = nullptr;     ///< rho of each cell
  Multiplicative_weight_rule rule{}; ///< its mean mass is that of the cells
  int passes = 0;                    ///< at most
  Cell_outputs<Real> out;            ///< of the cells of the last weights; with areas
};

/// Result of the weight passes.
struct Weight_pass_state {
  int done = 0;  ///< changes of the weights
  int equal = 0; ///< all masses are inside the interval
  double mean_mass = 0;
};

/// What a warp publishes about its site: the weight of the last cells, the distance that the rule
/// uses for it, and the mass of the cell.
template <class Real>
struct alignas(16) Pass_record {
  Real weight, distance;
  double mass;
};

/// Totals over the cells of a pass.
struct Pass_totals {
  double mass = 0, max_mass = 0, min_mass = 1e300; ///< sum and extremes of the masses
  double growth = 0;                               ///< upper bound of the growth of the weights
};

/// Counters shared by all warps, initially zero. Arrays: one entry per pass, used in turn.
template <class Real>
struct Pass_counters {
  static constexpr int max_groups = 256, turns = 3;
  using Bits = unsigned long long; ///< of numbers that are not negative
  Bits max_mass[turns], not_min_mass[turns], all_growth[turns]; ///< see `Pass_totals`
  unsigned arrivals;                                            ///< of blocks, at barriers
  Real growth[turns][max_groups];                               ///< of groups, see `Verlet_lists`
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WEIGHT_PASS_STATE_H
