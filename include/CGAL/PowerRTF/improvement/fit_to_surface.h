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
#include <CGAL/PowerRTF/improvement/Mesh_sweeper.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Surface_fitter {
public:
  using Vertex = Star_mesh::Vertex;

  /// `flat`: of the surface. `limit`: the badness that a move may bring upon a triangle that was
  /// better.
  Surface_fitter(Star_mesh& mesh, const Distance_tracker& tracker, const Flat_patches& flat,
                 double limit)
      : m(mesh), m_tracker(tracker), m_flat(flat), m_badness_limit(limit)
  {}

  /// \returns the vertices that are left doubtful.
  std::vector<int> run(Mesh_sweeper& sweeper) const { return sweeper.fit(equations()); }

  /// What `Star_sweeps_base::fit()` has to know.
  Flat_fit equations() const
  {
    const Surface& surface = m.projector().surface();
    Flat_fit fit;
    const double density =
        std::min(1., double(m_tracker.size()) / (Parameters::fully_tracked * double(m.size())));
    fit.tracked_weight = Parameters::tracked_weight * density * density;
    fit.tangential_weight = has_uniform_density(surface) ? Parameters::even_tangential_weight
                                                         : Parameters::tangential_weight;
    fit.badness_limit = m_badness_limit;
    fit.heights.resize(m.size());
    for_each_index(m.concurrency(), int(m.size()),
                   [&](int v) { fit.heights[v] = m.height(Vertex(v)); });
    add_tracked(fit);
    const double width = Parameters::flat_width * std::sqrt(surface.area / double(m.size()));
    fit.is_wide.resize(surface.triangles.size());
    for_each_index(m.concurrency(), int(fit.is_wide.size()),
                   [&](int f) { fit.is_wide[f] = m_flat.width(f) > width; });
    return fit;
  }

private:
  using Parameters = Improvement_parameters::Fitting;

  void add_tracked(Flat_fit& fit) const
  {
    const int n = m_tracker.size();
    fit.tracked.resize(n);
    fit.tracked_corners.resize(3 * std::size_t(n));
    for_each_index(m.concurrency(), n, [&](int i) {
      const auto& w = m_tracker[i];
      fit.tracked[i] = {
          m_tracker.point(i), m_tracker.normal(i), w.nearest, w.distance, w.weight, w.facet};
      const auto corners = m.working().corners(w.face);
      std::copy(corners.begin(), corners.end(), &fit.tracked_corners[3 * std::size_t(i)]);
    });
  }

  Star_mesh& m;
  const Distance_tracker& m_tracker;
  const Flat_patches& m_flat;
  double m_badness_limit;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_FIT_TO_SURFACE_H
