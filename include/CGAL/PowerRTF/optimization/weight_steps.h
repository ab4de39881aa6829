// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps of the weights (Algorithm 2, and Newton's method), each over all n cells of an engine
// by its backend. `scalar`: memory of the backend for one number.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_WEIGHT_STEPS_H
#define CGAL_POWER_RTF_OPTIMIZATION_WEIGHT_STEPS_H

#include <CGAL/PowerRTF/cells/Sites_view.h>
#include <CGAL/PowerRTF/optimization/Cell_summary.h>
#include <CGAL/PowerRTF/optimization/multiplicative_weights.h>
#include <CGAL/PowerRTF/optimization/newton_step_rules.h>

namespace CGAL::PowerRTF {

/// Subtracts the weights' mean, which changes no cell.
template <class Real, class Backend>
void center_weights(Backend& backend, int n, Site<Real>* sites, double* scalar)
{
  backend.template reduce<1, 0>(
      n, [=] CGAL_POWER_RTF_HD(int i, Totals<1, 0>& t) { t.add(0, sites[i].weight); },
      [=] CGAL_POWER_RTF_HD(const Totals<1, 0>& t) { *scalar = t.sum(0) / n; });
  backend.for_each(
      n, [=] CGAL_POWER_RTF_HD(int i) { sites[i].weight = Real(sites[i].weight - *scalar); });
}

/// One pass of the paper's rule (Algorithm 2, lines 3 to 10). `nearest`, `sixth`: distances to the
/// first and the sixth nearest compatible site. The mean mass is that of `summary`.
template <class Real, class Backend>
void apply_weight_rule(Backend& backend, int n, Site<Real>* sites, Usable_cells<Real> cells,
                       const Real* nearest, const Real* sixth, const Cell_summary* summary,
                       Multiplicative_weight_rule rule)
{
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    Multiplicative_weight_rule change = rule;
    change.mean_mass = summary->mass / n;
    const double m = cells.capacity(i);
    // An empty cell often lies close to the sample that displaced it, where D_i says nothing.
    sites[i].weight = Real(sites[i].weight + change(m, m > 0 ? nearest[i] : sixth[i]));
  });
}

template <class Real, class Backend>
void gather_weights(Backend& backend, int n, const Site<Real>* sites, Real* weights)
{
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) { weights[i] = sites[i].weight; });
}

/// The weights `before` + `step` * `direction`.
template <class Real, class Backend>
void step_weights(Backend& backend, int n, Site<Real>* sites, const Real* before,
                  const double* direction, double step)
{
  backend.for_each(
      n, [=] CGAL_POWER_RTF_HD(int i) { sites[i].weight = Real(before[i] + step * direction[i]); });
}

template <class Real, class Backend>
void reset_weights(Backend& backend, int n, Site<Real>* sites)
{
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) { sites[i].weight = 0; });
}

/// Marks the cells that no weights make equal to the others.
template <class Real, class Backend>
void leave_out_unequalizable(Backend& backend, int n, Usable_cells<Real> cells,
                             unsigned char* is_left_out, double* scalar)
{
  backend.template reduce<2, 0>(
      n,
      [=] CGAL_POWER_RTF_HD(int i, Totals<2, 0>& t) {
        const bool is_ok = Cell_status(cells.status[i]) == Cell_status::ok;
        t.add(0, is_ok ? cells.capacity(i) : 0);
        t.add(1, is_ok);
      },
      [=] CGAL_POWER_RTF_HD(const Totals<2, 0>& t) { *scalar = t.sum(0) / t.sum(1); });
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    is_left_out[i] = !is_equalizable(Cell_status(cells.status[i]), cells.capacity(i), *scalar);
  });
}

/// Marks those, too, whose capacities have become as small as `least_capacity(before)`. \returns
/// `false`: there are none, or too many, and nothing has changed
template <class Real, class Backend>
bool leave_out_vanishing(Backend& backend, int n, Usable_cells<Real> cells,
                         const Capacity_statistics& before, unsigned char* is_left_out,
                         double* scalar)
{
  const double least = least_capacity(before);
  const auto is_vanishing = [=] CGAL_POWER_RTF_HD(int i) {
    return !is_left_out[i] && !(cells.capacity(i) > least);
  };
  backend.template reduce<1, 0>(
      n, [=] CGAL_POWER_RTF_HD(int i, Totals<1, 0>& t) { t.add(0, is_vanishing(i)); },
      [=] CGAL_POWER_RTF_HD(const Totals<1, 0>& t) { *scalar = t.sum(0); });
  double vanishing;
  backend.download(&vanishing, scalar, 1);
  if (!may_leave_out(std::size_t(vanishing), before.left_out, n)) return false;
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    if (is_vanishing(i)) is_left_out[i] = 1;
  });
  return true;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_WEIGHT_STEPS_H
