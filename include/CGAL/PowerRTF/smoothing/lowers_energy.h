// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SMOOTHING_LOWERS_ENERGY_H
#define CGAL_POWER_RTF_SMOOTHING_LOWERS_ENERGY_H

#include <CGAL/PowerRTF/geometry/vector.h>

namespace CGAL::PowerRTF::internal {

/// Whether a flip of the edge (a, b) of the triangles (a, b, c) and (b, a, d) takes the sum of
/// their `energy(a, b, c)`, none of which is below `least_energy`, below this share of what it was.
template <class Energy>
CGAL_POWER_RTF_HD bool lowers_energy(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d,
                                     const Energy& energy, double least_energy, double share)
{
  const double enough = share * (energy(a, b, c) + energy(b, a, d)), first = energy(d, c, a);
  return first + least_energy < enough && first + energy(c, d, b) < enough;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_LOWERS_ENERGY_H
