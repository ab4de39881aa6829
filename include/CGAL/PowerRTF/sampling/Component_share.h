// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SAMPLING_COMPONENT_SHARE_H
#define CGAL_POWER_RTF_SAMPLING_COMPONENT_SHARE_H

#include <CGAL/PowerRTF/internal/host_device.h>

#include <cstddef>

namespace CGAL::PowerRTF {

/// What a component of the surface gets.
struct Component_share {
  std::size_t samples = 0; ///< without those on creases and borders
  double mass = 0;         ///< the integral of the density
  double cell_mass = 0;    ///< what is a sample's of it
};

/// Whether a component has enough samples for a lattice.
CGAL_POWER_RTF_HD inline bool has_lattice(const Component_share& share)
{
  return share.samples >= 50;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_COMPONENT_SHARE_H
