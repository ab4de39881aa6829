// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The member functions of `Device_engine`, step by step those of `Host_engine`.
#ifndef CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_IMPL_H
#define CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_IMPL_H

#include "Device_engine.h"

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
  const Attribute_rule<R> rule = attribute_rule();
  const Site<R>* const sites = m_sites.data();
  const int* const facets = m_facets.data();
  m_backend.for_each(
      m_cells, [=] CGAL_POWER_RTF_HD(int i) { rule(i, sites[i].point, facets[i], Single_lane()); });
  set_sites();
}

template <class R, class B, class C>
void Device_engine<R, B, C>::set_sites()
{
  m_cell_builder->set_sites(sites());
  m_are_distances_known = m_are_components_known = false;
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
  Device_summary* const s = m_summary_buffer.data();
  const R *const area = m_area.data(), *const mass = m_mass.data(), *const rho = m_density.data();
  const Vec3<R>* const offset = m_offset.data();
  const unsigned char* const status = m_status.data();
  const double gamma = m_options.capacity_tolerance;
  const int n = m_cells;
  m_backend.template reduce<7, 1>(
      n,
      [=] CGAL_POWER_RTF_HD(int i, Totals<7, 1>& t) {
        const double m = double(rho[i]) * area[i];
        t.add(0, m);
        const double x = offset[i].x, y = offset[i].y, z = offset[i].z, d = x * x + y * y + z * z;
        t.add(1, d);
        if (status[i] == int(Cell_status::ok) && mass[i] > 0) t.add(2, d);
        for (int k = 0; k < 4; ++k) t.add(3 + k, status[i] == k);
        t.raise(0, -m);
      },
      [=] CGAL_POWER_RTF_HD(const Totals<7, 1>& t) {
        s->mass = t.sum(0);
        s->displacement = t.sum(1);
        s->residual = t.sum(2);
        for (int k = 0; k < 4; ++k) s->counts[k] = t.sum(3 + k);
        s->least = -t.maximum(0);
      });
  m_backend.template reduce<2, 1>(
      n,
      [=] CGAL_POWER_RTF_HD(int i, Totals<2, 1>& t) {
        const double deviation = std::fabs(double(rho[i]) * area[i] / (s->mass / n) - 1);
        t.add(0, deviation <= gamma);
        t.add(1, deviation * deviation);
        t.raise(0, deviation);
      },
      [=] CGAL_POWER_RTF_HD(const Totals<2, 1>& t) {
        s->inside = t.sum(0);
        s->squares = t.sum(1);
        s->largest = t.maximum(0);
      });
}

template <class R, class B, class C>
Device_summary Device_engine<R, B, C>::summary()
{
  if (!m_is_summary_known) {
    start_summary();
    m_backend.stop_clock();
    m_backend.download(&m_summary, m_summary_buffer.data(), 1);
    m_is_summary_known = true;
  }
  return m_summary;
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
    m_are_cells_due = false;
    find_distances();
    m_constructions += m_cell_builder->paper_weight_passes(
        sites(), m_sites.data(), m_density.data(), m_nearest.data(), m_sixth.data(), weight_rule(),
        passes, outputs());
    m_is_summary_known = m_is_summary_started = false;
  } else {
    for (int pass = 0; pass < passes && summary().inside < m_cells; ++pass) {
      update_weights();
      build_cells();
    }
  }
  return summary().inside == m_cells;
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
bool Device_engine<R, B, C>::newton_weights()
{
  const Device_summary before = summary();
  Cell_outputs<R> out = outputs();
  m_newton.add_outputs(m_cells, out);
  ++m_constructions;
  m_cell_builder->build(out);
  m_newton.solve(m_cells, m_area.data(), m_density.data(), m_options.capacity_tolerance,
                 !m_are_components_known);
  m_are_components_known = true;

  const Site<R>* const sites = m_sites.data();
  R* const weights = m_weights_before.data();
  m_backend.for_each(m_cells, [=] CGAL_POWER_RTF_HD(int i) { weights[i] = sites[i].weight; });
  for (double step : {1.0, 0.5, 0.25, 0.125, 0.0}) { // the last: back to where it was
    set_weights(m_newton.direction(), step);
    center_weights();
    build_cells();
    if (step == 0) return false;
    const Device_summary after = summary();
    // No cell may come near to vanishing: there the areas stop being differentiable.
    if (after.squares < before.squares &&
        after.least > 0.3 * std::min(before.least, before.mass / m_cells))
      return true;
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
  // The energy is the sum of int rho |x - s_i|^2 over the cells: gradient 2 m_i (s_i - c_i). Cells
  // that are not ok say nothing about it and would poison the memory.
  const Site<R>* const sites = m_sites.data();
  const R *const mass = m_mass.data(), *const area = m_area.data();
  const Vec3<R>* const offset = m_offset.data();
  Vec3<R>* const step = m_step.data();
  const unsigned char* const status = m_status.data();
  const auto gradient = [=] CGAL_POWER_RTF_HD(int i, Vec3<R>& g, R& inverse) {
    const bool usable = status[i] == int(Cell_status::ok) && mass[i] > 0;
    g = usable ? offset[i] * (-2 * mass[i]) : Vec3<R>{0, 0, 0};
    inverse = usable ? 1 / (2 * mass[i]) : R(0);
    return usable;
  };
  lbfgs.prepare([=] CGAL_POWER_RTF_HD(int i) { return sites[i].point; }, gradient);
  const auto direction = lbfgs.direction();
  m_backend.for_each(m_cells, [=] CGAL_POWER_RTF_HD(int i) {
    Vec3<R> g;
    R inverse;
    const bool usable = gradient(i, g, inverse);
    const bool empty = status[i] == int(Cell_status::empty);
    step[i] = empty ? Vec3<R>{0, 0, 0} : offset[i] * R(0.5);
    if (!usable) return;
    const Vec3<R> d = direction(i, g, inverse);
    const R longest = std::sqrt(area[i]) / 2, l = length(d);
    step[i] = l > longest ? d * (longest / l) : d;
  });
}

/// Lloyd's method: to the centre of mass.
template <class R, class B, class C>
void Device_engine<R, B, C>::find_lloyd_steps()
{
  const R* const mass = m_mass.data();
  const Vec3<R>* const offset = m_offset.data();
  Vec3<R>* const step = m_step.data();
  const unsigned char* const status = m_status.data();
  m_backend.for_each(m_cells, [=] CGAL_POWER_RTF_HD(int i) {
    const bool usable = status[i] == int(Cell_status::ok) && mass[i] > 0;
    const bool empty = status[i] == int(Cell_status::empty);
    step[i] = offset[i] * R(empty ? 0 : usable ? 1 : 0.5);
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
void Device_engine<R, B, C>::project()
{
  Projection_rule<R> rule;
  rule.attributes = attribute_rule();
  rule.sites = m_sites.data();
  rule.steps = m_step.data();
  rule.facets = m_facets.data();
  rule.neighbors = m_options.projection_neighbors;
  rule.to_nearest_facet = m_options.projection == Projection::nearest_facet;
  if (rule.to_nearest_facet && rule.attributes.over_facet)
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
  if (!lbfgs)
    find_lloyd_steps();
  else if (has_short_memory())
    find_lbfgs_steps(m_lbfgs);
  else
    find_lbfgs_steps(m_long_lbfgs);
  if (summary().counts[int(Cell_status::empty)] > 0) part_duplicates();
  project();
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_IMPL_H
