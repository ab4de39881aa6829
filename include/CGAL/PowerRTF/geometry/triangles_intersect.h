// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether two triangles of a mesh meet in more than the vertices and edges that they share, decided
// by exact predicates.
#ifndef CGAL_POWER_RTF_GEOMETRY_TRIANGLES_INTERSECT_H
#define CGAL_POWER_RTF_GEOMETRY_TRIANGLES_INTERSECT_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace CGAL::PowerRTF::internal {

using Epick = Exact_predicates_inexact_constructions_kernel;
using Triangle_points = std::array<Epick::Point_3, 3>;

inline bool has_no_area(const Triangle_points& p) { return collinear(p[0], p[1], p[2]); }

inline Bbox_3 box_of(const Triangle_points& p) { return p[0].bbox() + p[1].bbox() + p[2].bbox(); }

/// Proves in floating point that a plane parts two triangles, so that they meet in nothing, or in
/// nothing but the corner that both have, through which the plane goes. A few planes are tried:
/// enough for nearly all pairs, also in one plane, where exact predicates are slow.
class Parting_plane {
public:
  using Point = Epick::Point_3;
  using Points = Triangle_points;

  /// \param i, j the numbers of the shared corner, or -1
  Parting_plane(const Points& p, const Points& q, int i = -1, int j = -1) : m_i(i), m_j(j)
  {
    const Point& origin = p[i < 0 ? 0 : i];
    for (int k = 0; k < 3; ++k) {
      m_p[k] = difference(p[k], origin);
      m_q[k] = difference(q[k], origin);
      for (const Vec3d& x : {m_p[k], m_q[k]})
        m_reach = (std::max)({m_reach, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
    }
  }

  bool exists() const
  {
    const Vec3d c = m_p[0] + m_p[1] + m_p[2], d = m_q[0] + m_q[1] + m_q[2];
    if (m_i < 0) return parts(d - c) || is_along(m_p) || is_along(m_q);
    return parts(d - c) || parts(normalized(d) - normalized(c)) || is_between_edges();
  }

private:
  using Corners = std::array<Vec3d, 3>;

  static Vec3d difference(const Point& a, const Point& b)
  {
    return {a.x() - b.x(), a.y() - b.y(), a.z() - b.z()};
  }
  static Vec3d normal(const Corners& t) { return cross(t[1] - t[0], t[2] - t[0]); }

  // A triangle's own plane, or one upright on it along an edge.
  bool is_along(const Corners& t) const
  {
    const Vec3d n = normal(t);
    if (parts(n)) return true;
    for (int k = 0; k < 3; ++k)
      if (parts(cross(n, t[(k + 1) % 3] - t[k]))) return true;
    return false;
  }

  // One through the shared corner, half-way between an edge of the one and an edge of the other.
  bool is_between_edges() const
  {
    const Vec3d n = normal(m_p);
    for (int k = 1; k < 3; ++k)
      for (int l = 1; l < 3; ++l)
        if (parts(cross(n, normalized(m_p[(m_i + k) % 3]) + normalized(m_q[(m_j + l) % 3]))))
          return true;
    return false;
  }

  // Planes that are upright on `d`. Whatever rounding has made of it, it is a direction: only the
  // heights along it are uncertain.
  bool parts(const Vec3d& d) const
  {
    const double error = 1e-15 * m_reach * (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
    if (!(error > 1e-290)) return false; // underflow
    const Range p = range(m_p, m_i, d), q = range(m_q, m_j, d);
    if (m_i < 0) return p.high + error < q.low - error || q.high + error < p.low - error;
    return (p.high < -error && q.low > error) || (q.high < -error && p.low > error);
  }

  struct Range {
    double low, high;
  };
  // Of the heights, without the shared corner's, which is 0.
  static Range range(const Corners& t, int shared, const Vec3d& d)
  {
    Range r{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (int k = 0; k < 3; ++k) {
      if (k == shared) continue;
      const double height = dot(t[k], d);
      r.low = (std::min)(r.low, height);
      r.high = (std::max)(r.high, height);
    }
    return r;
  }

  int m_i, m_j;
  Corners m_p, m_q; // from the shared corner, or from one of them
  double m_reach = 0;
};

/// \param s, t the triangles' vertices, of any type that compares; distinct in each
/// \param p, q their points, not collinear in either
template <class Vertex>
bool triangles_intersect(const std::array<Vertex, 3>& s, const Triangle_points& p,
                         const std::array<Vertex, 3>& t, const Triangle_points& q)
{
  int shared = 0, i_s = 0, i_t = 0; // the last pair of corners with the same vertex
  bool s_is_shared[3] = {false, false, false}, t_is_shared[3] = {false, false, false};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (s[i] == t[j]) {
        ++shared;
        s_is_shared[i] = t_is_shared[j] = true;
        i_s = i;
        i_t = j;
      }
  const auto triangle = [](const Triangle_points& x) {
    return Epick::Triangle_3(x[0], x[1], x[2]);
  };
  const auto opposite_edge = [](const Triangle_points& x, int i) {
    return Epick::Segment_3(x[(i + 1) % 3], x[(i + 2) % 3]);
  };
  if (shared == 0) return !Parting_plane(p, q).exists() && do_intersect(triangle(p), triangle(q));
  if (shared == 1)
    return !Parting_plane(p, q, i_s, i_t).exists() &&
           (do_intersect(triangle(p), opposite_edge(q, i_t)) ||
            do_intersect(triangle(q), opposite_edge(p, i_s)));
  if (shared == 3) return true;
  // a shared edge: the triangles overlap when they are coplanar and on the same side of it
  const int a = s_is_shared[0] ? (s_is_shared[1] ? 2 : 1) : 0; // the corners off the edge
  const int b = t_is_shared[0] ? (t_is_shared[1] ? 2 : 1) : 0;
  const auto &e = p[(a + 1) % 3], &f = p[(a + 2) % 3];
  return coplanar(e, f, p[a], q[b]) && coplanar_orientation(e, f, p[a], q[b]) == POSITIVE;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_TRIANGLES_INTERSECT_H
