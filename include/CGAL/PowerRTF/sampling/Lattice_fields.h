// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lattice that the samples begin as, for those who want to look at it.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_FIELDS_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_FIELDS_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <vector>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFRef
/// The fields of a lattice on the nodes that they were found on, several per sample, and the
/// lattice's points. Coordinates and lengths are those of the surface.
struct Lattice_fields {
  // Of the nodes; the last ones are the sites on creases and borders.
  std::vector<Vec3d> nodes;
  std::vector<Vec3d> normals;    ///< unit
  std::vector<Vec3d> axes;       ///< unit tangents along a row, one of its six directions
  std::vector<double> spacing;   ///< between neighbors in the lattice
  std::vector<int> indices;      ///< of the directions around the node: `orientation_index()`
  std::vector<int> dislocations; ///< rows that end within its neighbors: `dislocation()`

  // Before some are eliminated and gaps are filled; none of components too small for a lattice.
  std::vector<Vec3d> points;    ///< of the lattice, on the surface
  std::vector<int> point_nodes; ///< the node that is nearest to each
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_FIELDS_H
