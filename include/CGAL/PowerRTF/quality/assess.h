// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Judges an extracted mesh against the surface it stands for.
#ifndef CGAL_POWER_RTF_QUALITY_ASSESS_H
#define CGAL_POWER_RTF_QUALITY_ASSESS_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/compiled.h>

namespace CGAL::PowerRTF {

/// Fills the parts of `report` that describe the result: topology of both, self-intersections,
/// features, triangle quality and distance.
template <class ConcurrencyTag>
void assess(const Surface& surface, const Extracted_mesh& mesh, Remeshing_report& report);

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/quality/assess_impl.h>
#endif

#endif // CGAL_POWER_RTF_QUALITY_ASSESS_H
