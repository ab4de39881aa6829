// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The member functions of `Device_engine`, step by step those of `Host_engine`.
#ifndef CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_IMPL_H
#define CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_IMPL_H

#include "Device_engine.h"

#include <CGAL/PowerRTF/optimization/newton_step_rules.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// Normals and densities of the samples where they are; the cells' sites are those.
template <class R, class B, class C>
void Device_engine<R, B, C>::update_attributes()
{
  const Placed_attributes_rule<R> rule{attribute_rule(), m_sites.data(), m_facets.data()};
  if (rule.attributes.over_facet)
    m_backend.for_each_by_lanes(m_cells, rule);
  else
    m_backend.for_each_by_warps(m_cells, rule);
  set_sites();
}

template <class R, class B, class C>
void Device_engine<R, B, C>::set_sites()
{
  m_cell_builder->set_sites(sites());
  m_are_distances_known = m_are_components_known = m_is_left_out_known = false;
  m_is_summary_known = m_is_summary_started = false;
}

template <class R, class B, class C>
void Device_engine<R, B, C>::build_cells()
{
  ++m_constructions;
  m_are_cells_due = true;
  m_is_summary_known = m_is_summary_started = false;
}

/// Makes the cells that `build_cells()` has promised.
template <class R, class B, class C>
void Device_engine<R, B, C>::finish_cells()
{
  if (m_are_cells_due) m_cell_builder->build(outputs());
  m_are_cells_due = false;
}

template <class R, class B, class C>
void Device_engine<R, B, C>::start_summary()
{
  if (m_is_summary_started) return;
  m_is_summary_started = true;
  finish_cells();
  Summary_rule<R> rule;
  rule.usable = usable_rule();
  rule.offset = m_offset.data();
  rule.tolerance = m_options.capacity_tolerance;
  rule.is_left_out = m_is_left_out_known ? m_is_left_out.data() : nullptr;
  rule.n = m_cells;
  rule.passes = m_passes_made;
  rule.result = m_summary_buffer.data();
  rule.host_result = m_summary.data();
  m_backend.run_team(m_cells, rule);
}

template <class R, class B, class C>
Device_summary Device_engine<R, B, C>::summary()
{
  if (!m_is_summary_known) {
    start_summary();
    m_backend.stop_clock();
    m_backend.synchronize();
    m_is_summary_known = true;
    if (m_mean_mass == 0 && m_cells > 0) m_mean_mass = m_summary.data()->cells.mass / m_cells;
  }
  return m_summary.data()->cells;
}

template <class R, class B, class C>
void Device_engine<R, B, C>::center_weights()
{
  // With features the weights are relative to theirs.
  if (m_size > m_cells) return m_cell_builder->set_weights(this->sites());
  Site<R>* const sites = m_sites.data();
  Device_summary* const s = m_summary_buffer.data(); // `displacement` serves as scratch
  const int n = m_cells;
  m_backend.template reduce<1, 0>(
      n, [=] CGAL_POWER_RTF_HD(int i, Totals<1, 0>& t) { t.add(0, sites[i].weight); },
      [=] CGAL_POWER_RTF_HD(const Totals<1, 0>& t) { s->displacement = t.sum(0) / n; });
  m_backend.for_each(
      n, [=] CGAL_POWER_RTF_HD(int i) { sites[i].weight = R(sites[i].weight - s->displacement); });
  m_cell_builder->set_weights(this->sites());
}

template <class R, class B, class C>
void Device_engine<R, B, C>::find_distances()
{
  if (m_are_distances_known) return;
  m_cell_builder->neighbor_distances(true, m_nearest.data(), m_sixth.data());
  m_are_distances_known = true;
}

template <class R, class B, class C>
void Device_engine<R, B, C>::weight_pass()
{
  Site<R>* const sites = m_sites.data();
  const R *const area = m_area.data(), *const rho = m_density.data();
  const R *const nearest = m_nearest.data(), *const sixth = m_sixth.data();
  const Device_summary* const s = m_summary_buffer.data();
  const Multiplicative_weight_rule rule = weight_rule();
  const int n = m_cells;
  m_backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    Multiplicative_weight_rule change = rule;
    change.mean_mass = s->mass / n;
    const double m = double(rho[i]) * area[i];
    // An empty cell often lies close to the sample that displaced it, where D_i says nothing.
    sites[i].weight = R(sites[i].weight + change(m, m > 0 ? nearest[i] : sixth[i]));
  });
}

template <class R, class B, class C>
void Device_engine<R, B, C>::update_weights()
{
  find_distances();
  start_summary();
  weight_pass();
  center_weights();
  m_is_summary_known = m_is_summary_started = false;
}

template <class R, class B, class C>
bool Device_engine<R, B, C>::optimize_weights(int passes)
{
  if constexpr (Makes_weight_passes<C>::value) { // all in one kernel, the first cells too
    m_are_cells_due = m_is_summary_known = m_is_summary_started = false;
    if (m_cell_builder->start_weight_passes(sites(), m_sites.data(), m_density.data(), nullptr,
                                            nullptr, weight_rule(), passes, outputs())) {
      m_passes_made = &m_cell_builder->weight_pass_state()->done;
      summary();
      m_passes_made = nullptr;
      m_constructions += m_summary.data()->passes;
    } else { // too many
      find_distances();
      m_constructions += m_cell_builder->paper_weight_passes(
          sites(), m_sites.data(), m_density.data(), m_nearest.data(), m_sixth.data(),
          weight_rule(), passes, outputs());
    }
  } else {
    for (int pass = 0; pass < passes && summary().capacity.inside_interval < 1; ++pass) {
      update_weights();
      build_cells();
    }
  }
  return summary().capacity.inside_interval == 1;
}

template <class R, class B, class C>
void Device_engine<R, B, C>::set_weights(const double* direction, double step)
{
  Site<R>* const sites = m_sites.data();
  const R* const before = m_weights_before.data();
  const int n = m_cells;
  m_backend.for_each(
      n, [=] CGAL_POWER_RTF_HD(int i) { sites[i].weight = R(before[i] + step * direction[i]); });
}

template <class R, class B, class C>
void Device_engine<R, B, C>::choose_left_out()
{
  if (m_is_left_out_known) return;
  m_is_left_out.allocate(m_backend, m_cells);
  const Usable_rule<R> cells = usable_rule();
  unsigned char* const is_left_out = m_is_left_out.data();
  double* const mean = m_scalar.data();
  finish_cells();
  m_backend.template reduce<2, 0>(
      m_cells,
      [=] CGAL_POWER_RTF_HD(int i, Totals<2, 0>& t) {
        const bool is_ok = Cell_status(cells.status[i]) == Cell_status::ok;
        t.add(0, is_ok ? double(cells.density[i]) * cells.area[i] : 0);
        t.add(1, is_ok);
      },
      [=] CGAL_POWER_RTF_HD(const Totals<2, 0>& t) { *mean = t.sum(0) / t.sum(1); });
  m_backend.for_each(m_cells, [=] CGAL_POWER_RTF_HD(int i) {
    is_left_out[i] = !is_equalizable(Cell_status(cells.status[i]),
                                     double(cells.density[i]) * cells.area[i], *mean);
  });
  m_is_left_out_known = true;
  m_is_summary_known = m_is_summary_started = false;
}

template <class R, class B, class C>
bool Device_engine<R, B, C>::leave_out_vanishing(const Capacity_statistics& before)
{
  unsigned char* const is_left_out = m_is_left_out.data();
  const Vanishing_rule<R> is_vanishing{m_area.data(), m_density.data(), is_left_out,
                                       least_capacity(before)};
  double* const count = m_scalar.data();
  m_backend.template reduce<1, 0>(
      m_cells, [=] CGAL_POWER_RTF_HD(int i, Totals<1, 0>& t) { t.add(0, is_vanishing(i)); },
      [=] CGAL_POWER_RTF_HD(const Totals<1, 0>& t) { *count = t.sum(0); });
  double vanishing;
  m_backend.download(&vanishing, count, 1);
  if (!may_leave_out(std::size_t(vanishing), before.left_out, m_cells)) return false;
  m_backend.for_each(m_cells, [=] CGAL_POWER_RTF_HD(int i) {
    if (is_vanishing(i)) is_left_out[i] = 1;
  });
  return true;
}

template <class R, class B, class C>
bool Device_engine<R, B, C>::newton_weights()
{
  choose_left_out();
  bool is_worth_another = true;
  while (is_worth_another) {
    const Capacity_statistics before = summary().capacity;
    Cell_outputs<R> out = outputs();
    m_newton.add_outputs(m_cells, out);
    ++m_constructions;
    m_cell_builder->build(out);
    m_newton.solve(m_cells, m_area.data(), m_density.data(), m_is_left_out.data(),
                   m_options.capacity_tolerance, !m_are_components_known);
    m_are_components_known = true;

    const Site<R>* const sites = m_sites.data();
    R* const weights = m_weights_before.data();
    m_backend.for_each(m_cells, [=] CGAL_POWER_RTF_HD(int i) { weights[i] = sites[i].weight; });
    const auto take = [&](double step) {
      set_weights(m_newton.direction(), step);
      center_weights();
      build_cells();
    };
    for (const double step : newton_weight_steps) {
      take(step);
      const Capacity_statistics after = summary().capacity;
      if (after.least > least_capacity(before) && after.rms < before.rms) return true;
    }
    is_worth_another = leave_out_vanishing(before);
    take(0);
  }
  return false;
}

template <class R, class B, class C>
void Device_engine<R, B, C>::clear_weights()
{
  Site<R>* const sites = m_sites.data();
  m_backend.for_each(m_cells, [=] CGAL_POWER_RTF_HD(int i) { sites[i].weight = 0; });
  m_cell_builder->set_weights(this->sites());
  build_cells();
}

template <class R, class B, class C>
void Device_engine<R, B, C>::copy_state(Site<R>* to_sites, int* to_facets, const Site<R>* sites,
                                        const int* facets)
{
  m_backend.for_each(m_size, [=] CGAL_POWER_RTF_HD(int i) {
    to_sites[i] = sites[i];
    to_facets[i] = facets[i];
  });
}

template <class R, class B, class C>
double Device_engine<R, B, C>::remember_best()
{
  const double residual = summary().residual;
  if (residual < m_best.residual) {
    m_best.residual = residual;
    copy_state(m_best.sites.data(), m_best.facets.data(), m_sites.data(), m_facets.data());
  }
  return residual / m_best.residual;
}

template <class R, class B, class C>
void Device_engine<R, B, C>::restore_best()
{
  if (!(remember_best() > 1)) return;
  copy_state(m_sites.data(), m_facets.data(), m_best.sites.data(), m_best.facets.data());
  update_attributes();
  build_cells();
  if (has_short_memory())
    m_lbfgs.clear();
  else
    m_long_lbfgs.clear();
}

template <class R, class B, class C>
template <class Lbfgs>
void Device_engine<R, B, C>::find_lbfgs_steps(Lbfgs& lbfgs)
{
  // The energy is the sum of int rho |x - s_i|^2 over the cells: gradient 2 m_i (s_i - c_i).
  const Site<R>* const sites = m_sites.data();
  const Lloyd_step<R> other = lloyd_step();
  Vec3<R>* const step = m_step.data();
  const auto gradient = [=] CGAL_POWER_RTF_HD(int i, Vec3<R>& g, R& inverse) {
    const bool usable = other.usable(i);
    const R mass = other.usable.mass[i];
    g = usable ? other.offset[i] * (-2 * mass) : Vec3<R>{0, 0, 0};
    inverse = usable ? 1 / (2 * mass) : R(0);
    return usable;
  };
  lbfgs.prepare([=] CGAL_POWER_RTF_HD(int i) { return sites[i].point; }, gradient);
  const auto direction = lbfgs.direction();
  m_backend.for_each(m_cells, [=] CGAL_POWER_RTF_HD(int i) {
    Vec3<R> g;
    R inverse;
    const bool usable = gradient(i, g, inverse);
    step[i] = usable ? shortened(direction(i, g, inverse), other.usable.area[i]) : other(i);
  });
}

/// A sample with an empty cell stays, unless it lies on another sample: no weight could part them.
template <class R, class B, class C>
void Device_engine<R, B, C>::part_duplicates()
{
  m_cell_builder->neighbor_distances(false, m_nearest.data(), m_sixth.data());
  m_are_distances_known = false;
  const R *const nearest = m_nearest.data(), *const sixth = m_sixth.data();
  const Vec3<R>* const normals = m_normals.data();
  Vec3<R>* const step = m_step.data();
  const unsigned char* const status = m_status.data();
  m_backend.for_each(m_cells, [=] CGAL_POWER_RTF_HD(int i) {
    if (status[i] != int(Cell_status::empty) || nearest[i] > 0) return;
    const double angle = 2.399963229728653 * i; // the golden angle: all directions differ
    const Tangent_frame<R> frame(normals[i]);
    step[i] = (frame.u * R(std::cos(angle)) + frame.v * R(std::sin(angle))) * (sixth[i] / 2);
  });
}

template <class R, class B, class C>
template <class Step>
void Device_engine<R, B, C>::project(const Step& step)
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
void Device_engine<R, B, C>::move_samples(Position_method method)
{
  finish_cells();
  bool lbfgs = method == Position_method::lbfgs;
  constexpr double explosion = 16;
  if (lbfgs && remember_best() > explosion) { // back, and on from there by Lloyd's method
    restore_best();
    lbfgs = false;
  }
  const bool may_part = summary().counts[int(Cell_status::empty)] > 0;
  const Lloyd_step<R> lloyd = lloyd_step();
  if (!lbfgs && !may_part) return project(lloyd);
  Vec3<R>* const steps = m_step.data();
  if (!lbfgs)
    m_backend.for_each(m_cells, [=] CGAL_POWER_RTF_HD(int i) { steps[i] = lloyd(i); });
  else if (has_short_memory())
    find_lbfgs_steps(m_lbfgs);
  else
    find_lbfgs_steps(m_long_lbfgs);
  if (may_part) part_duplicates();
  project(Noted_step<R>{steps});
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_IMPL_H
