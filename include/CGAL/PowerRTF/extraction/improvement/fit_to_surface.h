// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves the vertices along their normals so that the surface runs through the triangles: least
// squares of the distances, at a quadrature of each triangle, to the points that are nearest now.
// With all vertices on the surface, a curved part has all triangles on one side of it; this halves
// the mean distance.
#ifndef CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_FIT_TO_SURFACE_H
#define CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_FIT_TO_SURFACE_H

#include <CGAL/PowerRTF/extraction/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/extraction/improvement/triangle_badness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

class Surface_fitter
{
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;

  /// `limit`: the badness that a move may bring upon a triangle that was better.
  Surface_fitter(Star_mesh& mesh, double limit)
      : m(mesh), m_badness_limit(limit), m_diagonal(mesh.size(), 0), m_right(mesh.size(), 0),
        m_limit(mesh.size(), 0), m_move(mesh.size(), 0),
        m_off_diagonal(mesh.working().mesh.number_of_edges(), 0)
  {
  }

  void run()
  {
    measure();
    solve();
    for (const Vertex v : m.working().mesh.vertices())
      if (m.is_movable(v)) raise(v);
  }

private:
  using Barycentric = std::array<double, 3>;

  static constexpr int sweeps = 8; // the matrix is like a mass matrix: they converge fast
  static constexpr double largest_turn = 0.5; // of a triangle by one move: cosine

  // A rule that is exact for cubics: the corners, the middles of the edges, the centroid.
  void measure()
  {
    const auto& mesh = m.working().mesh;
    for (const auto f : mesh.faces()) {
      const std::array<Halfedge, 3> h{mesh.halfedge(f), mesh.next(mesh.halfedge(f)),
                                      mesh.prev(mesh.halfedge(f))};
      const double a = area(h[0]);
      add(h, {1 / 3., 1 / 3., 1 / 3.}, a * 9 / 20);
      for (int k = 0; k < 3; ++k) {
        const Vertex v = mesh.target(h[k]);
        m_diagonal[v] += a / 20;
        m_right[v] -= a / 20 * m.height(v);
        const Halfedge o = mesh.opposite(h[k]);
        if (h[k] < o || mesh.is_border(o)) {
          Barycentric b{.5, .5, .5};
          b[(k + 1) % 3] = 0; // the corner opposite to h[k]
          add(h, b, (a + (mesh.is_border(o) ? 0 : area(o))) * 2 / 15);
        }
      }
    }
  }

  double area(Halfedge h) const
  {
    const auto& mesh = m.working().mesh;
    return length(
               m.working().area_vector(mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)))) /
           2;
  }

  // `corners`: the halfedges of a triangle, each for its target.
  void add(const std::array<Halfedge, 3>& corners, const Barycentric& barycentric, double weight)
  {
    const auto& mesh = m.working().mesh;
    std::array<Vertex, 3> v;
    Vec3d p{0, 0, 0}, n{0, 0, 0};
    int nearest = 0;
    for (int k = 0; k < 3; ++k) {
      v[k] = mesh.target(corners[k]);
      p += barycentric[k] * m.point(v[k]);
      n += barycentric[k] * m.normal(v[k]);
      if (barycentric[k] > barycentric[nearest]) nearest = k;
    }
    n = normalized(n);
    const auto place = m.guide().project(p, n, m.facet(v[nearest]));
    if (place.facet < 0) return;
    const double distance = length(place.point - p);
    const Vec3d direction = distance > 0 ? (place.point - p) * (1 / distance) : n;
    Barycentric c;
    for (int k = 0; k < 3; ++k) c[k] = barycentric[k] * dot(direction, m.normal(v[k]));
    for (int k = 0; k < 3; ++k) {
      m_diagonal[v[k]] += weight * c[k] * c[k];
      m_right[v[k]] += weight * c[k] * distance;
      m_limit[v[k]] = std::max(m_limit[v[k]], distance);
      // corners[k + 1] is the edge between the corners k and k + 1
      m_off_diagonal[mesh.edge(corners[(k + 1) % 3])] += weight * c[k] * c[(k + 1) % 3];
    }
  }

  void solve()
  {
    const auto& mesh = m.working().mesh;
    for (int sweep = 0; sweep < sweeps; ++sweep)
      for (const Vertex v : mesh.vertices()) {
        if (!m.is_movable(v) || !(m_diagonal[v] > 0)) continue;
        double x = m_right[v];
        for (const Halfedge h : halfedges_around_target(v, mesh))
          x -= m_off_diagonal[mesh.edge(h)] * m_move[mesh.source(h)];
        m_move[v] = std::max(-m_limit[v], std::min(m_limit[v], x / m_diagonal[v]));
      }
  }

  void raise(Vertex v)
  {
    const Vec3d p = m.point(v), q = p + m_move[v] * m.normal(v);
    for (const Star::Corner& c : m.star(v).corners) {
      const Vec3d before = cross(c.a - p, c.b - p), after = cross(c.a - q, c.b - q);
      if (!(dot(before, after) > largest_turn * length(before) * length(after))) return;
      const double badness = triangle_badness(q, c.a, c.b).badness;
      if (badness > m_badness_limit && badness > triangle_badness(p, c.a, c.b).badness) return;
    }
    m.raise(v, m_move[v]);
  }

  Star_mesh& m;
  double m_badness_limit;
  // the normal equations, and their solution: the way of each vertex along its normal
  std::vector<double> m_diagonal, m_right, m_limit, m_move, m_off_diagonal;
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_FIT_TO_SURFACE_H
