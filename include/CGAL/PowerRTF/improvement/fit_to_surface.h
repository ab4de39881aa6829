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
#include <CGAL/PowerRTF/improvement/flat_stars.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Surface_fitter {
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Edge = Star_mesh::Edge;
  using Face = Working_mesh::Face;

  /// `flat`: of the surface. `limit`: the badness that a move may bring upon a triangle that was
  /// better.
  Surface_fitter(Star_mesh& mesh, const Distance_tracker& tracker, const Flat_patches& flat,
                 double limit)
      : m(mesh), m_tracker(tracker), m_flat(flat), m_badness_limit(limit)
  {}

  /// \returns the vertices that are left doubtful.
  std::vector<int> run(Mesh_sweeper& sweeper) const
  {
    return sweeper.fit([this](const Unset_vector<int>& first) { return equations(first); });
  }

  /// What `Star_sweeps_base::fit()` has to know. `first_spokes`: of each vertex, and the end.
  Flat_fit equations(const Unset_vector<int>& first_spokes) const
  {
    const Surface& surface = m.projector().surface();
    Flat_fit fit;
    const double density =
        std::min(1., double(m_tracker.size()) / (Parameters::fully_tracked * double(m.size())));
    fit.tracked_weight = Parameters::tracked_weight * density * density;
    fit.tangential_weight = has_uniform_density(surface) ? Parameters::even_tangential_weight
                                                         : Parameters::tangential_weight;
    fit.badness_limit = m_badness_limit;
    add_mesh(first_spokes, fit);
    add_tracked(fit);
    const double width = Parameters::flat_width * std::sqrt(surface.area / double(m.size()));
    fit.is_wide.resize(surface.triangles.size());
    for_each_index(m.concurrency(), int(fit.is_wide.size()),
                   [&](int f) { fit.is_wide[f] = m_flat.width(f) > width; });
    return fit;
  }

private:
  using Parameters = Improvement_parameters::Fitting;

  void add_mesh(const Unset_vector<int>& first_spokes, Flat_fit& fit) const
  {
    const auto& mesh = m.working().mesh;
    fit.heights.resize(m.size());
    for_each_index(m.concurrency(), int(m.size()),
                   [&](int v) { fit.heights[v] = m.height(Vertex(v)); });
    for (auto array : {&fit.spoke_edges, &fit.spoke_faces}) array->resize(first_spokes.back());
    for_each_spoke(m, first_spokes, [&](int k, Halfedge h) {
      fit.spoke_edges[k] = int(mesh.edge(h));
      fit.spoke_faces[k] = int(mesh.face(h));
    });
    fit.corners.resize(3 * mesh.num_faces());
    for_each_index(m.concurrency(), int(mesh.num_faces()), [&](int f) {
      const auto corners = m.working().corners(Face(f));
      std::copy(corners.begin(), corners.end(), &fit.corners[3 * std::size_t(f)]);
    });
    fit.edges.resize(mesh.num_edges());
    for_each_index(m.concurrency(), int(mesh.num_edges()), [&](int e) {
      const Halfedge h = mesh.halfedge(Edge(e), 0), o = mesh.halfedge(Edge(e), 1);
      const auto face = [&](Halfedge h) { return mesh.is_border(h) ? -1 : int(mesh.face(h)); };
      fit.edges[e] = {int(mesh.source(h)), int(mesh.target(h)), face(h), face(o)};
    });
  }

  void add_tracked(Flat_fit& fit) const
  {
    const int faces = fit.faces();
    fit.first_tracked.resize(faces + 1);
    fit.first_tracked[faces] = 0;
    for_each_index(m.concurrency(), faces,
                   [&](int f) { fit.first_tracked[f] = int(m_tracker.at_face(Face(f)).size()); });
    exclusive_scan(m.concurrency(), faces + 1, fit.first_tracked.data());
    fit.tracked.resize(m_tracker.size());
    for_each_index(m.concurrency(), faces, [&](int f) {
      int k = fit.first_tracked[f];
      for (const int i : m_tracker.at_face(Face(f))) {
        const auto& w = m_tracker[i];
        fit.tracked[k++] = {
            m_tracker.point(i), m_tracker.normal(i), w.nearest, w.distance, w.weight, w.facet};
      }
    });
  }

  Star_mesh& m;
  const Distance_tracker& m_tracker;
  const Flat_patches& m_flat;
  double m_badness_limit;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_FIT_TO_SURFACE_H
