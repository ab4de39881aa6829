// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a comparison of an engine's cells with the oracle finds.
#ifndef CGAL_POWER_RTF_EXACT_CELL_COMPARISON_H
#define CGAL_POWER_RTF_EXACT_CELL_COMPARISON_H

#include <CGAL/PowerRTF/exact/Filter_statistics.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFExact
/// Median, 99th percentile and maximum.
struct Error_distribution {
  double p50 = 0, p99 = 0, max = 0;
};

/// \ingroup PkgPowerRTFExact
/// The result of `check_cells()`. A cell is certified when the engine gives it a status other than
/// `incomplete`; each status is a claim about the cell (see `construct_cell()`). It is right when
/// its status is the oracle's and its cycle of neighbors is, but for edges below the rounding
/// bound: without the differing edges, the two cycles are one.
struct Cell_comparison {
  std::size_t cells = 0;
  std::size_t equal_cycles = 0;      ///< the oracle's neighbors in the oracle's order
  std::size_t certified_wrong = 0;   ///< must be 0
  std::size_t uncertified_right = 0; ///< incomplete, but with the oracle's cycle
  std::size_t uncertified_wrong = 0;
  /// Of the right cells: edges in one of the two cycles only, or not at the same place.
  std::size_t differing_edges = 0;
  double worst_edge = 0; ///< longest of these over its bound: at most 1
  /// Of the right cells that are not empty: \f$|A - A^*| / A^*\f$, and the distance of the
  /// centroids over \f$\sqrt{A^*}\f$.
  Error_distribution area, centroid;
  std::vector<int> wrong; ///< the certified and wrong cells
  Filter_statistics predicates;

  bool passed() const { return certified_wrong == 0; }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXACT_CELL_COMPARISON_H
