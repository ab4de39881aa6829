// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_ENGINES_CELL_POLYGON_H
#define CGAL_POWER_RTF_ENGINES_CELL_POLYGON_H

#include <CGAL/PowerRTF/cells/construct_cell.h>

#include <vector>

namespace CGAL {
namespace PowerRTF {

/// A cell F_i as users see it.
struct Cell_polygon {
  std::vector<Vec3d> vertices; ///< counter-clockwise seen from outside, unit-box coordinates
  std::vector<int> neighbors;  ///< of edge k (vertices k, k + 1); negative: side of the guard square
  double area = 0;             ///< A(F_i)
  double mass = 0;             ///< m_i = rho_i A(F_i)
  double density = 0;          ///< rho_i
  double weight = 0;           ///< w_i
  Cell_status status = Cell_status::ok;
};

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_ENGINES_CELL_POLYGON_H
