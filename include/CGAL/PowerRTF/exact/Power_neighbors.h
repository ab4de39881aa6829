// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The neighbors of weighted samples in their power diagram, from CGAL::Regular_triangulation_3
// (exact predicates; the samples are doubles, so the kernel is always EPICK).
#ifndef CGAL_POWER_RTF_EXACT_POWER_NEIGHBORS_H
#define CGAL_POWER_RTF_EXACT_POWER_NEIGHBORS_H

#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/compiled.h>

#include <vector>

namespace CGAL::PowerRTF::internal {

/// Adjacency of the regular triangulation. A sample is `doubtful` when the triangulation hides it
/// (its power cell is empty, or degenerate by a tie that the triangulation decided its own way), or
/// when a hidden sample lies in a tetrahedron at it. Without a 3D triangulation all are doubtful.
class Power_neighbors {
  std::vector<std::vector<int>> m_neighbors;
  std::vector<char> m_doubtful;

public:
  Power_neighbors() = default;

  Power_neighbors(const std::vector<Vec3d>& points, const std::vector<double>& weights);

  /// Neighbors of `i` by increasing distance.
  const std::vector<int>& of(int i) const { return m_neighbors[i]; }
  bool doubtful(int i) const { return m_doubtful.empty() || m_doubtful[i]; }
};

} // namespace CGAL::PowerRTF::internal

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/exact/Power_neighbors_impl.h>
#endif

#endif // CGAL_POWER_RTF_EXACT_POWER_NEIGHBORS_H
