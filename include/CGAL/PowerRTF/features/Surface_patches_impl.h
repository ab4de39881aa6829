// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions for Surface_patches.h.
#ifndef CGAL_POWER_RTF_FEATURES_SURFACE_PATCHES_IMPL_H
#define CGAL_POWER_RTF_FEATURES_SURFACE_PATCHES_IMPL_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/features/Surface_patches.h>
#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/features/split_bent_facets.h>
#include <CGAL/PowerRTF/fields/smooth_normals.h>
#include <CGAL/PowerRTF/geometry/component_topology.h>
#include <CGAL/PowerRTF/geometry/cut_surface.h>
#include <CGAL/PowerRTF/geometry/output_grid.h>

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

CGAL_POWER_RTF_INLINE
Surface_patches::Surface_patches(Surface& surface, const Remeshing_options& options,
                                 internal::Concurrency concurrency, const Surface_work& work)
    : m_whole(surface)
{
  const std::size_t n = options.number_of_samples;
  if (!surface.is_closed_up())
    surface.topology.value = internal::known_topology(surface, concurrency);
  if (surface.adjacency.non_manifold_edges == 0 &&
      surface.contacts.empty()) // else its curves tell how many they need
    require_enough_samples(surface, n, concurrency);
  set_output_grid(surface, options);
  const bool is_one_patch = surface.creases.empty() && surface.contacts.empty() &&
                            surface.kept_vertices.empty() && surface.adjacency.border_edges == 0 &&
                            surface.topology.value && surface.topology.value->size() == 1;
  // Means over the nearest vertices would depend on how finely a facet is split.
  const bool splits = options.attributes == Attributes::facet;
  if (is_one_patch && !(splits && has_long_bent_facets(surface, n, concurrency))) {
    finish(surface, options, concurrency, work);
    return;
  }
  std::vector<int> originals; // of the vertices of the patches
  if (is_one_patch) {
    m_own = surface;
    originals.resize(surface.points.size());
    std::iota(originals.begin(), originals.end(), 0);
  } else {
    Cut_surface cut = cut_along_creases(surface);
    m_features = sample_features(surface, cut, n);
    m_own = std::move(cut.surface);
    originals = std::move(cut.originals);
  }
  if (splits) m_parents = split_bent_facets(*m_own, n, concurrency);
  place_features();
  finish(*m_own, options, concurrency, work);
  surface.vertex_normals.assign(surface.points.size(), {0, 0, 0});
  for (std::size_t v = 0; v < originals.size(); ++v)
    surface.vertex_normals[originals[v]] += m_own->vertex_normals[v];
  internal::mend_vertex_normals(surface, concurrency);
}

CGAL_POWER_RTF_INLINE void Surface_patches::finish(Surface& surface,
                                                   const Remeshing_options& options,
                                                   internal::Concurrency concurrency,
                                                   const Surface_work& work)
{
  if (work.bring_facets) work.bring_facets(surface);
  smooth_normals(surface, options.number_of_samples, options.normal_smoothing, concurrency,
                 work.diffuse_normals);
}

CGAL_POWER_RTF_INLINE void Surface_patches::place_features()
{
  if (m_parents.empty() || m_features.sites.facets.empty()) return;
  std::vector<int> parts(m_whole.triangles.size());
  for (std::size_t f = m_parents.size(); f-- > 0;) parts[m_parents[f]] = static_cast<int>(f);
  for (int& f : m_features.sites.facets) f = parts[f];
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_SURFACE_PATCHES_IMPL_H
