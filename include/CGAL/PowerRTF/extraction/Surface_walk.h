// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether two samples are neighbors along the surface: close sheets can be nearer in space.
#ifndef CGAL_POWER_RTF_EXTRACTION_SURFACE_WALK_H
#define CGAL_POWER_RTF_EXTRACTION_SURFACE_WALK_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>

#include <algorithm>
#include <cmath>

namespace CGAL::PowerRTF::internal {

/// The way straight on along the surface, in the plane through two of its points that holds the
/// direction `up`.
class Surface_walk {
public:
  Surface_walk(const Surface& surface, const Vec3d& from, const Vec3d& to, const Vec3d& up)
      : m_surface(surface), m_from(from), m_way(to - from), m_normal(cross(m_way, up))
  {}

  /// Walks from facet `start`, which holds the first point, at most twice as far as the second one
  /// is. Returns whether it came to a facet for which `is_end(f)`. A way can close at once: around
  /// a tip at which the plane touches the surface.
  template <class Is_end>
  bool leads_to(int start, const Is_end& is_end) const
  {
    if (is_end(start)) return true;
    const double distance = length(m_way);
    Vec3d last = m_from;
    double walked = 0;
    Crossed_edge at = first_exit(start);
    const int first = at.halfedge;
    if (first == Facet_adjacency::none) return false;
    do {
      const Vec3d p = crossing(at);
      walked += length(p - last);
      last = p;
      const int h = m_surface.adjacency.opposite[at.halfedge];
      if (h == Facet_adjacency::none) return false;
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
  double side(int v) const { return dot(m_surface.points[v] - m_from, m_normal); }
  Vec3d crossing(const Crossed_edge& e) const
  {
    const int a = halfedge_source(m_surface.triangles, e.halfedge),
              b = halfedge_target(m_surface.triangles, e.halfedge);
    return m_surface.points[a] + (m_surface.points[b] - m_surface.points[a]) *
                                     (e.source_side / (e.source_side - e.target_side));
  }

  // The edge of the first facet that is crossed farthest ahead.
  Crossed_edge first_exit(int f) const
  {
    const Triangle& t = m_surface.triangles[f];
    const double sides[3] = {side(t[0]), side(t[1]), side(t[2])};
    Crossed_edge best{Facet_adjacency::none, 0, 0};
    double farthest = 0;
    for (int k = 0; k < 3; ++k) {
      const Crossed_edge e{3 * f + k, sides[k], sides[(k + 1) % 3]};
      if ((e.source_side < 0) == (e.target_side < 0)) continue;
      const double ahead = dot(crossing(e) - m_from, m_way);
      if (best.halfedge != Facet_adjacency::none && !(ahead > farthest)) continue;
      best = e;
      farthest = ahead;
    }
    return best;
  }
  // The other crossed edge of the facet of `e`.
  Crossed_edge exit(const Crossed_edge& e) const
  {
    const int next = next_halfedge(e.halfedge);
    const double apex_side = side(halfedge_target(m_surface.triangles, next));
    if ((e.target_side < 0) != (apex_side < 0)) return {next, e.target_side, apex_side};
    return {next_halfedge(next), apex_side, e.source_side};
  }

  const Surface& m_surface;
  Vec3d m_from, m_way, m_normal;
};

/// Whether facet `f` holds the point `p` of facet `own`, which may be on an edge or at a vertex of
/// both. `scale`: of the rounding.
inline bool holds_point(const Surface& surface, int f, const Vec3d& p, int own, double scale)
{
  constexpr double rounding = 1e-6; // of samples on a GPU
  if (f == own) return true;
  const Triangle &t = surface.triangles[f], &u = surface.triangles[own];
  if (std::find_first_of(t.begin(), t.end(), u.begin(), u.end()) == t.end()) return false;
  const Vec3d q = nearest_point_on_triangle(p, surface.points[t[0]], surface.points[t[1]],
                                            surface.points[t[2]]);
  return length(q - p) < rounding * scale;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_SURFACE_WALK_H
