// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes whose vertices are to be swept over, and what becomes of them.
#ifndef CGAL_POWER_RTF_TEST_SWEEPS_CASE_H
#define CGAL_POWER_RTF_TEST_SWEEPS_CASE_H

#include "improvement_case.h"

#include <CGAL/PowerRTF/features/flat_patches.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Host_star_sweeps.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/Surface_projector.h>
#include <CGAL/PowerRTF/improvement/fit_to_surface.h>
#include <CGAL/PowerRTF/improvement/flat_stars.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace improvement_case {

class Sweeps_case {
public:
  using Stars = internal::Swept_vertices;

  Sweeps_case(const shapes::Soup& soup, std::size_t n) : Sweeps_case(make_case(soup, n, 1)) {}
  explicit Sweeps_case(Case c)
      : m_case(std::move(c)), m_tree(m_case.surface.points, m_case.surface.triangles),
        m_projector(m_case.surface, m_tree), m_mesh(m_case.raw, m_projector)
  {}

  const internal::Star_mesh& mesh() const { return m_mesh; }
  const Surface& surface() const { return m_case.surface; }
  double spacing() const { return std::sqrt(m_case.surface.area / double(m_mesh.size())); }

  std::unique_ptr<Star_sweeps_base> host_sweeps(internal::Concurrency concurrency) const
  {
    return internal::make_host_star_sweeps(m_projector.descent(), grid(), concurrency);
  }
  std::unique_ptr<Star_sweeps_base> sweeps(const Make_star_sweeps& make) const
  {
    return make(m_projector.descent(), grid());
  }

  Stars smoothed(Star_sweeps_base& sweeps, int steps) const
  {
    Stars swept;
    if (!sweeps.take(flat_stars(m_mesh))) return swept;
    sweeps.smooth(steps);
    sweeps.read(swept);
    return swept;
  }
  /// `gain`: becomes the mean distance of the surface's vertices before, over that after.
  Stars fitted(Star_sweeps_base& sweeps, double& gain) const
  {
    internal::Star_mesh mesh = m_mesh;
    internal::Distance_tracker tracker(
        mesh, internal::tracked_points(m_case.surface, mesh.projector().tree(), mesh.size(),
                                       mesh.concurrency()));
    const double before = mean_distance(tracker);
    const Flat_patches flat(m_case.surface);
    Stars swept;
    if (!sweeps.take(flat_stars(mesh)) || !sweeps.fit(flat_fit(mesh, tracker, flat, 0.3)))
      return swept;
    sweeps.read(swept);
    mesh.move_all(swept);
    tracker.update();
    gain = before / mean_distance(tracker);
    return swept;
  }

  int vertices_of_surface() const { return int(m_case.surface.points.size()); }
  int faces() const { return int(m_case.raw.triangles.size()); }
  /// The faces that are nearest to the surface's vertices, as an engine finds them; none where it
  /// does not.
  internal::Unset_vector<int> nearest_faces(const Bring_mesh& bring) const
  {
    using Projection = internal::Improvement_parameters::Projection;
    internal::Unset_vector<int> nearest(vertices_of_surface());
    std::iota(nearest.begin(), nearest.end(), 0);
    const std::shared_ptr<Resident_mesh> there = bring(m_case.raw.arrays());
    if (!there || !there->find_faces(Projection::min_normal_cosine, int(nearest.size()),
                                     nearest.data(), nearest.data()))
      nearest.clear();
    return nearest;
  }
  /// From a vertex of the surface to a face, if their normals agree, or `any` does; else infinite.
  double distance(int vertex, int face, bool any = false) const
  {
    const auto [a, b, c] =
        m_mesh.points(m_mesh.working().mesh.halfedge(internal::Working_mesh::Face(face)));
    const Vec3d& p = m_case.surface.points[vertex];
    if (!any && !internal::agrees(m_case.surface.vertex_normals[vertex], a, b, c))
      return std::numeric_limits<double>::infinity();
    return length(nearest_point_on_triangle(p, a, b, c) - p);
  }
  internal::Distance_tracker tracker(const internal::Unset_vector<int>& nearest) const
  {
    auto points =
        internal::tracked_points(m_case.surface, m_tree, m_mesh.size(), m_mesh.concurrency());
    internal::Unset_vector<int> known(nearest.empty() ? 0 : points.size());
    for (std::size_t i = 0; i < known.size(); ++i) known[i] = nearest[points[i].vertex];
    return internal::Distance_tracker(m_mesh, std::move(points), known);
  }

private:
  static double mean_distance(const internal::Distance_tracker& tracker)
  {
    double sum = 0;
    for (int i = 0; i < tracker.size(); ++i) sum += tracker[i].distance;
    return sum / tracker.size();
  }
  double grid() const { return m_case.surface.normalization.grid; }

  Case m_case;
  Facet_tree m_tree;
  internal::Surface_projector m_projector;
  internal::Star_mesh m_mesh;
};

/// The distances between the points of two meshes, sorted.
template <class A, class B>
std::vector<double> distances(const A& a, const B& b)
{
  std::vector<double> result;
  for (std::size_t v = 0; v < a.points.size(); ++v)
    result.push_back(length(a.points[v] - b.points[v]));
  std::sort(result.begin(), result.end());
  return result;
}

/// Bad triangles.
struct Doubts {
  int bad = 0, missed = 0; ///< and those without a doubtful corner
};

/// Of a mesh whose vertices are where they are in `swept`.
inline Doubts doubts(internal::Star_mesh mesh, const internal::Swept_vertices& swept)
{
  mesh.move_all(swept);
  Doubts result;
  for (const auto f : mesh.working().mesh.faces()) {
    const auto [a, b, c] = mesh.points(mesh.working().mesh.halfedge(f));
    if (!(internal::triangle_badness(a, b, c).badness > 0)) continue;
    ++result.bad;
    const auto corners = mesh.working().corners(f);
    result.missed += std::none_of(corners.begin(), corners.end(), [&](const auto v) {
      return std::binary_search(swept.doubtful.begin(), swept.doubtful.end(), int(v));
    });
  }
  return result;
}

} // namespace improvement_case

#endif // CGAL_POWER_RTF_TEST_SWEEPS_CASE_H
