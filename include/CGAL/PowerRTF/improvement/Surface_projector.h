// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Projects points onto the surface: onto the facets of the vertex's patch whose normals agree with
// the vertex's (NVISPC: never onto another sheet).
#ifndef CGAL_POWER_RTF_IMPROVEMENT_SURFACE_PROJECTOR_H
#define CGAL_POWER_RTF_IMPROVEMENT_SURFACE_PROJECTOR_H

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
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

  /// The nearest place to `p`.
  Place nearest(const Vec3d& p) const { return place(m_tree.nearest(p)); }

  /// The nearest place to `p` on the facets that agree with `normal`; its facet is -1 if there is
  /// none. `hint`: a facet of the patch, probably near; or -1.
  Place project(const Vec3d& p, const Vec3d& normal, int hint) const
  {
    return place(
        m_tree.nearest(p, normal, Improvement_parameters::Projection::min_normal_cosine, hint));
  }

  bool are_on_one_patch(int facet, int other) const
  {
    const std::vector<int>& patches = m_surface.facet_patches;
    return patches.empty() || patches[facet] == patches[other];
  }

  const Surface& surface() const { return m_surface; }
  const Facet_tree& tree() const { return m_tree; }

private:
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
