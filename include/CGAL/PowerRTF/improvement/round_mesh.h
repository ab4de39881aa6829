// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rounder triangles on average, for a mesh with creases. The lattice has no room between them, and
// round stars, which smoothing aims for, are not the best triangles there. So edges are flipped,
// and vertices search their tangent planes or slide along their curves, where that lowers the sum
// over the triangles of 1 - Q and, so that no triangle pays for others, of their badness.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_ROUND_MESH_H
#define CGAL_POWER_RTF_IMPROVEMENT_ROUND_MESH_H

#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/better_flips.h>
#include <CGAL/PowerRTF/improvement/flat_stars.h>
#include <CGAL/PowerRTF/improvement/slide_features.h>
#include <CGAL/PowerRTF/improvement/tangent_search.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Of a triangle: 1 - Q, Q as in triangle_quality.h, and its badness; 0: equilateral.
inline double unroundness(const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  const double l0 = length(b - a), l1 = length(c - b), l2 = length(a - c),
               twice_area = length(cross(b - a, c - a));
  if (!(twice_area > 0)) return std::numeric_limits<double>::infinity();
  const double q = 3.4641016151377544 * twice_area / ((l0 + l1 + l2) * std::max({l0, l1, l2}));
  return 1 - q +
         Improvement_parameters::Rounding::badness_weight * triangle_badness(a, b, c).badness;
}

class Mesh_rounder {
public:
  using Vertex = Star_mesh::Vertex;
  using Edge = Star_mesh::Edge;
  using Face = Working_mesh::Face;
  using State = Star_mesh::State;

  Mesh_rounder(Star_mesh& mesh, Feature_slider& slider)
      : m(mesh), m_slider(slider), m_failed(mesh.size(), 0)
  {}

  /// The last of the rounds also tries flips that only pay when the vertices around have moved.
  void run(int rounds)
  {
    for (int round = 0; round < rounds; ++round) {
      flip();
      for_each_movable(m, [this](Vertex v) {
        const State state = m.state_around(v);
        if (state != m_failed[v] && !search(v)) m_failed[v] = state;
      });
      if (round == rounds - 1) flip_around_bad();
      for (const Vertex v : m.working().mesh.vertices()) m_slider.slide(v, unroundness);
    }
  }

private:
  using Parameters = Improvement_parameters::Rounding;

  void flip()
  {
    for (const int e : select(m.concurrency(), int(m.working().mesh.num_edges()),
                              [this](int e) { return is_better_flipped(Edge(e)); })) {
      Cancellation::poll();
      if (is_better_flipped(Edge(e))) m.flip(Edge(e));
    }
  }

  bool is_better_flipped(Edge e) const
  {
    return internal::is_better_flipped(m, e, unroundness, 0, Parameters::min_agreement);
  }

  void flip_around_bad()
  {
    const auto& mesh = m.working().mesh;
    const auto is_bad = [&](Face f) { return unroundness_of(f) > Parameters::bad; };
    for (const int f : select(m.concurrency(), int(mesh.num_faces()), [&](int f) {
           return !mesh.is_removed(Face(f)) && is_bad(Face(f));
         })) {
      auto h = mesh.halfedge(Face(f));
      for (int k = 0; k < 3 && is_bad(Face(f)); ++k, h = mesh.next(h))
        if (flip_if_better(mesh.edge(h))) break;
    }
  }

  // The flip and, after it, the search of the vertices around.
  bool flip_if_better(Edge e)
  {
    Cancellation::poll();
    if (!m.is_free(e) || !m.working().is_flippable(e)) return false;
    const std::array<Vertex, 4> corners = m.corners(e);
    if (std::any_of(corners.begin(), corners.end(), [this](Vertex v) { return m.is_hub(v); }))
      return false;
    const auto shape = [&](int i, int j, int k) {
      return m.working().shape(corners[i], corners[j], corners[k]);
    };
    if (std::min(shape(0, 3, 2), shape(1, 2, 3)) < Parameters::min_flip_shape) return false;
    std::vector<Vertex> around(corners.begin(), corners.end());
    m.working().add_neighbors(around);
    const Patch was = patch(around);
    Star_mesh::Checkpoint before(m);
    m.flip(e);
    for (int pass = 0; pass < Parameters::passes_per_flip; ++pass)
      for (const Vertex v : around)
        m.is_movable(v) ? void(search(v)) : m_slider.slide(v, unroundness);
    const Patch now = patch(around);
    if (now.unroundness < clearly_less * was.unroundness &&
        now.agreement >= std::min(Parameters::min_agreement, was.agreement))
      return true;
    before.rewind();
    return false;
  }

  // The faces around some vertices: the sum of their unroundness, the least of their agreement.
  struct Patch {
    double unroundness = 0, agreement = 1;
  };

  Patch patch(const std::vector<Vertex>& vertices) const
  {
    Patch result;
    for (const Face f : m.working().faces_at(vertices)) {
      const auto [a, b, c] = m.working().corners(f);
      result.unroundness += unroundness(m.point(a), m.point(b), m.point(c));
      result.agreement = std::min(result.agreement, m.agreement(a, b, c));
    }
    return result;
  }

  double unroundness_of(Face f) const
  {
    const auto [a, b, c] = m.points(m.working().mesh.halfedge(f));
    return unroundness(a, b, c);
  }

  bool search(Vertex v)
  {
    const Star star = m.star(v);
    const Vec3d p = m.point(v), n = m.normal(v);
    const double start = sum(star, p, std::numeric_limits<double>::infinity());
    if (start < Parameters::good * double(star.corners.size())) return false;
    const double step = Parameters::first_step * mean_edge(star, p), limit = clearly_less * start;
    double least = start;
    const Vec3d best = search_tangent_plane<Parameters>(
        p, n, step, least, [&](const Vec3d& q, double enough) { return sum(star, q, enough); });
    if (!(least < limit)) return false;
    const auto place = m.project(v, best);
    if (place.facet < 0 || !(sum(star, place.point, limit) < limit)) return false;
    if (m.agreement(star, place.point, place.normal) <
        std::min(Parameters::min_agreement, m.agreement(star, p, n)))
      return false;
    m.move(v, place);
    return true;
  }

  // Of the star with its center at `p`, or what is no less than `limit`.
  static double sum(const Star& star, const Vec3d& p, double limit)
  {
    double sum = 0;
    for (const Star::Corner& c : star.corners)
      if (!((sum += unroundness(p, c.a, c.b)) < limit)) break;
    return sum;
  }

  Star_mesh& m;
  Feature_slider& m_slider;
  std::vector<State> m_failed; // by vertex: the state in which the search has failed
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_ROUND_MESH_H
