// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface as the samples live on it: in patches that end at creases and borders, with normals
// smoothed within each patch, and with the samples that creases and borders have of their own.
#ifndef CGAL_POWER_RTF_FEATURES_SURFACE_PATCHES_H
#define CGAL_POWER_RTF_FEATURES_SURFACE_PATCHES_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/fields/Surface_work.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

class Surface_patches {
public:
  /// Keeps a reference to `surface`, sets the grid of the result's points and replaces the vertex
  /// normals by the smoothed ones (the means over the patches at each vertex).
  /// \throws Invalid_input_error when there are too few samples for the topology, or for the
  ///   creases and borders, or too many for the output's coordinates
  /// \param work what is done where an engine works: it has the facets of `surface()`, and smooths
  ///   the normals
  Surface_patches(Surface& surface, const Remeshing_options& options,
                  internal::Concurrency concurrency = Sequential_tag(),
                  const Surface_work& work = {});

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
  /// What is done to `surface()` once its facets are what they will be.
  static void finish(Surface& surface, const Remeshing_options& options,
                     internal::Concurrency concurrency, const Surface_work& work);
  /// Gives the features' sites facets that have been split: any part of theirs lies on their patch.
  void place_features();

  const Surface& m_whole;
  std::optional<Surface> m_own; ///< none: the whole surface is one patch as it is
  std::vector<int> m_parents;   ///< of the facets of `m_own`; empty: these are the whole one's
  Feature_samples
      m_features; ///< the samples have facets of the whole surface, the sites of `m_own`
};

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/features/Surface_patches_impl.h>
#endif

#endif // CGAL_POWER_RTF_FEATURES_SURFACE_PATCHES_H
