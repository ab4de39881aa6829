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

#include <algorithm>
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

CGAL_POWER_RTF_INLINE Place_candidates Surface_engine_base::candidate_placer()
{
  return [this](Lattice_field_base& field, std::size_t n) {
    return engine().place_candidates(field, n);
  };
}

CGAL_POWER_RTF_INLINE void Surface_engine_base::set_samples(const Samples& samples,
                                                            const Feature_samples& features)
{
  engine(); // makes the facets' tree, too
  const std::size_t n = samples.size();
  const Samples& sites = features.sites;
  Engine_samples to;
  to.cells = static_cast<int>(n);
  internal::call_at_once(
      m_concurrency, [&] { to.points.resize(n + sites.size()); },
      [&] { to.facets.resize(n + sites.size()); });
  internal::for_each_index(m_concurrency, int(to.size()), [&](int i) {
    const Samples& from = i < to.cells ? samples : sites;
    const int k = i < to.cells ? i : i - to.cells;
    to.points[i] = from.points[k];
    to.facets[i] = m_tree->place(from.facets[k]);
  });
  to.normals.assign(sites.normals.begin(), sites.normals.end());
  to.density.assign(sites.density.begin(), sites.density.end());
  to.next = features.next;
  m_size = static_cast<std::size_t>(m_engine->set_samples(to));
  m_sites = m_size + sites.size();
}

CGAL_POWER_RTF_INLINE Samples Surface_engine_base::gather(std::size_t count) const
{
  Samples samples = m_engine->samples();
  const auto cut = [&](auto&... items) { ((items.resize((std::min)(items.size(), count))), ...); };
  cut(samples.points, samples.facets, samples.normals, samples.density, samples.weights,
      samples.patches);
  internal::for_each_index(m_concurrency, int(count),
                           [&](int i) { samples.facets[i] = m_tree->order()[samples.facets[i]]; });
  return samples;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_SURFACE_ENGINE_IMPL_H
