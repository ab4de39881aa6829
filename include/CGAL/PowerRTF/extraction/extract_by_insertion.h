// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From samples to triangles with a guaranteed topology: insertion, decimation, Delaunay flips,
// removal of self-intersections.
#ifndef CGAL_POWER_RTF_EXTRACTION_EXTRACT_BY_INSERTION_H
#define CGAL_POWER_RTF_EXTRACTION_EXTRACT_BY_INSERTION_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/extraction/Seam_places.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/internal/compiled.h>

namespace CGAL::PowerRTF {

/// A mesh on the samples that is homeomorphic to `surface`: an oriented 2-manifold with the same
/// components, borders and Euler characteristic, whatever the samples are. Where sampling is dense
/// its triangles are those of the restricted Delaunay triangulation. The result does not depend on
/// the samples' order.
///
/// The points are the samples, in their order. Where they are too sparse for the surface (a thin
/// part, close sheets, a small handle, a component without samples) vertices of the surface have to
/// stay, so that nothing is lost and nothing intersects: each takes the number of a sample that the
/// mesh can do without elsewhere, so that there are still as many points. Only if there are too few
/// samples for that altogether, points come after them.
///
/// Of several samples at one point all but the first may move into their facets.
///
/// `features`: the last samples; edges between those that are next to each other on a curve stay.
/// Without it borders recede to the samples.
///
/// `seams`: the vertices and samples that will be one (see `Opened_surface`).
///
/// \pre `surface` is an oriented 2-manifold
/// \throw Invalid_input_error if it is not, or if a sample lies on no facet
Extracted_mesh extract_by_insertion(const Surface& surface, const Samples& samples,
                                    const Feature_samples& features = {},
                                    const Seam_places& seams = {});

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/extraction/extract_by_insertion_impl.h>
#endif

#endif // CGAL_POWER_RTF_EXTRACTION_EXTRACT_BY_INSERTION_H
