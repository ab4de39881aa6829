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
    const int first = first_exit(start);
    if (first == Facet_adjacency::none) return false;
    int h = first;
    do {
      const Vec3d p = crossing(h);
      walked += length(p - last);
      last = p;
      h = m_surface.adjacency.opposite[h];
      if (h == Facet_adjacency::none) return false;
      if (is_end(h / 3)) return true;
      h = exit(h);
    } while (h != first && walked < 2 * distance);
    return false;
  }

private:
  // > 0: to the left of the way.
  double side(int v) const { return dot(m_surface.points[v] - m_from, m_normal); }
  bool is_crossed(int h) const
  {
    return (side(halfedge_source(m_surface.triangles, h)) < 0) !=
           (side(halfedge_target(m_surface.triangles, h)) < 0);
  }
  Vec3d crossing(int h) const
  {
    const int a = halfedge_source(m_surface.triangles, h),
              b = halfedge_target(m_surface.triangles, h);
    const double u = side(a), v = side(b);
    return m_surface.points[a] + (m_surface.points[b] - m_surface.points[a]) * (u / (u - v));
  }

  // The edge of the first facet that is crossed farthest ahead.
  int first_exit(int f) const
  {
    int best = Facet_adjacency::none;
    double farthest = 0;
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      if (!is_crossed(h)) continue;
      const double ahead = dot(crossing(h) - m_from, m_way);
      if (best != Facet_adjacency::none && !(ahead > farthest)) continue;
      best = h;
      farthest = ahead;
    }
    return best;
  }
  // The other crossed edge of the facet of `h`.
  int exit(int h) const
  {
    const int next = next_halfedge(h);
    return is_crossed(next) ? next : next_halfedge(next);
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
