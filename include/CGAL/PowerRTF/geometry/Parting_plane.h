// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Proofs in floating point, for host and device, that two triangles do not meet in more than the
// corners that they share. What they leave open is for exact predicates.
#ifndef CGAL_POWER_RTF_GEOMETRY_PARTING_PLANE_H
#define CGAL_POWER_RTF_GEOMETRY_PARTING_PLANE_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/vector.h>

#include <cmath>

namespace CGAL::PowerRTF::internal {

/// Proves that a plane parts two triangles, so that they meet in nothing, or in nothing but the
/// corner that both have, through which the plane goes. A few planes are tried: enough for nearly
/// all pairs, also in one plane, where exact predicates are slow.
class Parting_plane {
public:
  using Corners = Vec3d[3];

  /// \param i, j the numbers of the shared corner, or -1
  CGAL_POWER_RTF_HD Parting_plane(const Corners& p, const Corners& q, int i = -1, int j = -1)
      : m_is_shared(i >= 0)
  {
    if (!m_is_shared) i = j = 0;
    const Vec3d origin = p[i];
    for (int k = 0; k < 3; ++k) {
      m_p[k] = p[(i + k) % 3] - origin;
      m_q[k] = q[(j + k) % 3] - origin;
      m_reach = larger(m_reach, larger(size(m_p[k]), size(m_q[k])));
    }
  }

  CGAL_POWER_RTF_HD bool exists() const
  {
    const Vec3d c = m_p[0] + m_p[1] + m_p[2], d = m_q[0] + m_q[1] + m_q[2];
    if (!m_is_shared) return parts(d - c) || is_along(m_p) || is_along(m_q) || is_along_edges();
    return parts(d - c) || parts(normalized(d) - normalized(c)) || is_between_edges();
  }

private:
  CGAL_POWER_RTF_HD static double size(const Vec3d& x)
  {
    return larger(std::fabs(x.x), larger(std::fabs(x.y), std::fabs(x.z)));
  }
  CGAL_POWER_RTF_HD static Vec3d normal(const Corners& t)
  {
    return cross(t[1] - t[0], t[2] - t[0]);
  }

  // A triangle's own plane, or one upright on it along an edge.
  CGAL_POWER_RTF_HD bool is_along(const Corners& t) const
  {
    const Vec3d n = normal(t);
    if (parts(n)) return true;
    for (int k = 0; k < 3; ++k)
      if (parts(cross(n, t[(k + 1) % 3] - t[k]))) return true;
    return false;
  }

  // One along an edge of each.
  CGAL_POWER_RTF_HD bool is_along_edges() const
  {
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        if (parts(cross(m_p[(k + 1) % 3] - m_p[k], m_q[(l + 1) % 3] - m_q[l]))) return true;
    return false;
  }

  // One through the shared corner, half-way between an edge of the one and an edge of the other.
  CGAL_POWER_RTF_HD bool is_between_edges() const
  {
    const Vec3d n = normal(m_p);
    for (int k = 1; k < 3; ++k)
      for (int l = 1; l < 3; ++l)
        if (parts(cross(n, normalized(m_p[k]) + normalized(m_q[l])))) return true;
    return false;
  }

  // Planes that are upright on `d`. Whatever rounding has made of it, it is a direction: only the
  // heights along it are uncertain.
  CGAL_POWER_RTF_HD bool parts(const Vec3d& d) const
  {
    const double error = 1e-15 * m_reach * (std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z));
    if (!(error > 1e-290)) return false; // underflow
    const Range p = range(m_p, d), q = range(m_q, d);
    if (!m_is_shared) return p.high + error < q.low - error || q.high + error < p.low - error;
    return (p.high < -error && q.low > error) || (q.high < -error && p.low > error);
  }

  struct Range {
    double low, high;
  };
  // Of the heights, without the shared corner's, which is 0.
  CGAL_POWER_RTF_HD Range range(const Corners& t, const Vec3d& d) const
  {
    const double second = dot(t[1], d), third = dot(t[2], d);
    const Range r{smaller(second, third), larger(second, third)};
    if (m_is_shared) return r;
    const double first = dot(t[0], d);
    return {smaller(r.low, first), larger(r.high, first)};
  }

  bool m_is_shared;
  Corners m_p, m_q; // from the shared corner, which comes first, or from one of them
  double m_reach = 0;
};

/// Which corners two triangles share, by the numbers of their vertices.
struct Shared_corners {
  int count = 0;
  int first = -1, second = -1;       ///< of the last pair, in either triangle; -1: there is none
  int first_off = 3, second_off = 3; ///< where two are shared: the corners off their edge
};

/// \param s, t arrays of three
template <class Vertices>
CGAL_POWER_RTF_HD inline Shared_corners shared_corners(const Vertices& s, const Vertices& t)
{
  Shared_corners shared;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (s[i] == t[j]) {
        ++shared.count;
        shared.first = i;
        shared.second = j;
        shared.first_off -= i;
        shared.second_off -= j;
      }
  return shared;
}

/// Corners of a face, their numbers and its own.
struct Numbered_face {
  Vec3d points[3];
  int vertices[3], face;
};

constexpr double clear_share = 1e-14; ///< of a product of lengths: 90 roundings

/// Proves that the corners are not collinear.
CGAL_POWER_RTF_HD inline bool clearly_has_area(const Numbered_face& f)
{
  const Vec3d a = f.points[1] - f.points[0], b = f.points[2] - f.points[0];
  const double product = squared_length(a) * squared_length(b);
  return product > 1e-290 && squared_length(cross(a, b)) > clear_share * clear_share * product;
}

/// Proves that two faces with a common edge, of which `a` and `b` are the other corners seen from
/// its source, are not in one plane on the same side of it.
CGAL_POWER_RTF_HD inline bool clearly_unfolded(const Vec3d& edge, const Vec3d& a, const Vec3d& b)
{
  const Vec3d m = cross(edge, a), n = cross(edge, b);
  const double volume = length(edge) * length(a) * length(b), error = clear_share * volume;
  if (!(error * length(edge) > 1e-290)) return false; // underflow
  return dot(m, n) < -error * length(edge) || std::fabs(dot(a, n)) > error;
}

/// Proves that two faces meet in nothing but the corners and the edge that they share.
CGAL_POWER_RTF_HD inline bool are_clearly_apart(const Numbered_face& f, const Numbered_face& g)
{
  const Shared_corners shared = shared_corners(f.vertices, g.vertices);
  if (shared.count < 2)
    return Parting_plane(f.points, g.points, shared.first, shared.second).exists();
  if (shared.count > 2) return false;
  const int off = shared.first_off;
  const Vec3d origin = f.points[(off + 1) % 3];
  return clearly_unfolded(f.points[(off + 2) % 3] - origin, f.points[off] - origin,
                          g.points[shared.second_off] - origin);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_PARTING_PLANE_H
