// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The member functions of `Engine` that construct cells and change weights and positions.
#ifndef CGAL_POWER_RTF_ENGINES_ENGINE_STEPS_H
#define CGAL_POWER_RTF_ENGINES_ENGINE_STEPS_H

#include <CGAL/PowerRTF/engines/Engine.h>

namespace CGAL::PowerRTF {

template <class R, class B, class C>
Sites_arrays<R> Engine<R, B, C>::sites()
{
  Sites_arrays<R> s;
  s.sites = m_sites.data();
  s.normals = m_normals.data();
  s.density_root = m_density_root.data();
  s.patches = m_has_patches ? m_patches.data() : nullptr;
  if (has_features()) {
    s.next = m_next.data();
    s.previous = m_previous.data();
  }
  s.cells = m_cells;
  s.sites_size = m_size;
  return s;
}

template <class R, class B, class C>
Cell_outputs<R> Engine<R, B, C>::outputs()
{
  Cell_outputs<R> out;
  out.area = m_area.data();
  out.mass = m_mass.data();
  out.offset = m_offset.data();
  out.status = m_status.data();
  if (m_are_edges_wanted) newton().add_outputs(m_cells, out);
  return out;
}

// ---- cells and what they say

template <class R, class B, class C>
void Engine<R, B, C>::build_cells()
{
  ++m_constructions;
  m_are_cells_due = true;
  forget_summary();
}

template <class R, class B, class C>
void Engine<R, B, C>::finish_cells()
{
  if (!m_are_cells_due) return;
  builder().build(outputs());
  m_are_edges_known = m_are_edges_wanted;
  m_are_cells_due = false;
}

template <class R, class B, class C>
void Engine<R, B, C>::start_summary()
{
  if (m_is_summary_started) return;
  m_is_summary_started = true;
  finish_cells();
  Summary_rule<R> rule;
  rule.cells = usable_cells();
  rule.offset = m_offset.data();
  rule.tolerance = m_options.capacity_tolerance;
  rule.is_left_out = m_is_left_out_known ? m_is_left_out.data() : nullptr;
  rule.n = m_cells;
  rule.passes = m_passes_made;
  rule.result = m_summary.data();
  rule.shared = m_shared_summary.data();
  m_backend.reduce_twice(m_cells, rule);
}

template <class R, class B, class C>
Cell_summary Engine<R, B, C>::summary()
{
  if (!m_is_summary_known) {
    start_summary();
    m_backend.stop_clock();
    m_backend.synchronize();
    m_is_summary_known = true;
    if (m_mean_mass == 0 && m_cells > 0) m_mean_mass = m_shared_summary.data()->mass / m_cells;
  }
  return *m_shared_summary.data();
}

// ---- weights (Algorithm 2)

template <class R, class B, class C>
void Engine<R, B, C>::use_weights()
{
  // With features the weights are relative to theirs.
  if (!has_features()) center_weights(m_backend, m_cells, m_sites.data(), m_scalar.data());
  builder().set_weights(sites());
}

template <class R, class B, class C>
void Engine<R, B, C>::find_distances()
{
  if (m_are_distances_known) return;
  builder().neighbor_distances(m_nearest.data(), m_sixth.data());
  m_are_distances_known = true;
}

template <class R, class B, class C>
void Engine<R, B, C>::update_weights()
{
  find_distances();
  start_summary();
  apply_weight_rule(m_backend, m_cells, m_sites.data(), usable_cells(), m_nearest.data(),
                    m_sixth.data(), m_summary.data(), weight_rule());
  use_weights();
}

template <class R, class B, class C>
bool Engine<R, B, C>::optimize_weights(int passes)
{
  m_passes_made = builder().start_weight_passes(sites(), m_sites.data(), m_density.data(),
                                                weight_rule(), passes, outputs());
  if (m_passes_made) { // all in one kernel, the first cells too
    m_are_cells_due = false;
    forget_summary();
    m_constructions += summary().passes;
    m_passes_made = nullptr;
  } else {
    for (int pass = 0; pass < passes && summary().capacity.inside_interval < 1; ++pass) {
      update_weights();
      build_cells();
    }
  }
  return summary().capacity.inside_interval == 1;
}

template <class R, class B, class C>
void Engine<R, B, C>::choose_left_out()
{
  if (m_is_left_out_known) return;
  finish_cells();
  leave_out_unequalizable(m_backend, m_cells, usable_cells(), m_is_left_out.data(),
                          m_scalar.data());
  m_is_left_out_known = true;
  forget_summary();
}

template <class R, class B, class C>
bool Engine<R, B, C>::newton_weights()
{
  forget_lbfgs();
  m_are_edges_wanted = true;
  choose_left_out();
  const auto take_step = [&](double step) {
    step_weights(m_backend, m_cells, m_sites.data(), m_weights_before.data(), newton().direction(),
                 step);
    use_weights();
    build_cells();
  };
  for (bool is_worth_another = true; is_worth_another;) {
    if (!m_are_edges_known) build_cells();
    const Capacity_statistics before = summary().capacity;
    if (!(before.mean > 0)) return false; // all cells are left out
    newton().solve(m_cells, m_area.data(), m_density.data(), m_is_left_out.data(),
                   m_options.capacity_tolerance, m_newton_goal, !m_are_components_known);
    m_are_components_known = true;
    m_are_edges_known = false;
    gather_weights(m_backend, m_cells, m_sites.data(), m_weights_before.data());
    for (const double step : newton_weight_steps) {
      if (step == 1 && m_has_newton_overshot) continue;
      take_step(step);
      const Capacity_statistics after = summary().capacity;
      m_has_newton_overshot = step == 1 && has_overshot(before, after);
      if (!(after.least > least_capacity(before) && after.rms < before.rms)) continue;
      if (step < 1 && has_stagnated(before, after)) m_newton_goal = global_newton_goal;
      return true;
    }
    is_worth_another = leave_out_vanishing(m_backend, m_cells, usable_cells(), before,
                                           m_is_left_out.data(), m_scalar.data()) ||
                       confine(m_newton_goal);
    take_step(0);
  }
  return false;
}

template <class R, class B, class C>
void Engine<R, B, C>::clear_weights()
{
  reset_weights(m_backend, m_cells, m_sites.data());
  builder().set_weights(sites());
  build_cells();
}

// ---- positions (Algorithm 3, lines 15 to 19)

template <class R, class B, class C>
double Engine<R, B, C>::remember_best()
{
  const double residual = summary().residual;
  if (residual < m_best.residual) {
    m_best.residual = residual;
    internal::allocate_listed(m_backend, m_best, m_size);
    copy_state(m_backend, m_size, m_best.sites.data(), m_best.facets.data(), m_sites.data(),
               m_facets.data());
  }
  return residual / m_best.residual;
}

template <class R, class B, class C>
void Engine<R, B, C>::restore_best()
{
  const bool is_best = !(remember_best() > 1);
  if (!is_best)
    copy_state(m_backend, m_size, m_sites.data(), m_facets.data(), m_best.sites.data(),
               m_best.facets.data());
  m_best = {};
  if (is_best) return;
  update_attributes();
  build_cells();
  forget_lbfgs();
}

template <class R, class B, class C>
template <class F>
void Engine<R, B, C>::with_lbfgs(F&& f)
{
  const auto call = [&](auto& lbfgs) {
    if (!lbfgs) lbfgs.emplace(m_backend).resize(m_cells, m_options.lbfgs_memory);
    f(*lbfgs);
  };
  if (m_options.lbfgs_memory <= short_memory)
    call(m_lbfgs);
  else
    call(m_long_lbfgs);
}

template <class R, class B, class C>
template <class Step>
void Engine<R, B, C>::project(const Step& step)
{
  const bool to_nearest_facet = m_options.projection == Projection::nearest_facet;
  const Projection_rule<R, Step> rule{
      attribute_rule(), step, m_sites.data(), m_facets.data(), m_options.projection_neighbors,
      to_nearest_facet};
  if (to_nearest_facet && rule.attributes.over_facet)
    m_backend.for_each_by_lanes(m_cells, rule);
  else
    m_backend.for_each_by_warps(m_cells, rule);
  set_sites();
}

template <class R, class B, class C>
void Engine<R, B, C>::move_samples(Position_method method)
{
  finish_cells();
  bool lbfgs = method == Position_method::lbfgs;
  constexpr double explosion = 16;
  if (lbfgs && remember_best() > explosion) { // back, and on from there by Lloyd's method
    restore_best();
    lbfgs = false;
  }
  const bool may_part = summary().counts[int(Cell_status::empty)] > 0;
  const Lloyd_step<R> lloyd{usable_cells(), m_offset.data()};
  if (!lbfgs && !may_part) return project(lloyd);
  R *const nearest = m_nearest.data(), *const sixth = m_sixth.data();
  Vec3<R>* const steps = m_step.data();
  if (!lbfgs)
    lloyd_steps(m_backend, m_cells, lloyd, steps);
  else
    with_lbfgs([&](auto& l) { lbfgs_steps(m_backend, m_cells, l, m_sites.data(), lloyd, steps); });
  if (may_part) {
    builder().empty_cells_distances(m_status.data(), nearest, sixth);
    m_are_distances_known = false;
    part_duplicates(m_backend, m_cells, m_status.data(), m_normals.data(), nearest, sixth, steps);
  }
  project(Noted_step<R>{steps});
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_ENGINE_STEPS_H
