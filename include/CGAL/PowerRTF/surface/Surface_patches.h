// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface as the samples live on it: in patches that end at creases and borders, with normals
// smoothed within each patch, and with the samples that creases and borders have of their own.
#ifndef CGAL_POWER_RTF_SURFACE_SURFACE_PATCHES_H
#define CGAL_POWER_RTF_SURFACE_SURFACE_PATCHES_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/surface/feature_samples.h>
#include <CGAL/PowerRTF/surface/output_grid.h>
#include <CGAL/PowerRTF/surface/smooth_normals.h>
#include <CGAL/PowerRTF/surface/topology_minimum.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace PowerRTF {

class Surface_patches {
public:
  /// Keeps a reference to `surface`, sets the grid of the result's points and replaces the vertex
  /// normals by the smoothed ones (the means over the patches at each vertex).
  /// \throws Invalid_input_error when there are too few samples for the topology, or for the creases
  ///   and borders, or too many for the output's coordinates
  Surface_patches(Surface& surface, const Remeshing_options& options) : m_whole(surface)
  {
    const std::size_t n = options.number_of_samples;
    require_enough_samples(surface, n);
    set_output_grid(surface, options);
    const Facet_adjacency adjacency = facet_adjacency(surface.triangles, surface.points.size());
    if (surface.creases.empty() && adjacency.border_edges == 0 &&
        facet_components(adjacency).second == 1) {
      smooth_normals(surface, n, options.normal_smoothing);
      return;
    }
    m_cut = cut_along_creases(surface);
    m_features = sample_features(surface, m_cut, n);
    smooth_normals(m_cut.surface, n, options.normal_smoothing);
    surface.vertex_normals.assign(surface.points.size(), {0, 0, 0});
    for (std::size_t v = 0; v < m_cut.originals.size(); ++v)
      surface.vertex_normals[m_cut.originals[v]] += m_cut.surface.vertex_normals[v];
    internal::mend_vertex_normals(surface);
  }

  Surface_patches(const Surface_patches&) = delete;
  Surface_patches& operator=(const Surface_patches&) = delete;

  /// The surface cut along its creases; its facets are those of the whole one.
  const Surface& surface() const { return m_cut.originals.empty() ? m_whole : m_cut.surface; }
  const Feature_samples& features() const { return m_features; }

private:
  const Surface& m_whole;
  Cut_surface m_cut; ///< empty: the surface is one patch without boundary
  Feature_samples m_features;
};

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_SURFACE_SURFACE_PATCHES_H
