// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions for Surface_engine.h.
#ifndef CGAL_POWER_RTF_ENGINES_SURFACE_ENGINE_IMPL_H
#define CGAL_POWER_RTF_ENGINES_SURFACE_ENGINE_IMPL_H

#include <CGAL/PowerRTF/engines/Surface_engine.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/make_surface_in_tree.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

CGAL_POWER_RTF_INLINE
Surface_engine_base::Surface_engine_base(const Surface& surface, const Remeshing_options& options,
                                         Make make, internal::Concurrency concurrency,
                                         Arrange_facets&& arrange)
    : m_options(options), m_surface(surface), m_make(make), m_concurrency(concurrency),
      m_arrange(std::move(arrange))
{}

CGAL_POWER_RTF_INLINE Surface_engine_base::~Surface_engine_base() = default;

CGAL_POWER_RTF_INLINE Run_sizes Surface_engine_base::run_sizes(const Surface& surface,
                                                               const Remeshing_options& options)
{
  return {options.number_of_samples, surface.triangles.size(), surface.points.size(),
          !surface.facet_patches.empty(), has_uniform_density(surface)};
}

CGAL_POWER_RTF_INLINE Cell_counts Surface_engine_base::cell_counts() const
{
  const Cell_summary s = m_engine->summary();
  const auto count = [&](Cell_status status) { return std::size_t(s.counts[int(status)]); };
  Cell_counts counts;
  counts.ok = count(Cell_status::ok);
  counts.guarded = count(Cell_status::guarded);
  counts.empty = count(Cell_status::empty);
  counts.incomplete = count(Cell_status::incomplete);
  return counts;
}

CGAL_POWER_RTF_INLINE double Surface_engine_base::displacement() const
{
  return std::sqrt(m_engine->summary().displacement / m_surface.area);
}

CGAL_POWER_RTF_INLINE const Facet_tree& Surface_engine_base::facet_tree()
{
  if (!m_tree) m_tree = std::make_unique<Facet_tree>(m_surface, m_concurrency, m_arrange);
  return *m_tree;
}

CGAL_POWER_RTF_INLINE Engine_base& Surface_engine_base::engine()
{
  if (!m_engine) { // only now the surface's normals and density are what they will be
    m_in_tree = internal::make_surface_in_tree(m_surface, facet_tree(),
                                               asks_for_vertices(m_options), m_concurrency);
    m_engine = m_make(m_in_tree, m_options);
  }
  return *m_engine;
}

CGAL_POWER_RTF_INLINE Make_lattice_field Surface_engine_base::lattice_field_maker()
{
  return [this](const Lattice_plan& plan) { return engine().make_lattice_field(plan); };
}

CGAL_POWER_RTF_INLINE void Surface_engine_base::set_samples(const Samples& samples,
                                                            const Feature_samples& features)
{
  engine(); // makes the facets' tree, too
  m_size = samples.size();
  const bool are_all_free = features.sites.size() == 0;
  const Samples with_features = are_all_free ? Samples() : joined(samples, features.sites);
  const Samples& sites = are_all_free ? samples : with_features;
  m_sites = sites.size();
  Engine_samples to;
  const bool has_patches = !m_surface.facet_patches.empty();
  internal::call_at_once(
      m_concurrency, [&] { to.points.resize(m_sites); }, [&] { to.normals.resize(m_sites); },
      [&] { to.density.resize(m_sites); }, [&] { to.facets.resize(m_sites); },
      [&] { to.patches.resize(has_patches ? m_sites : 0); });
  internal::for_each_index(m_concurrency, int(m_sites), [&](int i) {
    const int f = sites.facets[i];
    to.points[i] = sites.points[i];
    to.normals[i] = sites.normals[i];
    to.density[i] = sites.density[i];
    to.facets[i] = m_tree->place(f);
    if (has_patches) to.patches[i] = m_surface.facet_patches[f];
  });
  to.cells = static_cast<int>(m_size);
  if (!are_all_free) {
    to.next.assign(sites.size(), -1);
    for (std::size_t k = 0; k < features.next.size(); ++k)
      if (features.next[k] >= 0) to.next[m_size + k] = static_cast<int>(m_size) + features.next[k];
  }
  m_engine->set_samples(to);
}

CGAL_POWER_RTF_INLINE Samples Surface_engine_base::gather(std::size_t count) const
{
  const Engine_samples from = m_engine->samples();
  Samples to;
  const auto resize = [&](auto& items, bool is_there) {
    if (is_there) internal::resize_in_parallel(m_concurrency, items, count);
  };
  internal::call_at_once(
      m_concurrency, [&] { resize(to.points, true); }, [&] { resize(to.normals, true); },
      [&] { resize(to.density, true); }, [&] { resize(to.weights, true); },
      [&] { resize(to.facets, true); }, [&] { resize(to.patches, !from.patches.empty()); });
  internal::for_each_index(m_concurrency, int(count), [&](int i) {
    to.points[i] = from.points[i];
    to.normals[i] = from.normals[i];
    to.density[i] = from.density[i];
    to.weights[i] = from.weights[i];
    to.facets[i] = m_tree->order()[from.facets[i]];
    if (!to.patches.empty()) to.patches[i] = from.patches[i];
  });
  return to;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_SURFACE_ENGINE_IMPL_H
