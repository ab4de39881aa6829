// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Judges an extracted mesh against the surface it stands for.
#ifndef CGAL_POWER_RTF_QUALITY_ASSESS_H
#define CGAL_POWER_RTF_QUALITY_ASSESS_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>

namespace CGAL::PowerRTF {

class Facet_tree;

/// Fills the parts of `report` that describe the result: topology of both, self-intersections,
/// features, triangle quality and distance. The numbers are the same for every `concurrency`. The
/// topology of `surface` stays as it is in `report`, if it is there.
///
/// \param patches the surface as it is, or cut along its creases
/// \param tree of the facets of `patches`
/// \param bring brings meshes to where an engine works, whose surface is `patches`; or is empty
void assess(const Surface& surface, const Surface& patches, const Facet_tree& tree,
            const Extracted_mesh& mesh, Remeshing_report& report,
            internal::Concurrency concurrency = Sequential_tag(), const Bring_mesh& bring = {});

/// The same with a tree of its own.
void assess(const Surface& surface, const Extracted_mesh& mesh, Remeshing_report& report,
            internal::Concurrency concurrency = Sequential_tag());

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/quality/assess_impl.h>
#endif

#endif // CGAL_POWER_RTF_QUALITY_ASSESS_H
