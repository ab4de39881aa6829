// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_IMPROVEMENT_BETTER_FLIPS_H
#define CGAL_POWER_RTF_IMPROVEMENT_BETTER_FLIPS_H

#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/smoothing/lowers_energy.h>

#include <algorithm>

namespace CGAL::PowerRTF::internal {

/// Whether a flip of `e` lowers the sum of `energy(a, b, c)` of its triangles, none of which is
/// below `least_energy`, and keeps their agreement, or as much as `min_agreement`. Equal diagonals
/// stay.
template <class Energy>
bool is_better_flipped(const Star_mesh& m, Star_mesh::Edge e, const Energy& energy,
                       double least_energy, double min_agreement)
{
  if (m.working().mesh.is_removed(e)) return false;
  const auto [a, b, c, d] = m.corners(e);
  if (!lowers_energy(m.point(a), m.point(b), m.point(c), m.point(d), energy, least_energy,
                     clearly_less))
    return false;
  if (!m.is_free(e)) return false;
  const double agreement = std::min(m.agreement(a, b, c), m.agreement(b, a, d));
  if (std::min(m.agreement(d, c, a), m.agreement(c, d, b)) < std::min(min_agreement, agreement))
    return false;
  return m.working().is_flippable(e);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_BETTER_FLIPS_H
