// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether two samples are neighbors along the surface: close sheets can be nearer in space.
#ifndef CGAL_POWER_RTF_GEOMETRY_SURFACE_WALK_H
#define CGAL_POWER_RTF_GEOMETRY_SURFACE_WALK_H

#include <CGAL/PowerRTF/geometry/Surface_facets.h>
#include <CGAL/PowerRTF/geometry/halfedge_numbers.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>

#include <cstddef>

namespace CGAL::PowerRTF {

namespace internal {

/// The way straight on along the surface, in the plane through two of its points that holds the
/// direction `up`.
class Surface_walk {
public:
  CGAL_POWER_RTF_HD Surface_walk(const Surface_facets& surface, const Vec3d& from, const Vec3d& to,
                                 const Vec3d& up)
      : m_surface(surface), m_from(from), m_way(to - from), m_normal(cross(m_way, up))
  {}

  /// Walks from facet `start`, which holds the first point, at most twice as far as the second one
  /// is. Returns whether it came to a facet for which `is_end(f)`. A way can close at once: around
  /// a tip at which the plane touches the surface.
  template <class Is_end>
  CGAL_POWER_RTF_HD bool leads_to(int start, const Is_end& is_end) const
  {
    if (is_end(start)) return true;
    const double distance = length(m_way);
    Vec3d last = m_from;
    double walked = 0;
    Crossed_edge at = first_exit(start);
    const int first = at.halfedge;
    if (first < 0) return false;
    do {
      const Vec3d p = crossing(at);
      walked += length(p - last);
      last = p;
      const int h = m_surface.opposite[at.halfedge];
      if (h < 0) return false;
      if (is_end(h / 3)) return true;
      at = exit({h, at.target_side, at.source_side});
    } while (at.halfedge != first && walked < 2 * distance);
    return false;
  }

private:
  // An edge with an end on each side of the way.
  struct Crossed_edge {
    int halfedge;
    double source_side, target_side;
  };

  // > 0: to the left of the way.
  CGAL_POWER_RTF_HD double side(int v) const { return dot(m_surface.points[v] - m_from, m_normal); }
  CGAL_POWER_RTF_HD Vec3d crossing(const Crossed_edge& e) const
  {
    const Vec3d a = m_surface.points[m_surface.corners[e.halfedge]],
                b = m_surface.points[m_surface.corners[next_halfedge(e.halfedge)]];
    return a + (b - a) * (e.source_side / (e.source_side - e.target_side));
  }

  // The edge of the first facet that is crossed farthest ahead.
  CGAL_POWER_RTF_HD Crossed_edge first_exit(int f) const
  {
    const int* const t = m_surface.corners + 3 * std::size_t(f);
    const double sides[3] = {side(t[0]), side(t[1]), side(t[2])};
    Crossed_edge best{-1, 0, 0};
    double farthest = 0;
    for (int k = 0; k < 3; ++k) {
      const Crossed_edge e{3 * f + k, sides[k], sides[(k + 1) % 3]};
      if ((e.source_side < 0) == (e.target_side < 0)) continue;
      const double ahead = dot(crossing(e) - m_from, m_way);
      if (best.halfedge >= 0 && !(ahead > farthest)) continue;
      best = e;
      farthest = ahead;
    }
    return best;
  }
  // The other crossed edge of the facet of `e`.
  CGAL_POWER_RTF_HD Crossed_edge exit(const Crossed_edge& e) const
  {
    const int next = next_halfedge(e.halfedge);
    const double apex_side = side(m_surface.corners[next_halfedge(next)]);
    if ((e.target_side < 0) != (apex_side < 0)) return {next, e.target_side, apex_side};
    return {next_halfedge(next), apex_side, e.source_side};
  }

  Surface_facets m_surface;
  Vec3d m_from, m_way, m_normal;
};

/// Whether facet `f` holds the point `p` of facet `own`, which may be on an edge or at a vertex of
/// both. `scale`: of the rounding.
CGAL_POWER_RTF_HD inline bool holds_point(const Surface_facets& surface, int f, const Vec3d& p,
                                          int own, double scale)
{
  constexpr double rounding = 1e-6; // of samples on a GPU
  if (f == own) return true;
  const int* const t = surface.corners + 3 * std::size_t(f);
  const int* const u = surface.corners + 3 * std::size_t(own);
  bool is_near = false;
  for (int k = 0; k < 9; ++k) is_near = is_near || t[k / 3] == u[k % 3];
  if (!is_near) return false;
  const Vec3d q = nearest_point_on_triangle(p, surface.points[t[0]], surface.points[t[1]],
                                            surface.points[t[2]]);
  return length(q - p) < rounding * scale;
}

} // namespace internal
} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SURFACE_WALK_H
