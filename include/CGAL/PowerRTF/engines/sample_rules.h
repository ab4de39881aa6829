// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What happens to one sample between two constructions: its projection and its new attributes. With
// lanes that work on a sample together, the functions of the surface are those for such lanes.
#ifndef CGAL_POWER_RTF_ENGINES_SAMPLE_RULES_H
#define CGAL_POWER_RTF_ENGINES_SAMPLE_RULES_H

#include <CGAL/PowerRTF/cells/Sites_view.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>

#include <cmath>

namespace CGAL::PowerRTF {

/// Writes a sample's normal, density, and the cube root of the density that weights the centroids.
template <class Real>
struct Attribute_rule {
  Surface_view<Real> surface;
  Vec3<Real>* normals;
  Real *density, *density_root;
  bool over_facet;
  int normal_neighbors, density_neighbors;
  Real cos_angle, power;

  template <class Lanes>
  CGAL_POWER_RTF_HD void operator()(int i, const Vec3<Real>& p, int facet, Lanes lanes) const
  {
    const Vertex_attributes<Real> a =
        over_facet ? attributes_of_facet(surface, p, facet)
                   : attributes_near_vertices(surface, p, facet, normal_neighbors,
                                              density_neighbors, cos_angle, lanes);
    if (!lanes.leads()) return;
    normals[i] = a.normal;
    density[i] = a.density;
    density_root[i] = root(a.density);
  }
  CGAL_POWER_RTF_HD Real root(Real rho) const
  {
    if (power == 0) return 1;
    return std::cbrt(power == 2 ? rho * rho : std::pow(rho, power));
  }
};

/// The attributes of samples that are where they should be.
template <class Real>
struct Placed_attributes_rule {
  Attribute_rule<Real> attributes;
  const Site<Real>* sites;
  const int* facets;

  template <class Lanes>
  CGAL_POWER_RTF_HD void operator()(int i, Lanes lanes) const
  {
    attributes(i, sites[i].point, facets[i], lanes);
  }
};

/// A step that has been computed before.
template <class Real>
struct Noted_step {
  const Vec3<Real>* steps;

  CGAL_POWER_RTF_HD Vec3<Real> operator()(int i) const { return steps[i]; }
};

/// Moves a sample by its step, back to the surface, where it gets its attributes.
template <class Real, class Step>
struct Projection_rule {
  Attribute_rule<Real> attributes;
  Step step;
  Site<Real>* sites;
  int* facets;
  int neighbors;
  bool to_nearest_facet;

  template <class Lanes>
  CGAL_POWER_RTF_HD void operator()(int i, Lanes lanes) const
  {
    const Surface_view<Real>& surface = attributes.surface;
    const Vec3<Real> target = sites[i].point + step(i), normal = attributes.normals[i];
    const Surface_point<Real> q =
        to_nearest_facet ? project_to_nearest_facet(surface, target, normal, attributes.cos_angle,
                                                    facets[i], lanes)
                         : project_near_vertices(surface, target, normal, attributes.cos_angle,
                                                 neighbors, facets[i], lanes);
    if (q.facet < 0) return; // no facet agrees: it stays
    attributes(i, q.point, q.facet, lanes);
    if (!lanes.leads()) return;
    sites[i].point = q.point;
    facets[i] = q.facet;
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_SAMPLE_RULES_H
