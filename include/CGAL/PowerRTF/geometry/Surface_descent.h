// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Projections onto a surface by descent from facet to facet.
#ifndef CGAL_POWER_RTF_GEOMETRY_SURFACE_DESCENT_H
#define CGAL_POWER_RTF_GEOMETRY_SURFACE_DESCENT_H

#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/geometry/halfedge_numbers.h>
#include <CGAL/PowerRTF/internal/Single_lane.h>

namespace CGAL::PowerRTF {

/// A point of a surface.
struct Surface_place {
  Vec3d point, normal; ///< the unit normal is interpolated in the facet
  int facet = -1;      ///< -1: there is none
};

/// A surface's arrays, and its facets in a tree, for where no descent leads. Non-owning.
struct Surface_descent {
  const int* corners = nullptr;  ///< three vertices per facet
  const int* opposite = nullptr; ///< as in `Facet_adjacency`
  const int* patches = nullptr;  ///< per facet; null: all are of one
  int vertices = 0;
  const Vec3d* points = nullptr;
  const Vec3d* vertex_normals = nullptr;
  const Vec3d* facet_normals = nullptr;
  Surface_view<double> tree;
  const int* order = nullptr;  ///< the facets in the order of the tree
  const int* places = nullptr; ///< of the facets there
  double min_cosine = -2;      ///< between normals that agree
  int max_steps = 0;           ///< from facet to facet

  /// The nearest place to `p` on the facets of the patch of `start` that agree with `normal`, found
  /// by descent from facet to facet: the nearest around. If facet `start` does not agree, the
  /// nearest on all of them; its facet is -1 if there is none.
  CGAL_POWER_RTF_HD Surface_place project(const Vec3d& p, const Vec3d& normal, int start) const
  {
    if (agrees(start, normal)) {
      const Surface_point<double> near = descend(p, normal, start);
      if (near.facet >= 0) return place(near);
    }
    Surface_point<double> nearest =
        project_to_nearest_facet(tree, p, normal, min_cosine, places[start], Single_lane());
    if (nearest.facet >= 0) nearest.facet = order[nearest.facet];
    return place(nearest);
  }

  CGAL_POWER_RTF_HD bool are_on_one_patch(int facet, int other) const
  {
    return !patches || patches[facet] == patches[other];
  }

  CGAL_POWER_RTF_HD Surface_place place(const Surface_point<double>& nearest) const
  {
    Surface_place result;
    result.point = nearest.point;
    result.facet = nearest.facet;
    if (nearest.facet < 0) return result;
    const int* const t = corners_of(nearest.facet);
    double beta, gamma;
    barycentric_coordinates(nearest.point, points[t[0]], points[t[1]], points[t[2]], beta, gamma);
    const Vec3d sum = vertex_normals[t[0]] * (1 - beta - gamma) + vertex_normals[t[1]] * beta +
                      vertex_normals[t[2]] * gamma;
    const Vec3d& facet_normal = facet_normals[nearest.facet];
    // on a fold the vertices' normals may cancel out or point behind the facet
    result.normal = dot(sum, facet_normal) > 0 ? normalized(sum) : facet_normal;
    return result;
  }

  /// The nearest point of a facet, and where in the facet that is.
  CGAL_POWER_RTF_HD Surface_point<double> onto(int facet, const Vec3d& p, Triangle_part& part) const
  {
    const int* const t = corners_of(facet);
    const Vec3d q = nearest_point_on_triangle(p, points[t[0]], points[t[1]], points[t[2]], part);
    return {q, facet, squared_length(q - p)};
  }

private:
  static constexpr int none = -1; // as an opposite halfedge

  CGAL_POWER_RTF_HD const int* corners_of(int facet) const { return corners + 3 * facet; }

  CGAL_POWER_RTF_HD bool agrees(int facet, const Vec3d& normal) const
  {
    return dot(facet_normals[facet], normal) > min_cosine;
  }

  /// Goes on to the nearest facet at the edge or corner where the nearest point is, as long as that
  /// is nearer. The facet is -1 if the way is too long.
  CGAL_POWER_RTF_HD Surface_point<double> descend(const Vec3d& p, const Vec3d& normal,
                                                  int start) const
  {
    Triangle_part part;
    Surface_point<double> best = onto(start, p, part);
    for (int step = 0; step < max_steps; ++step) {
      if (part.kind == Triangle_part::inside) return best;
      const int from = best.facet, h = 3 * from + part.index;
      const auto try_facet = [&](int o) {
        if (o == none) return;
        const int f = o / 3;
        if (f == from || !are_on_one_patch(f, from) || !agrees(f, normal)) return;
        Triangle_part its_part;
        const Surface_point<double> x = onto(f, p, its_part);
        if (!(x.squared_distance < best.squared_distance)) return;
        best = x;
        part = its_part;
      };
      if (part.kind == Triangle_part::edge)
        try_facet(opposite[h]);
      else
        for_each_around(h, try_facet);
      if (best.facet == from) return best;
    }
    return {};
  }

  /// Calls `f` for the halfedges around the source of `h` that leave it, but `h`, up to seams.
  template <class F>
  CGAL_POWER_RTF_HD void for_each_around(int h, const F& f) const
  {
    const int center = corners[h]; // the source
    for (int o = h;;) {            // counter-clockwise, then clockwise if a border stopped it
      o = opposite[previous_halfedge(o)];
      if (o == h) return;
      if (o == none || corners[o] != center) break;
      f(o);
    }
    for (int o = opposite[h]; o != none; o = opposite[o]) {
      o = next_halfedge(o);
      if (o == h || corners[o] != center) return;
      f(o);
    }
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SURFACE_DESCENT_H
