// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vertices whose collapse leaves the best triangles are tried first. One is taken out if the
// triangles around it, once they are optimized, are good and near enough to the surface. One that
// was tried in vain is tried again when something around it has changed.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_COARSEN_MESH_IMPL_H
#define CGAL_POWER_RTF_IMPROVEMENT_COARSEN_MESH_IMPL_H

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/improvement/Changed_vertices.h>
#include <CGAL/PowerRTF/improvement/Far_places.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/Surface_projector.h>
#include <CGAL/PowerRTF/improvement/Vertex_mover.h>
#include <CGAL/PowerRTF/improvement/coarsen_mesh.h>
#include <CGAL/PowerRTF/improvement/optimize_bad_triangles.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

class Mesh_coarsener {
public:
  /// `distance`: that is to be kept.
  Mesh_coarsener(Star_mesh& mesh, double distance)
      : m(mesh), m_optimizer(mesh), m_far(mesh, distance),
        m_mover(mesh, m_optimizer, Parameters::min_agreement, Parameters::max_collapse_badness),
        m_was_tried(mesh.size(), false)
  {
    m_mover.tolerate(Parameters::max_badness);
  }

  /// \returns the number of vertices that were taken out.
  std::size_t run()
  {
    m_far.update();
    std::size_t taken = 0;
    for (std::size_t before = 1; taken != std::exchange(before, taken);)
      for (const Vertex v : m_mover.find_spare())
        if (m.working().has_edges(v) && !m_was_tried[v] && take(v)) ++taken;
    return taken;
  }

private:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Parameters = Improvement_parameters::Coarsening;

  bool take(Vertex v)
  {
    Cancellation::poll();
    const Halfedge h = m_mover.collapse_of(v);
    if (h.is_valid() && is_near(v, m.working().mesh.target(h))) {
      const Vec3d p = m.point(v);
      Star_mesh::Checkpoint before(m);
      if (m_mover.remove(h) && m_far.are_changes_near() && !m_mover.intersects_near(p)) {
        for (const Vertex w : vertices_around(m, m_far.update())) m_was_tried[w] = false;
        return true;
      }
      before.restore();
      m_far.skip_update();
    }
    m_was_tried[v] = true;
    return false;
  }

  // Whether the surface at the star of `v` would be near enough to what a collapse into `target`
  // leaves, or nearly so.
  bool is_near(Vertex v, Vertex target) const
  {
    const double most = Parameters::hopeless * m_far.goal();
    const Star star = m.star(v);
    const Vec3d t = m.point(target);
    const auto reaches = [&](const Vec3d& p) {
      return std::any_of(star.corners.begin(), star.corners.end(), [&](const Star::Corner& c) {
        return c.vertex_a != target && c.vertex_b != target &&
               squared_length(nearest_point_on_triangle(p, t, c.a, c.b) - p) <= most * most;
      });
    };
    const auto& mesh = m.working().mesh;
    for (const Halfedge h : halfedges_around_target(v, mesh))
      for (const int i : m_far.tracker().at_face(mesh.face(h)))
        if (!reaches(m_far.tracker().point(i))) return false;
    return true;
  }

  Star_mesh& m;
  Bad_triangle_optimizer m_optimizer;
  Far_places m_far;
  Vertex_mover m_mover;
  std::vector<char> m_was_tried; // by vertex: in vain, and what is around it has not changed
};

/// Takes the points out that no triangle has.
inline void remove_lone_points(Extracted_mesh& mesh)
{
  std::vector<int> number(mesh.points.size(), -1);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) number[v] = 0;
  int n = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    mesh.points[n] = mesh.points[v];
    if (v < mesh.input_points.size()) mesh.input_points[n] = mesh.input_points[v];
    number[v] = n++;
  }
  mesh.points.resize(n);
  if (std::size_t(n) < mesh.input_points.size()) mesh.input_points.resize(n);
  for (Triangle& t : mesh.triangles)
    for (int& v : t) v = number[v];
  for (Edge& e : mesh.feature_edges) e = {number[e[0]], number[e[1]]};
}

} // namespace internal

CGAL_POWER_RTF_INLINE std::size_t coarsen_mesh(const Surface& surface, const Facet_tree& tree,
                                               Extracted_mesh& mesh, double distance,
                                               internal::Concurrency concurrency)
{
  if (mesh.triangles.empty()) return 0;
  const internal::Surface_projector projector(surface, tree);
  std::size_t taken = 0;
  try {
    internal::Star_mesh stars(mesh, projector, {}, concurrency);
    taken = internal::Mesh_coarsener(stars, distance).run();
    if (taken > 0) stars.write(mesh);
  } catch (const Invalid_input_error&) { // it is no manifold
  }
  if (taken == 0) return 0;
  internal::remove_lone_points(mesh);
  mesh.sort_triangles(concurrency);
  return taken;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_IMPROVEMENT_COARSEN_MESH_IMPL_H
