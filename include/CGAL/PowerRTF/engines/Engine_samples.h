// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The member functions of `Engine` that take the samples in, and give samples and cells out.
#ifndef CGAL_POWER_RTF_ENGINES_ENGINE_SAMPLES_H
#define CGAL_POWER_RTF_ENGINES_ENGINE_SAMPLES_H

#include <CGAL/PowerRTF/engines/Engine.h>
#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/box_around.h>
#include <CGAL/PowerRTF/geometry/hilbert_code.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace CGAL::PowerRTF {

/// Places along the Hilbert curve through the cube around `box`: no size or position decides them.
template <class Real, class Backend>
void find_hilbert_codes(Backend& backend, int n, const Site<Real>* sites, const Box3<double>& box,
                        std::uint64_t* codes)
{
  const Vec3d size = box.hi - box.lo;
  const Vec3<Real> center = to_real<Real>(0.5 * (box.lo + box.hi));
  const Real scale = Real(2 / std::max({size.x, size.y, size.z}));
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    codes[i] = hilbert_code(scale * (sites[i].point - center));
  });
}

template <class Real, class Backend>
void copy_without_weights(Backend& backend, int n, const Site<Real>* from, Site<Real>* to)
{
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) { to[i] = {from[i].point, Real(0)}; });
}

template <class Real, class Backend>
void find_density_roots(Backend& backend, int n, const Attribute_rule<Real>& rule)
{
  backend.for_each(
      n, [=] CGAL_POWER_RTF_HD(int i) { rule.density_root[i] = rule.root(rule.density[i]); });
}

template <class R, class B, class C>
void Engine<R, B, C>::set_samples(const Engine_samples& samples)
{
  m_cells = samples.cells;
  m_size = int(samples.size());
  m_has_patches = !samples.patches.empty();
  internal::allocate_listed(m_backend, *this, m_cells, m_size, m_has_patches, has_features());
  m_best.residual = std::numeric_limits<double>::infinity();
  forget_lbfgs();
  make_builder();
  m_constructions = 0;
  m_mean_mass = 0;
  m_are_edges_wanted = m_are_edges_known = false;
  sort(samples);
  m_backend.start_clock();
  update_attributes();
}

template <class R, class B, class C>
void Engine<R, B, C>::make_builder()
{
  const double radius = first_search_radius(m_options.neighbors, m_area_of_surface, m_size);
  m_builder.emplace(m_backend, m_size, m_cos_angle, R(radius), m_options);
}

template <class R, class B, class C>
C& Engine<R, B, C>::builder()
{
  if (!m_builder) {
    make_builder();
    m_builder->set_sites(sites());
  }
  return *m_builder;
}

/// The samples with cells along a space-filling curve. Those that only clip are not sorted, so that
/// their numbers stay.
template <class R, class B, class C>
void Engine<R, B, C>::sort(const Engine_samples& samples)
{
  const int n = m_cells, m = m_size;
  internal::Unset_vector<Site<R>> sites(m);
  internal::for_each_index(B::concurrency(), m, [&](int i) {
    sites[i] = {to_real<R>(samples.points[i]), R(0)};
  });
  m_backend.upload(m_sites.data(), sites.data(), m);
  Buffer<std::uint64_t> codes;
  Buffer<int> places;
  codes.allocate(m_backend, n);
  places.allocate(m_backend, n);
  const Box3<double> box = internal::box_around(B::concurrency(), m, samples.points);
  find_hilbert_codes(m_backend, n, m_sites.data(), box, codes.data());
  m_backend.sort_order(n, codes.data(), places.data(), true);
  internal::Unset_vector<int> order(m);
  std::iota(order.begin() + n, order.end(), n);
  m_backend.download(order.data(), places.data(), n);

  internal::Unset_vector<int> facets(m), patches(m_has_patches ? m : 0);
  internal::Unset_vector<Vec3<R>> normals(m);
  internal::Unset_vector<R> density(m);
  internal::for_each_index(B::concurrency(), m, [&](int i) {
    const int k = order[i];
    sites[i] = {to_real<R>(samples.points[k]), R(0)};
    facets[i] = samples.facets[k];
    normals[i] = to_real<R>(samples.normals[k]);
    density[i] = R(samples.density[k]);
    if (m_has_patches) patches[i] = samples.patches[k];
  });
  m_backend.upload(m_sites.data(), sites.data(), m);
  m_backend.upload(m_facets.data(), facets.data(), m);
  m_backend.upload(m_normals.data(), normals.data(), m);
  m_backend.upload(m_density.data(), density.data(), m);
  if (m_has_patches) m_backend.upload(m_patches.data(), patches.data(), m);
  if (has_features()) upload_boundaries(samples);
  find_density_roots(m_backend, m, attribute_rule());
}

template <class R, class B, class C>
void Engine<R, B, C>::upload_boundaries(const Engine_samples& samples)
{
  std::vector<int> previous(m_size, -1);
  for (int i = 0; i < m_size; ++i)
    if (samples.next[i] >= 0) previous[samples.next[i]] = i;
  m_backend.upload(m_next.data(), samples.next.data(), m_size);
  m_backend.upload(m_previous.data(), previous.data(), m_size);
}

/// Normals and densities of the samples where they are.
template <class R, class B, class C>
void Engine<R, B, C>::update_attributes()
{
  const Placed_attributes_rule<R> rule{attribute_rule(), m_sites.data(), m_facets.data()};
  if (rule.attributes.over_facet)
    m_backend.for_each_by_lanes(m_cells, rule);
  else
    m_backend.for_each_by_warps(m_cells, rule);
  set_sites();
}

template <class R, class B, class C>
void Engine<R, B, C>::set_sites()
{
  if (!m_builder) make_builder();
  m_builder->set_sites(sites());
  m_are_distances_known = m_are_components_known = m_is_left_out_known = false;
  m_has_newton_overshot = false;
  m_newton_goal = local_newton_goal;
  forget_summary();
}

template <class R, class B, class C>
Engine_samples Engine<R, B, C>::samples()
{
  Engine_samples s;
  s.cells = m_cells;
  internal::Unset_vector<Site<R>> sites(m_size);
  internal::Unset_vector<Vec3<R>> normals(m_size);
  internal::Unset_vector<R> density(m_size);
  s.facets.resize(m_size);
  m_backend.download(sites.data(), m_sites.data(), m_size);
  m_backend.download(normals.data(), m_normals.data(), m_size);
  m_backend.download(density.data(), m_density.data(), m_size);
  m_backend.download(s.facets.data(), m_facets.data(), m_size);
  if (m_has_patches) {
    s.patches.resize(m_size);
    m_backend.download(s.patches.data(), m_patches.data(), m_size);
  }
  for (auto v : {&s.points, &s.normals}) v->resize(m_size);
  for (auto v : {&s.weights, &s.density}) v->resize(m_size);
  internal::for_each_index(B::concurrency(), m_size, [&](int i) {
    s.points[i] = to_double(sites[i].point);
    s.weights[i] = sites[i].weight;
    s.normals[i] = to_double(normals[i]);
    s.density[i] = density[i];
  });
  return s;
}

template <class R, class B, class C>
std::vector<Cell_polygon> Engine<R, B, C>::cells()
{
  const Engine_samples s = samples();
  std::vector<Cell_polygon> cells(m_cells);
  builder().for_each_cell([&](int i, Cell_status status, const auto& polygon, const auto&) {
    cells[i] = cell_polygon(s, i, status, polygon);
  });
  return cells;
}

template <class R, class B, class C>
Neighbor_cycles Engine<R, B, C>::neighbors()
{
  finish_cells();
  forget_newton();
  Buffer<Site<R>> plain;
  plain.allocate(m_backend, m_size);
  copy_without_weights(m_backend, m_size, m_sites.data(), plain.data());
  Sites_arrays<R> in = sites();
  in.sites = plain.data();
  builder().set_weights(in);
  Neighbor_cycles neighbors = builder().neighbors();
  builder().set_weights(sites());
  return neighbors;
}

template <class R, class B, class C>
void Engine<R, B, C>::release_memory()
{
  finish_cells();
  forget_lbfgs();
  forget_newton();
  m_best = {};
  m_builder.reset();
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_ENGINE_SAMPLES_H
