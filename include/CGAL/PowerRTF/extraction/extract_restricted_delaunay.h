// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's extraction (Section 4.4, "Mesh Extraction", after [BL17]): the restricted Delaunay
// triangulation of the samples. A 2-manifold of the right topology where sampling is dense (Amenta
// and Bern 1999); on thin parts and close sheets it may be neither.
#ifndef CGAL_POWER_RTF_EXTRACTION_EXTRACT_RESTRICTED_DELAUNAY_H
#define CGAL_POWER_RTF_EXTRACTION_EXTRACT_RESTRICTED_DELAUNAY_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/internal/compiled.h>

namespace CGAL::PowerRTF {

/// The facets of the samples' Delaunay triangulation whose dual Voronoi edge meets `surface`,
/// oriented like the surface at their samples. May be non-manifold, miss samples or have another
/// topology than the surface where sampling is too coarse. Of samples at the same place only one
/// is used. `features`: the last samples; whether their edges are there is left to chance.
Extracted_mesh extract_restricted_delaunay(const Surface& surface, const Samples& samples,
                                           const Feature_samples& features = {});

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/extraction/extract_restricted_delaunay_impl.h>
#endif

#endif // CGAL_POWER_RTF_EXTRACTION_EXTRACT_RESTRICTED_DELAUNAY_H
