// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The member functions of `Engine` that take the samples in, and give samples and cells out.
#ifndef CGAL_POWER_RTF_ENGINES_ENGINE_SAMPLES_H
#define CGAL_POWER_RTF_ENGINES_ENGINE_SAMPLES_H

#include <CGAL/PowerRTF/engines/Engine.h>
#include <CGAL/PowerRTF/geometry/box_around.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF {

template <class Real, class Backend>
void copy_without_weights(Backend& backend, int n, const Site<Real>* from, Site<Real>* to)
{
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) { to[i] = {from[i].point, Real(0)}; });
}

/// Of those from number `first` on.
template <class Real, class Backend>
void find_density_roots(Backend& backend, int first, int n, const Attribute_rule<Real>& rule)
{
  backend.for_each(n - first, [=] CGAL_POWER_RTF_HD(int k) {
    rule.density_root[first + k] = rule.root(rule.density[first + k]);
  });
}

template <class R, class B, class C>
std::optional<std::size_t> Engine<R, B, C>::place_candidates(Lattice_field_base& field,
                                                             std::size_t n)
{
  m_placed = {};
  auto* const lattice = dynamic_cast<Lattice_field<B>*>(&field);
  if (!lattice) return std::nullopt;
  const std::optional<Buffer<Sample_candidate>> chosen = lattice->chosen_candidates(n);
  if (!chosen) return std::nullopt;
  const int size = static_cast<int>(n);
  const Sample_candidate* const candidates = chosen->data();
  internal::allocate_listed(m_backend, m_placed, n);
  m_placed.cube = lattice->cube();
  m_backend.for_each_by_lanes(size, Place_candidate_rule<R>{m_surface.view(), lattice->cube(),
                                                            candidates, m_placed.sites.data(),
                                                            m_placed.facets.data()});
  Buffer<unsigned char> is_off;
  Buffer<int> off;
  is_off.allocate(m_backend, n);
  off.allocate(m_backend, n);
  m_backend.for_each(size, Mark_off_lattice{candidates, is_off.data()});
  return static_cast<std::size_t>(m_backend.select(size, is_off.data(), off.data()));
}

template <class R, class B, class C>
int Engine<R, B, C>::set_samples(const Engine_samples& samples)
{
  if (samples.cells > 0) upload_cells(samples);
  m_cells = m_placed.size();
  m_size = m_cells + int(samples.size()) - samples.cells;
  m_has_patches = m_surface.view().patches != nullptr;
  internal::allocate_listed(m_backend, *this, m_cells, m_size, m_has_patches, has_features());
  m_best.residual = std::numeric_limits<double>::infinity();
  forget_lbfgs();
  make_builder();
  m_constructions = 0;
  m_mean_mass = 0;
  m_are_edges_wanted = m_are_edges_known = false;
  sort();
  if (has_features()) upload_others(samples);
  if (m_has_patches)
    m_backend.for_each(m_size,
                       Take_patches{m_surface.view().patches, m_facets.data(), m_patches.data()});
  m_backend.start_clock();
  update_attributes();
  return m_cells;
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

template <class R, class B, class C>
void Engine<R, B, C>::upload_cells(const Engine_samples& samples)
{
  internal::Unset_vector<Site<R>> sites(samples.cells);
  internal::for_each_index(B::concurrency(), samples.cells, [&](int i) {
    sites[i] = {to_real<R>(samples.points[i]), R(0)};
  });
  internal::allocate_listed(m_backend, m_placed, sites.size());
  m_placed.cube =
      cube_around(internal::box_around(B::concurrency(), int(samples.size()), samples.points));
  m_backend.upload(m_placed.sites.data(), sites.data(), sites.size());
  m_backend.upload(m_placed.facets.data(), samples.facets.data(), sites.size());
}

template <class R, class B, class C>
void Engine<R, B, C>::sort()
{
  Buffer<std::uint64_t> codes;
  Buffer<int> order;
  codes.allocate(m_backend, m_cells);
  order.allocate(m_backend, m_cells);
  m_backend.for_each(m_cells,
                     Find_hilbert_code<R>(m_placed.cube, m_placed.sites.data(), codes.data()));
  m_backend.sort_order(m_cells, codes.data(), order.data(), true);
  m_backend.for_each(m_cells, Take_in_order<R>{m_placed.sites.data(), m_placed.facets.data(),
                                               order.data(), m_sites.data(), m_facets.data()});
  m_placed = {};
}

/// The samples that only clip are not sorted, so that their numbers stay.
template <class R, class B, class C>
void Engine<R, B, C>::upload_others(const Engine_samples& samples)
{
  const int n = m_size - m_cells, first = samples.cells;
  internal::Unset_vector<Site<R>> sites(n);
  internal::Unset_vector<Vec3<R>> normals(n);
  internal::Unset_vector<R> density(n);
  std::vector<int> next(m_size, -1), previous(m_size, -1);
  for (int k = 0; k < n; ++k) {
    sites[k] = {to_real<R>(samples.points[first + k]), R(0)};
    normals[k] = to_real<R>(samples.normals[k]);
    density[k] = R(samples.density[k]);
    if (samples.next[k] < 0) continue;
    next[m_cells + k] = m_cells + samples.next[k];
    previous[m_cells + samples.next[k]] = m_cells + k;
  }
  m_backend.upload(m_sites.data() + m_cells, sites.data(), n);
  m_backend.upload(m_facets.data() + m_cells, samples.facets.data() + first, n);
  m_backend.upload(m_normals.data() + m_cells, normals.data(), n);
  m_backend.upload(m_density.data() + m_cells, density.data(), n);
  m_backend.upload(m_next.data(), next.data(), m_size);
  m_backend.upload(m_previous.data(), previous.data(), m_size);
  find_density_roots(m_backend, m_cells, m_size, attribute_rule());
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
Samples Engine<R, B, C>::samples()
{
  internal::Unset_vector<Site<R>> sites(m_size);
  internal::Unset_vector<Vec3<R>> normals(m_size);
  internal::Unset_vector<R> density(m_size);
  Samples s;
  const auto resize = [&](auto& items) {
    internal::resize_in_parallel(B::concurrency(), items, std::size_t(m_size));
  };
  internal::call_at_once(
      B::concurrency(), [&] { resize(s.points); }, [&] { resize(s.normals); },
      [&] { resize(s.density); }, [&] { resize(s.weights); }, [&] { resize(s.facets); },
      [&] { m_has_patches ? resize(s.patches) : void(); });
  m_backend.download(sites.data(), m_sites.data(), m_size);
  m_backend.download(normals.data(), m_normals.data(), m_size);
  m_backend.download(density.data(), m_density.data(), m_size);
  m_backend.download(s.facets.data(), m_facets.data(), m_size);
  if (m_has_patches) m_backend.download(s.patches.data(), m_patches.data(), m_size);
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
  const Samples s = samples();
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
