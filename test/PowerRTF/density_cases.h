// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces and options for densities that are computed in two ways.
#ifndef CGAL_POWER_RTF_TEST_DENSITY_CASES_H
#define CGAL_POWER_RTF_TEST_DENSITY_CASES_H

#include "shapes.h"

#include <CGAL/PowerRTF/fields/density.h>

#include <cstddef>
#include <random>
#include <vector>

namespace density_cases {

using namespace CGAL::PowerRTF;

inline shapes::Soup noisy_sphere(int subdivisions)
{
  shapes::Soup s = shapes::icosphere(subdivisions);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> radius(0.98, 1.02);
  for (Vec3d& p : s.points) p *= radius(random);
  return s;
}

/// Closed and open ones, tiny ones, one that is flat and one that nearly is, several components.
inline std::vector<shapes::Soup> small_shapes()
{
  using namespace shapes;
  return {tetrahedron(),       octahedron(),    ellipsoid(4, 1, 1, 4),
          torus(90, 30, 3, 1), noisy_sphere(4), open_cylinder(40, 20, 1, 2),
          plane_patch(30, 7),  box(20),         joined(torus(40, 20, 1, .4), two_spheres(3, 9))};
}

inline Remeshing_options options_of(std::size_t n, double power, double gradation, double smoothing)
{
  Remeshing_options o;
  o.density = Density::curvature;
  o.density_power = power;
  o.gradation = gradation;
  o.density_smoothing = smoothing;
  o.number_of_samples = n;
  return o;
}

inline std::vector<Remeshing_options> all_options(std::size_t n)
{
  std::vector<Remeshing_options> all;
  for (const double power : {0., 1., 2.})
    for (const double gradation : {0., 0.1, 0.3})
      for (const double smoothing : {0., 3.})
        all.push_back(options_of(n, power, gradation, smoothing));
  return all;
}

/// With a crease, of which every edge will do.
inline Surface creased(Surface surface)
{
  surface.creases = {sorted_edge(surface.triangles[0][0], surface.triangles[0][1])};
  return surface;
}

} // namespace density_cases

#endif // CGAL_POWER_RTF_TEST_DENSITY_CASES_H
