// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface as the samples live on it: in patches that end at creases and borders, with normals
// smoothed within each patch, and with the samples that creases and borders have of their own.
#ifndef CGAL_POWER_RTF_FEATURES_SURFACE_PATCHES_H
#define CGAL_POWER_RTF_FEATURES_SURFACE_PATCHES_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/features/feature_samples.h>
#include <CGAL/PowerRTF/features/split_bent_facets.h>
#include <CGAL/PowerRTF/features/topology_minimum.h>
#include <CGAL/PowerRTF/fields/smooth_normals.h>
#include <CGAL/PowerRTF/geometry/output_grid.h>

#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

class Surface_patches {
public:
  /// Keeps a reference to `surface`, sets the grid of the result's points and replaces the vertex
  /// normals by the smoothed ones (the means over the patches at each vertex).
  /// \throws Invalid_input_error when there are too few samples for the topology, or for the
  /// creases
  ///   and borders, or too many for the output's coordinates
  Surface_patches(Surface& surface, const Remeshing_options& options) : m_whole(surface)
  {
    const std::size_t n = options.number_of_samples;
    require_enough_samples(surface, n);
    set_output_grid(surface, options);
    const bool is_one_patch = surface.creases.empty() && surface.adjacency.border_edges == 0 &&
                              facet_components(surface.adjacency).second == 1;
    // Means over the nearest vertices would depend on how finely a facet is split.
    const bool splits = options.attributes == Attributes::facet;
    if (is_one_patch && !(splits && has_long_bent_facets(surface, n))) {
      smooth_normals(surface, n, options.normal_smoothing);
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
    if (splits) m_parents = split_bent_facets(*m_own, n);
    place_features();
    smooth_normals(*m_own, n, options.normal_smoothing);
    surface.vertex_normals.assign(surface.points.size(), {0, 0, 0});
    for (std::size_t v = 0; v < originals.size(); ++v)
      surface.vertex_normals[originals[v]] += m_own->vertex_normals[v];
    internal::mend_vertex_normals(surface);
  }

  Surface_patches(const Surface_patches&) = delete;
  Surface_patches& operator=(const Surface_patches&) = delete;

  /// The surface cut along its creases, its long bent facets split.
  const Surface& surface() const { return m_own ? *m_own : m_whole; }
  const Feature_samples& features() const { return m_features; }

  /// Samples on `surface()` with the facets of the whole surface.
  Samples on_whole(Samples samples) const
  {
    if (!m_parents.empty())
      for (int& f : samples.facets) f = m_parents[f];
    return samples;
  }

private:
  /// Gives the features' sites facets that have been split: any part of theirs lies on their patch.
  void place_features()
  {
    if (m_parents.empty()) return;
    std::vector<int> parts(m_whole.triangles.size());
    for (std::size_t f = m_parents.size(); f-- > 0;) parts[m_parents[f]] = static_cast<int>(f);
    for (int& f : m_features.sites.facets) f = parts[f];
  }

  const Surface& m_whole;
  std::optional<Surface> m_own; ///< none: the whole surface is one patch as it is
  std::vector<int> m_parents;   ///< of the facets of `m_own`; empty: these are the whole one's
  Feature_samples
      m_features; ///< the samples have facets of the whole surface, the sites of `m_own`
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_SURFACE_PATCHES_H
