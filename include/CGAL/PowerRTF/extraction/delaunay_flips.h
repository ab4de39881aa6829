// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edge flips: an edge is flipped when the angles opposite to it have a larger sum than those
// opposite to the new edge (in a plane: more than pi, Delaunay), unless the new triangles lie worse
// on the surface; and when the new ones lie clearly better.
// Never when the new edge exists already: the mesh stays a 2-manifold of the same topology.
#ifndef CGAL_POWER_RTF_EXTRACTION_DELAUNAY_FLIPS_H
#define CGAL_POWER_RTF_EXTRACTION_DELAUNAY_FLIPS_H

#include <CGAL/PowerRTF/extraction/Intersection_guard.h>
#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Edge_flipper {
public:
  using Vertex = Working_mesh::Vertex;
  using Halfedge = Working_mesh::Halfedge;
  using Edge = Working_mesh::Edge;

  /// Triangles whose normals have at least the cosine `good_agreement` with the surface's at their
  /// corners lie well enough: among them only the angles count. What `guard` forbids is not done.
  Edge_flipper(Working_mesh& mesh, double good_agreement, Intersection_guard* guard = nullptr)
      : m(mesh), m_guard(guard), m_good_agreement(good_agreement),
        m_waiting(mesh.mesh.num_edges(), false), m_flips(mesh.mesh.num_edges(), 0)
  {}

  /// Marks an edge to be looked at by the next `run()`.
  void push(Edge e)
  {
    if (m_waiting[e]) return;
    m_waiting[e] = true;
    m_stack.push_back(e);
  }

  /// Marks the edges of all triangles at samples: inserted into large facets they make long ones,
  /// which must be gone before vertices are removed.
  void push_around_samples()
  {
    for (const Vertex v : m.mesh.vertices())
      if (m.samples[v] >= 0)
        for (const Halfedge h : halfedges_around_target(v, m.mesh)) {
          push(m.mesh.edge(h));
          push(m.mesh.edge(m.mesh.prev(h)));
        }
  }

  /// Looks at the marked edges and at those around every flipped edge. At most `max_flips`.
  /// \returns the number of flips.
  std::size_t run(std::size_t max_flips)
  {
    std::size_t flips = 0;
    while (!m_stack.empty()) {
      Cancellation::poll();
      const Edge e = m_stack.back();
      m_stack.pop_back();
      m_waiting[e] = false;
      if (flips < max_flips && flip_if_better(e)) ++flips;
    }
    return flips;
  }

  /// True if the edge can be flipped without a change of topology or of features.
  bool is_legal(Edge e) const
  {
    return m.is_flippable(e) && !m.is_feature(e) && !(m_guard && m_guard->forbids_flip(e));
  }

  void flip(Edge e)
  {
    const Halfedge h = m.mesh.halfedge(e), o = m.mesh.opposite(h);
    for (const Halfedge side : {m.mesh.next(h), m.mesh.prev(h), m.mesh.next(o), m.mesh.prev(o)})
      push(m.mesh.edge(side));
    if (m_guard) {
      m_guard->erase(m.mesh.face(h));
      m_guard->erase(m.mesh.face(o));
    }
    int &p = m.patches[m.mesh.face(h)], &q = m.patches[m.mesh.face(o)];
    if (p != q) p = q = -1;
    Euler::flip_edge(h, m.mesh);
    if (m_guard) {
      m_guard->insert(m.mesh.face(h));
      m_guard->insert(m.mesh.face(o));
    }
  }

private:
  // Two triangles folded by more than 135 degrees never lie well.
  static constexpr double fold = -0.7;
  static constexpr double clearly = 0.05;
  static constexpr double tolerance = 1e-9;            // cocircular: no flip
  static constexpr unsigned int max_flips_for_fit = 5; // fit and angles may take turns for ever

  // How well two triangles with a common edge lie on the surface.
  double fit(Vertex a, Vertex b, Vertex c, Vertex d) const // abc and bad
  {
    const Vec3d n1 = m.area_vector(a, b, c), n2 = m.area_vector(b, a, d);
    const double l1 = length(n1), l2 = length(n2);
    if (!(l1 > 0) || !(l2 > 0)) return -1;
    const double cosine = dot(n1, n2) / (l1 * l2);
    const double agreement =
        std::min({m.agreement(n1, l1, a), m.agreement(n1, l1, b), m.agreement(n1, l1, c),
                  m.agreement(n2, l2, a), m.agreement(n2, l2, b), m.agreement(n2, l2, d)});
    return std::min(agreement, m_good_agreement) - (cosine < fold ? 1 : 0);
  }

  // Direction (cosine, sine) of the sum of the angles at c and d in the triangles abc and bad.
  std::array<double, 2> opposite_angles(Vertex a, Vertex b, Vertex c, Vertex d) const
  {
    const Vec3d ca = m.point(a) - m.point(c), cb = m.point(b) - m.point(c),
                da = m.point(a) - m.point(d), db = m.point(b) - m.point(d);
    const double cosine_c = dot(ca, cb), sine_c = length(cross(ca, cb)), cosine_d = dot(da, db),
                 sine_d = length(cross(da, db));
    const double scale = std::sqrt(squared_length(ca) * squared_length(cb) * squared_length(da) *
                                   squared_length(db));
    if (!(scale > 0)) return {1, 0};
    return {(cosine_c * cosine_d - sine_c * sine_d) / scale,
            (sine_c * cosine_d + cosine_c * sine_d) / scale};
  }

  // True if the angles opposite to ab have a larger sum than those opposite to cd have after a
  // flip. In a plane the two sums make 2 pi; on a curved surface less, and both may be below pi.
  bool has_larger_angles(Vertex a, Vertex b, Vertex c, Vertex d) const
  {
    const auto now = opposite_angles(a, b, c, d);
    if (now[1] < -tolerance) return true;
    const auto then = opposite_angles(d, c, a, b);
    return then[1] > 0 && now[0] < then[0] - tolerance;
  }

  bool flip_if_better(Edge e)
  {
    if (m.mesh.is_removed(e) || m.mesh.is_border(e) || m.is_feature(e)) return false;
    const Halfedge h = m.mesh.halfedge(e);
    const Vertex a = m.mesh.source(h), b = m.mesh.target(h), c = m.apex(h),
                 d = m.apex(m.mesh.opposite(h));
    const double fit_now = fit(a, b, c, d);
    const bool not_delaunay = has_larger_angles(a, b, c, d);
    if (!not_delaunay && fit_now >= m_good_agreement) return false;
    const double fit_then = fit(d, c, a, b);
    const bool lies_better = fit_then > fit_now + clearly && m_flips[e] < max_flips_for_fit;
    if (!(lies_better || (not_delaunay && fit_then >= fit_now))) return false;
    if (!m.can_be_joined(c, d) || (m_guard && m_guard->forbids_flip(e))) return false;
    ++m_flips[e];
    flip(e);
    return true;
  }

  Working_mesh& m;
  Intersection_guard* m_guard; // or none
  double m_good_agreement;
  std::vector<Edge> m_stack;
  std::vector<char> m_waiting;       // by edge
  std::vector<unsigned int> m_flips; // by edge
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_DELAUNAY_FLIPS_H
