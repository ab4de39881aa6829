// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Improvement of an extracted mesh: rounder triangles by flips and smoothing, a targeted search for
// the few that stay bad, a least-squares fit that brings the mesh nearer to the surface, and
// vertices for the places that are farthest from it. (An addition to the paper.)
#ifndef CGAL_POWER_RTF_EXTRACTION_IMPROVE_MESH_H
#define CGAL_POWER_RTF_EXTRACTION_IMPROVE_MESH_H

#include <CGAL/PowerRTF/extraction/intersecting_faces.h>
#include <CGAL/PowerRTF/extraction/improvement/cover_tips.h>
#include <CGAL/PowerRTF/extraction/improvement/fit_to_surface.h>
#include <CGAL/PowerRTF/extraction/improvement/mend_stars.h>
#include <CGAL/PowerRTF/extraction/improvement/relocate_vertices.h>
#include <CGAL/PowerRTF/extraction/improvement/slide_features.h>
#include <CGAL/PowerRTF/extraction/improvement/smooth_stars.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

class Mesh_improver
{
public:
  /// \throw Invalid_input_error if `raw` is not an oriented 2-manifold
  Mesh_improver(const Surface& surface, const Facet_tree& tree, const Extracted_mesh& raw)
      : m_surface(surface), m_guide(surface, tree), m_raw(raw), m_locked(raw.points.size(), false),
        m_raw_stars(raw, m_guide), m_watch(m_raw_stars),
        m_flat(surface, facet_adjacency(surface.triangles, surface.points.size())),
        m_largest_distance(m_watch.max_distance() +
                           worsening * std::sqrt(surface.area / double(raw.points.size())))
  {
  }

  /// The improved mesh. If an improvement has broken something, it is made anew: at first with less
  /// smoothing, which may already do, then with what was broken locked, as little of it as does.
  Extracted_mesh run()
  {
    Extracted_mesh mesh = m_raw;
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
      Star_mesh stars = m_raw_stars;
      stars.lock(m_locked);
      improve(stars, attempt == 1 ? smoothing_steps - 1 : smoothing_steps);
      const std::vector<Face> broken = find_broken(stars);
      if (broken.empty()) {
        stars.write(mesh);
        return mesh;
      }
      if (attempt == 1)
        lock_farthest(stars, broken);
      else if (attempt > 1)
        lock(stars, broken, attempt - 2);
    }
    return mesh;
  }

private:
  using Mesh = Working_mesh::Mesh;
  using Vertex = Working_mesh::Vertex;
  using Face = Mesh::Face_index;

  static constexpr double worsening = 0.2; // of the maximal distance, in units of sqrt(area / n)
  static constexpr int max_attempts = 8;
  static constexpr int smoothing_steps = 3;
  static constexpr int mending_rounds = 8;
  static constexpr int sliding_rounds = 4;
  static constexpr double far = 0.7;       // share of the maximal distance: tips are covered
  static constexpr double very_far = 0.4;  // in units of sqrt(area / n): vertices move once more
  static constexpr double rough = 0.3;     // badness that the mending after it can heal
  static constexpr double healable = 0.008; // the same around a vertex that has been put elsewhere

  void improve(Star_mesh& stars, int steps)
  {
    Star_smoother smoother(stars);
    for (int i = 0; i < steps; ++i) {
      smoother.flip();
      smoother.sweep();
    }
    Star_mender mender(stars);
    const auto mend = [&] { mender.run(mending_rounds); };
    mend();
    if (!m_raw.feature_edges.empty()) {
      Feature_slider slider(stars, m_surface);
      for (int i = 0; i < 2; ++i) {
        slider.run(sliding_rounds);
        mend();
      }
    }
    m_watch.follow(stars);
    Tip_coverer(stars, m_watch, rough).run(far);
    mend();
    m_watch.update();
    Surface_fitter(stars, m_watch, m_flat, rough).run();
    mend();
    if (mender.release_pinned() > 0) mend();
    m_watch.update();
    Vertex_relocator relocator(stars, mender, m_watch);
    const double too_far = very_far * std::sqrt(m_surface.area / double(stars.size()));
    if (relocator.run(far) && relocator.farthest() > too_far) relocator.run(far);
    if (mender.is_needed()) {
      mend();
      m_watch.update();
    }
    if (relocator.farthest() > too_far && !mender.is_needed()) {
      const Star_mesh before = stars;
      if (relocator.run(far, healable)) mend();
      if (mender.is_needed()) stars.restore(before);
      m_watch.update();
    }
    Tip_coverer(stars, m_watch, Triangle_badness::tolerable).run(far);
    m_too_far.clear();
    for (int i = 0; i < m_watch.size(); ++i)
      if (m_watch[i].distance > m_largest_distance)
        m_too_far.push_back(stars.working().mesh.face(m_watch[i].face));
  }

  // The faces that intersect others or are too far from the surface, but for those between locked
  // vertices: they are as in the raw mesh.
  std::vector<Face> find_broken(const Star_mesh& stars) const
  {
    const Mesh& mesh = stars.working().mesh;
    std::vector<Face> broken;
    const auto is_locked = [&](Face f) {
      for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
        if (!m_locked[v]) return false;
      return true;
    };
    for (const Face f : m_too_far)
      if (!is_locked(f)) broken.push_back(f);
    for (const auto& [f, g] : Intersection_finder(mesh).all())
      if (!is_locked(f) || !is_locked(g)) broken.insert(broken.end(), {f, g});
    return broken;
  }

  // Locks the vertex of each face that has moved farthest.
  void lock_farthest(const Star_mesh& stars, const std::vector<Face>& broken)
  {
    const auto moved = [&](Vertex v) { return squared_length(stars.point(v) - m_raw.points[v]); };
    const Mesh& mesh = stars.working().mesh;
    for (const Face f : broken) {
      const auto corners = mesh.vertices_around_face(mesh.halfedge(f));
      const Vertex v = *std::max_element(corners.begin(), corners.end(), [&](Vertex a, Vertex b)
                                         { return moved(a) < moved(b); });
      m_locked[v] = true;
    }
  }

  // Locks the vertices of the faces and those so many edges around them.
  void lock(const Star_mesh& stars, const std::vector<Face>& broken, int rings)
  {
    const Mesh& mesh = stars.working().mesh;
    std::vector<Vertex> locked;
    for (const Face f : broken)
      for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) locked.push_back(v);
    for (int ring = 0; ring < rings; ++ring)
      for (std::size_t i = 0, size = locked.size(); i < size; ++i)
        for (const auto h : halfedges_around_target(locked[i], mesh))
          locked.push_back(mesh.source(h));
    for (const Vertex v : locked) m_locked[v] = true;
  }

  const Surface& m_surface;
  Surface_guide m_guide;
  const Extracted_mesh& m_raw;
  std::vector<char> m_locked;
  Star_mesh m_raw_stars;
  Surface_watch m_watch;
  Flat_patches m_flat;
  double m_largest_distance;
  std::vector<Face> m_too_far;
};

} // namespace internal

/// Improves the triangles of `mesh` and its distance to `surface`. Keeps the vertices' number, the
/// topology, the feature edges and the border; vertices on these slide along them where that
/// helps, corners stay, the others move, and a few may go far. Makes no self-intersection. The
/// largest distance of the surface's vertices to the mesh grows by at most 0.2 h, h = sqrt(area /
/// n). Where an improvement would break one of these, everything stays as it is.
///
/// `surface`: with normals smoothed at the scale of the samples (`smooth_normals()`). `tree`: of
/// its facets and their patches.
///
/// \returns `false` if `mesh` is no oriented 2-manifold: then nothing is done.
inline bool improve_mesh(const Surface& surface, const Facet_tree& tree, Extracted_mesh& mesh)
{
  if (mesh.triangles.empty()) return true;
  try {
    mesh = internal::Mesh_improver(surface, tree, mesh).run();
    mesh.sort_triangles();
  } catch (const Invalid_input_error&) {
    return false;
  }
  return true;
}

/// The same with a tree of its own.
inline bool improve_mesh(const Surface& surface, Extracted_mesh& mesh)
{
  return improve_mesh(surface, Facet_tree(surface.points, surface.triangles, surface.facet_patches),
                      mesh);
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_IMPROVE_MESH_H
