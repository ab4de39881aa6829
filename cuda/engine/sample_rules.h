// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What happens to one sample between two constructions: its projection and its new attributes.
#ifndef CGAL_POWER_RTF_CUDA_SAMPLE_RULES_H
#define CGAL_POWER_RTF_CUDA_SAMPLE_RULES_H

#include "../device/Single_lane.h"
#include "../surface/Surface_view.h"

#include <CGAL/PowerRTF/optimization/usable_cells.h>

#include <cmath>

#ifdef __CUDACC__
#include "../surface/projection_by_lanes.cuh"
#include "../surface/vertices_by_warp.cuh"
#endif

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

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

/// See `is_usable()`.
template <class Real>
struct Usable_rule {
  const Real *area, *mass, *density;
  const unsigned char* status;
  double mean_mass;

  CGAL_POWER_RTF_HD bool operator()(int i) const
  {
    return is_usable(Cell_status(status[i]), mass[i], double(density[i]) * area[i], mean_mass);
  }
};

/// Whether the capacity of a cell that is not left out has become as small as `least`.
template <class Real>
struct Vanishing_rule {
  const Real *area, *density;
  const unsigned char* is_left_out;
  double least;

  CGAL_POWER_RTF_HD bool operator()(int i) const
  { return !is_left_out[i] && !(double(density[i]) * area[i] > least); }
};

/// Lloyd's method: to the centre of mass. A sample with an empty cell stays.
template <class Real>
struct Lloyd_step {
  Usable_rule<Real> usable;
  const Vec3<Real>* offset;

  CGAL_POWER_RTF_HD Vec3<Real> operator()(int i) const
  {
    if (usable.status[i] == int(Cell_status::empty)) return {0, 0, 0};
    if (usable(i)) return offset[i];
    const Real usual_area = Real(usable.mean_mass / usable.density[i]);
    return cautious_step(offset[i], usable.area[i], usual_area);
  }
};

template <class Real>
struct Noted_step {
  const Vec3<Real>* steps;

  CGAL_POWER_RTF_HD Vec3<Real> operator()(int i) const { return steps[i]; }
};

/// Moves a sample by its step, back to the surface, where it takes its attributes.
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

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_SAMPLE_RULES_H
