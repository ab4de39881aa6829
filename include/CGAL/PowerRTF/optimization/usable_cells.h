// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which cells have a say in the positions' energy, and the steps of those that have none. At tips
// that are narrower than the spacing a tangent face reaches far beyond the surface; a handful of
// these would rule the energy and poison the memory of L-BFGS.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_USABLE_CELLS_H
#define CGAL_POWER_RTF_OPTIMIZATION_USABLE_CELLS_H

#include <CGAL/PowerRTF/cells/construct_cell.h>
#include <CGAL/PowerRTF/geometry/vector.h>

#include <cmath>

namespace CGAL::PowerRTF {

/// Whether a cell stands for the surface around its sample.
///
/// \param moment the mass that weights the centroid
/// \param capacity rho_i A(F_i)
/// \param mean_capacity that of the first cells
template <class Real>
CGAL_POWER_RTF_HD bool is_usable(Cell_status status, Real moment, double capacity,
                                 double mean_capacity)
{
  constexpr double largest = 1.35; // over the mean
  return status == Cell_status::ok && moment > 0 && capacity <= largest * mean_capacity;
}

/// At most half the side of a square of this area.
template <class Real>
CGAL_POWER_RTF_HD Vec3<Real> shortened(const Vec3<Real>& step, Real area)
{
  const Real longest = std::sqrt(area) / 2, l = length(step);
  return l > longest ? step * (longest / l) : step;
}

/// The step of a cell that is not usable: half the way to its centroid, and not far.
///
/// \param usual_area of a cell with the sample's density
template <class Real>
CGAL_POWER_RTF_HD Vec3<Real> cautious_step(const Vec3<Real>& offset, Real area, Real usual_area)
{
  return shortened(offset * Real(0.5), area < usual_area ? area : usual_area);
}

/// The cells of an engine by arrays.
template <class Real>
struct Usable_cells {
  const Real *area, *mass, *density;
  const unsigned char* status;
  double mean_mass; ///< of the first cells

  /// rho_i A(F_i)
  CGAL_POWER_RTF_HD double capacity(int i) const { return double(density[i]) * area[i]; }
  CGAL_POWER_RTF_HD bool is_usable(int i) const
  {
    return PowerRTF::is_usable(Cell_status(status[i]), mass[i], capacity(i), mean_mass);
  }
};

/// Lloyd's method: to the center of mass. A sample with an empty cell stays.
template <class Real>
struct Lloyd_step {
  Usable_cells<Real> cells;
  const Vec3<Real>* offset; ///< c_i - s_i

  CGAL_POWER_RTF_HD Vec3<Real> operator()(int i) const
  {
    if (cells.status[i] == int(Cell_status::empty)) return {0, 0, 0};
    if (cells.is_usable(i)) return offset[i];
    return cautious_step(offset[i], cells.area[i], Real(cells.mean_mass / cells.density[i]));
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_USABLE_CELLS_H
