// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the engines' Newton steps on the weights have in common: the cells that are left out, and
// the steps that are good.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_NEWTON_STEP_RULES_H
#define CGAL_POWER_RTF_OPTIMIZATION_NEWTON_STEP_RULES_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/cells/construct_cell.h>

#include <cstddef>

namespace CGAL::PowerRTF {

/// Whether weights can give a cell its share of the area. At tips that are narrower than the
/// spacing none can: to count these cells would keep all others from their shares.
///
/// \param capacity rho_i A(F_i)
/// \param mean of the capacities of the cells that are not guarded
CGAL_POWER_RTF_HD inline bool is_equalizable(Cell_status status, double capacity, double mean)
{
  constexpr double least = 0.3, most = 2.5;
  return status == Cell_status::ok && capacity >= least * mean && capacity <= most * mean;
}

/// What Newton's system asks for, in parts of the half-width gamma of the capacity interval.
struct Newton_goal {
  double slack;     ///< capacities this near to the mean stay, and the others shall come there
  double screening; ///< of L's diagonal, added to it (Levenberg and Marquardt's method)
};

/// At first, what varies slowly over many cells stays where it is inside the interval: it would
/// take weights far above a cell's squared radius, for little. The screening confines a change to
/// some sqrt(1 / (gamma screening)) cells around.
constexpr Newton_goal local_newton_goal{0.25, 0.03};
/// All shares themselves: once that leads no further.
constexpr Newton_goal global_newton_goal{0, 0};

/// Confines changes to fewer cells, after a direction none of whose steps was good. \returns
/// whether that may help
inline bool confine(Newton_goal& goal)
{
  constexpr double most = 0.48;
  if (!(goal.screening > 0 && goal.screening < most)) return false;
  goal.screening *= 4;
  return true;
}

/// Whether a step has brought neither more cells inside nor any deviation notably nearer to 0.
inline bool has_stagnated(const Capacity_statistics& before, const Capacity_statistics& after)
{
  return after.inside_interval <= before.inside_interval && after.rms > 0.98 * before.rms &&
         after.largest_deviation > 0.98 * before.largest_deviation;
}

/// Newton's steps, as parts of its direction, until one is good.
constexpr double newton_weight_steps[] = {1.0, 0.5, 0.25, 0.125, 0.0625};

/// Whether a full step has brought the largest deviation hardly nearer to 0, and no more cells
/// inside. Full steps may pass by a cell's share forth and back for many rounds; a half one between
/// them reaches it.
inline bool has_overshot(const Capacity_statistics& before, const Capacity_statistics& after)
{
  return after.largest_deviation > 0.6 * before.largest_deviation &&
         after.inside_interval <= before.inside_interval;
}

/// What each capacity has to stay above in a Newton step: cells that come near to vanishing stop
/// having differentiable areas.
inline double least_capacity(const Capacity_statistics& before)
{
  return 0.3 * (before.least < before.mean ? before.least : before.mean);
}

/// Whether the cells that vanished in the shortest step may be left out, too, of n.
inline bool may_leave_out(std::size_t vanishing, std::size_t left_out, std::size_t n)
{
  return vanishing > 0 && 100 * (left_out + vanishing) <= n;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_NEWTON_STEP_RULES_H
