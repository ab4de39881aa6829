// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps of the samples (Algorithm 3, lines 15 to 19), each over all n cells of an engine by its
// backend.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_POSITION_STEPS_H
#define CGAL_POWER_RTF_OPTIMIZATION_POSITION_STEPS_H

#include <CGAL/PowerRTF/cells/Sites_view.h>
#include <CGAL/PowerRTF/optimization/Lbfgs.h>
#include <CGAL/PowerRTF/optimization/usable_cells.h>

#include <cmath>

namespace CGAL::PowerRTF {

template <class Real, class Backend>
void lloyd_steps(Backend& backend, int n, const Lloyd_step<Real>& lloyd, Vec3<Real>* steps)
{
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) { steps[i] = lloyd(i); });
}

/// The energy is the sum of int rho |x - s_i|^2 over the cells: gradient 2 m_i (s_i - c_i). Cells
/// that are not usable make the steps of `lloyd`.
template <class Real, class Backend, int Memory>
void lbfgs_steps(Backend& backend, int n, Lbfgs<Real, Backend, Memory>& lbfgs,
                 const Site<Real>* sites, const Lloyd_step<Real>& lloyd, Vec3<Real>* steps)
{
  const auto gradient = [=] CGAL_POWER_RTF_HD(int i, Vec3<Real>& g, Real& inverse) {
    const bool usable = lloyd.cells.is_usable(i);
    const Real mass = lloyd.cells.mass[i];
    g = usable ? lloyd.offset[i] * (-2 * mass) : Vec3<Real>{0, 0, 0};
    inverse = usable ? 1 / (2 * mass) : Real(0);
    return usable;
  };
  lbfgs.prepare([=] CGAL_POWER_RTF_HD(int i) { return sites[i].point; }, gradient);
  const auto direction = lbfgs.direction();
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    Vec3<Real> g;
    Real inverse;
    const bool usable = gradient(i, g, inverse);
    steps[i] = usable ? shortened(direction(i, g, inverse), lloyd.cells.area[i]) : lloyd(i);
  });
}

/// Steps of samples with empty cells that lie on another sample: no weight could part them.
/// `nearest`, `sixth`: distances to the first and the sixth nearest site.
template <class Real, class Backend>
void part_duplicates(Backend& backend, int n, const unsigned char* status,
                     const Vec3<Real>* normals, const Real* nearest, const Real* sixth,
                     Vec3<Real>* steps)
{
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    if (Cell_status(status[i]) != Cell_status::empty || nearest[i] > 0) return;
    const double angle = 2.399963229728653 * i; // the golden angle: all directions differ
    const Tangent_frame<Real> frame(normals[i]);
    steps[i] = (frame.u * Real(std::cos(angle)) + frame.v * Real(std::sin(angle))) * (sixth[i] / 2);
  });
}

/// Copies points, weights and facets of n sites.
template <class Real, class Backend>
void copy_state(Backend& backend, int n, Site<Real>* to_sites, int* to_facets,
                const Site<Real>* sites, const int* facets)
{
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    to_sites[i] = sites[i];
    to_facets[i] = facets[i];
  });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_POSITION_STEPS_H
