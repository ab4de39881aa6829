// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Projects points onto the surface: onto the facets of the vertex's patch whose normals agree with
// the vertex's (NVISPC: never onto another sheet).
#ifndef CGAL_POWER_RTF_IMPROVEMENT_SURFACE_PROJECTOR_H
#define CGAL_POWER_RTF_IMPROVEMENT_SURFACE_PROJECTOR_H

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>

namespace CGAL::PowerRTF::internal {

class Surface_projector {
public:
  /// A point of the surface.
  struct Place {
    Vec3d point, normal; ///< unit normal of the surface, interpolated in the facet
    int facet = -1;
  };

  /// Keeps references to both; `tree` holds the surface's facets and their patches.
  Surface_projector(const Surface& surface, const Facet_tree& tree)
      : m_surface(surface), m_tree(tree)
  {}

  /// The nearest place to `p`. `hint`: a facet that is probably near, or -1.
  Place nearest(const Vec3d& p, int hint = -1) const
  {
    return place(m_tree.nearest_anywhere(p, hint));
  }

  /// The place on `facet` if that is no farther from `p` than `reach`, else the nearest one.
  Place on_facet(const Vec3d& p, int facet, double reach) const
  {
    Triangle_part part;
    const Surface_point<double> near = onto(facet, p, part);
    return near.squared_distance <= reach * reach ? place(near) : nearest(p, facet);
  }

  /// The nearest place to `p` on the facets of the patch of `start` that agree with `normal`, found
  /// by descent from facet to facet: the nearest around. If facet `start` does not agree, the
  /// nearest on all of them; its facet is -1 if there is none.
  Place project(const Vec3d& p, const Vec3d& normal, int start) const
  {
    if (agrees(start, normal))
      if (const Surface_point<double> near = descend(p, normal, start); near.facet >= 0)
        return place(near);
    return place(m_tree.nearest(p, normal, Parameters::min_normal_cosine, start));
  }

  bool are_on_one_patch(int facet, int other) const
  {
    const std::vector<int>& patches = m_surface.facet_patches;
    return patches.empty() || patches[facet] == patches[other];
  }

  const Surface& surface() const { return m_surface; }
  const Facet_tree& tree() const { return m_tree; }

private:
  using Parameters = Improvement_parameters::Projection;

  bool agrees(int facet, const Vec3d& normal) const
  {
    return dot(m_surface.facet_normals[facet], normal) > Parameters::min_normal_cosine;
  }

  /// Goes on to the nearest facet at the edge or corner where the nearest point is, as long as that
  /// is nearer. The facet is -1 if the way is too long.
  Surface_point<double> descend(const Vec3d& p, const Vec3d& normal, int start) const
  {
    const std::vector<int>& opposite = m_surface.adjacency.opposite;
    Triangle_part part;
    Surface_point<double> best = onto(start, p, part);
    for (int step = 0; step < Parameters::max_downhill_steps; ++step) {
      if (part.kind == Triangle_part::inside) return best;
      const int from = best.facet, h = 3 * from + part.index;
      const auto try_facet = [&](int o) {
        if (o == Facet_adjacency::none) return;
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
  void for_each_around(int h, const F& f) const
  {
    const std::vector<int>& opposite = m_surface.adjacency.opposite;
    const int center = halfedge_source(m_surface.triangles, h);
    const auto leaves = [&](int o) { return halfedge_source(m_surface.triangles, o) == center; };
    for (int o = h;;) { // counter-clockwise, then clockwise if a border stopped it
      o = opposite[previous_halfedge(o)];
      if (o == h) return;
      if (o == Facet_adjacency::none || !leaves(o)) break;
      f(o);
    }
    for (int o = opposite[h]; o != Facet_adjacency::none; o = opposite[o]) {
      o = next_halfedge(o);
      if (o == h || !leaves(o)) return;
      f(o);
    }
  }

  Surface_point<double> onto(int facet, const Vec3d& p, Triangle_part& part) const
  {
    const Triangle& t = m_surface.triangles[facet];
    const Vec3d q = nearest_point_on_triangle(p, m_surface.points[t[0]], m_surface.points[t[1]],
                                              m_surface.points[t[2]], part);
    return {q, facet, squared_length(q - p)};
  }

  Place place(const Surface_point<double>& nearest) const
  {
    Place result;
    result.point = nearest.point;
    result.facet = nearest.facet;
    if (nearest.facet < 0) return result;
    const Triangle& t = m_surface.triangles[nearest.facet];
    double beta, gamma;
    barycentric_coordinates(nearest.point, m_surface.points[t[0]], m_surface.points[t[1]],
                            m_surface.points[t[2]], beta, gamma);
    const auto& normals = m_surface.vertex_normals;
    const Vec3d sum =
        normals[t[0]] * (1 - beta - gamma) + normals[t[1]] * beta + normals[t[2]] * gamma;
    const Vec3d& facet_normal = m_surface.facet_normals[nearest.facet];
    // on a fold the vertices' normals may cancel out or point behind the facet
    result.normal = dot(sum, facet_normal) > 0 ? normalized(sum) : facet_normal;
    return result;
  }

  const Surface& m_surface;
  const Facet_tree& m_tree;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_SURFACE_PROJECTOR_H
