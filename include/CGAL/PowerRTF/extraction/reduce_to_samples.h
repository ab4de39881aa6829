// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the surface with inserted samples to triangles on the samples.
#ifndef CGAL_POWER_RTF_EXTRACTION_REDUCE_TO_SAMPLES_H
#define CGAL_POWER_RTF_EXTRACTION_REDUCE_TO_SAMPLES_H

#include <CGAL/PowerRTF/extraction/decimate.h>
#include <CGAL/PowerRTF/extraction/delaunay_flips.h>
#include <CGAL/PowerRTF/extraction/remove_intersections.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// Removes the vertices that are no samples, makes the edges Delaunay and removes
/// self-intersections.
/// \returns the number of vertices and self-intersections that could not be removed.
inline std::size_t reduce_to_samples(Working_mesh& mesh)
{
  // While the mesh is fine, normals that differ by more than 84 degrees are a fold; among the
  // samples alone even 134 degrees occur on thin parts, and refusing more costs good triangles.
  Progress_part part(0.1);
  Edge_flipper careful_flipper(mesh, 0.1);
  careful_flipper.push_around_samples();
  careful_flipper.run(20 * mesh.mesh.number_of_edges());
  part.next(0.7);
  const std::size_t rest = Decimator(mesh, careful_flipper).run();
  part.next(0.85);
  Edge_flipper flipper(mesh, -0.7);
  for (const auto e : mesh.mesh.edges()) flipper.push(e);
  flipper.run(20 * mesh.mesh.number_of_edges());
  part.next(1);
  return rest + Intersection_remover(mesh, flipper).run();
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_REDUCE_TO_SAMPLES_H
