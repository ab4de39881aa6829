// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Judges an extracted mesh against the surface it stands for.
#ifndef CGAL_POWER_RTF_QUALITY_ASSESS_H
#define CGAL_POWER_RTF_QUALITY_ASSESS_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/quality/self_intersections.h>
#include <CGAL/PowerRTF/quality/surface_distance.h>
#include <CGAL/PowerRTF/quality/topology.h>
#include <CGAL/PowerRTF/quality/triangle_quality.h>

namespace CGAL {
namespace PowerRTF {

/// Fills the parts of `report` that describe the result: topology of both, self-intersections,
/// triangle quality and distance.
template <class ConcurrencyTag>
void assess(const Surface& surface, const Extracted_mesh& mesh, Remeshing_report& report)
{
  report.input_topology = topology(surface.triangles);
  report.topology = topology(mesh.triangles);
  report.self_intersections = self_intersections(mesh.points, mesh.triangles);
  report.quality = triangle_quality(mesh.points, mesh.triangles);
  report.distance = surface_distance<ConcurrencyTag>(surface.points, surface.triangles, mesh.points,
                                                     mesh.triangles);
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_QUALITY_ASSESS_H
