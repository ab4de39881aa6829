// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves the vertices, off the surface too, so that the triangles come near to it; see
// Fit_equations.h. With all vertices on the surface, a curved part has all triangles on one side of
// it: to move along the normals halves the mean distance.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_FIT_TO_SURFACE_H
#define CGAL_POWER_RTF_IMPROVEMENT_FIT_TO_SURFACE_H

#include <CGAL/PowerRTF/features/flat_patches.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>

namespace CGAL::PowerRTF::internal {

/// What `Star_sweeps_base::fit()` has to know to fit `mesh` to its surface, of which `flat` is.
/// `tracker`: of the surface's vertices. `badness_limit`: that a move may bring upon a triangle
/// that was better.
inline Flat_fit flat_fit(const Star_mesh& mesh, const Distance_tracker& tracker,
                         const Flat_patches& flat, double badness_limit)
{
  using Parameters = Improvement_parameters::Fitting;
  const Surface& surface = mesh.projector().surface();
  Flat_fit fit;
  const double density =
      std::min(1., double(tracker.size()) / (Parameters::fully_tracked * double(mesh.size())));
  fit.tracked_weight = Parameters::tracked_weight * density * density;
  fit.tangential_weight = has_uniform_density(surface) ? Parameters::even_tangential_weight
                                                       : Parameters::tangential_weight;
  fit.badness_limit = badness_limit;
  fit.tracked.resize(tracker.size());
  for_each_index(mesh.concurrency(), tracker.size(), [&](int i) {
    const Tracked_point& w = tracker[i];
    int near = -1;
    for (const Star_mesh::Vertex v : mesh.working().corners(w.face))
      if (mesh.is_movable(v)) near = int(v);
    fit.tracked[i] = {w.vertex, w.facet, near, w.weight};
  });
  const double width = Parameters::flat_width * std::sqrt(surface.area / double(mesh.size()));
  fit.is_wide.resize(surface.triangles.size());
  for_each_index(mesh.concurrency(), int(fit.is_wide.size()),
                 [&](int f) { fit.is_wide[f] = flat.width(f) > width; });
  return fit;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_FIT_TO_SURFACE_H
