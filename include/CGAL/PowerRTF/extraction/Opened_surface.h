// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces with one side only (a Moebius strip, a Klein bottle) and networks of sheets are opened
// along their seams and where they touch for the extraction, which needs an oriented 2-manifold,
// and sewn up again: a sample there is several vertices in between.
#ifndef CGAL_POWER_RTF_EXTRACTION_OPENED_SURFACE_H
#define CGAL_POWER_RTF_EXTRACTION_OPENED_SURFACE_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/extraction/Seam_places.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/internal/compiled.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// A surface cut along its seams and at its contacts, with its samples.
class Opened_surface {
public:
  /// `samples`: the last ones are those of `features`.
  Opened_surface(const Surface& surface, const Samples& samples, const Feature_samples& features);

  const Surface& surface() const { return m_surface; }
  const Samples& samples() const { return m_samples; }
  const Feature_samples& features() const { return m_features; }
  const Seam_places& seams() const { return m_seams; }

  /// Makes the points at each place one again.
  static void sew_up(Extracted_mesh& mesh);

private:
  void move_off_seams(std::size_t count);

  Surface m_surface;
  Samples m_samples;
  Feature_samples m_features;
  Seam_places m_seams;
};

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/extraction/Opened_surface_impl.h>
#endif

#endif // CGAL_POWER_RTF_EXTRACTION_OPENED_SURFACE_H
