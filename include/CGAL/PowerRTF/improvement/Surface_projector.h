// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Projects points onto the surface: onto the facets of the vertex's patch whose normals agree with
// the vertex's (NVISPC: never onto another sheet).
#ifndef CGAL_POWER_RTF_IMPROVEMENT_SURFACE_PROJECTOR_H
#define CGAL_POWER_RTF_IMPROVEMENT_SURFACE_PROJECTOR_H

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/Surface_descent.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>

namespace CGAL::PowerRTF::internal {

class Surface_projector {
public:
  using Place = Surface_place;

  /// Keeps references to both; `tree` holds the surface's facets and their patches.
  Surface_projector(const Surface& surface, const Facet_tree& tree)
      : m_surface(surface), m_tree(tree)
  {
    m_descent.corners = surface.triangles.data()->data();
    m_descent.opposite = surface.adjacency.opposite.data();
    m_descent.patches = surface.facet_patches.empty() ? nullptr : surface.facet_patches.data();
    m_descent.vertices = int(surface.points.size());
    m_descent.points = surface.points.data();
    m_descent.vertex_normals = surface.vertex_normals.data();
    m_descent.facet_normals = surface.facet_normals.data();
    m_descent.tree = tree.view();
    m_descent.order = tree.order().data();
    m_descent.places = tree.places().data();
    m_descent.min_cosine = Parameters::min_normal_cosine;
    m_descent.max_steps = Parameters::max_downhill_steps;
  }

  /// The nearest place to `p`. `hint`: a facet that is probably near, or -1.
  Place nearest(const Vec3d& p, int hint = -1) const
  {
    return m_descent.place(m_tree.nearest_anywhere(p, hint));
  }

  /// A point that is no farther from `p` than `enough`, or the nearest; the facet is the surface's.
  Surface_point<double> near_enough(const Vec3d& p, double enough, int hint) const
  {
    return m_tree.near_enough(p, enough, hint);
  }

  /// The place on `facet` if that is no farther from `p` than `reach`, else the nearest one.
  Place on_facet(const Vec3d& p, int facet, double reach) const
  {
    Triangle_part part;
    const Surface_point<double> near = m_descent.onto(facet, p, part);
    return near.squared_distance <= reach * reach ? m_descent.place(near) : nearest(p, facet);
  }

  /// See `Surface_descent::project()`.
  Place project(const Vec3d& p, const Vec3d& normal, int start) const
  {
    return m_descent.project(p, normal, start);
  }

  const Surface_descent& descent() const { return m_descent; }
  const Surface& surface() const { return m_surface; }
  const Facet_tree& tree() const { return m_tree; }

private:
  using Parameters = Improvement_parameters::Projection;

  const Surface& m_surface;
  const Facet_tree& m_tree;
  Surface_descent m_descent;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_SURFACE_PROJECTOR_H
