// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CELLS_CELL_POLYGON_H
#define CGAL_POWER_RTF_CELLS_CELL_POLYGON_H

#include <CGAL/PowerRTF/cells/cell_moments.h>
#include <CGAL/PowerRTF/cells/construct_cell.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/Tangent_frame.h>

#include <vector>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFSurface
/// A cell \f$F_i\f$ as users see it.
struct Cell_polygon {
  std::vector<Vec3d> vertices; ///< counter-clockwise seen from outside, unit-box coordinates
  std::vector<int> neighbors; ///< of edge k (vertices k, k + 1); negative: side of the guard square
  double area = 0;            ///< \f$A(F_i)\f$
  double mass = 0;            ///< \f$m_i = \rho_i A(F_i)\f$
  double density = 0;         ///< \f$\rho_i\f$
  double weight = 0;          ///< \f$w_i\f$
  Cell_status status = Cell_status::ok;
};

/// The cell of sample `i`, as it has been constructed in the tangent plane.
template <class SamplesLike, class Polygon>
Cell_polygon cell_polygon(const SamplesLike& samples, int i, Cell_status status,
                          const Polygon& polygon)
{
  Cell_polygon cell;
  const Tangent_frame<double> frame(samples.normals[i]);
  for (int k = 0; k < polygon.size; ++k) {
    cell.vertices.push_back(samples.points[i] + frame.u * polygon.x[k] + frame.v * polygon.y[k]);
    cell.neighbors.push_back(polygon.neighbor[k]);
  }
  cell.area = double(cell_moments(polygon).area);
  cell.density = samples.density[i];
  cell.mass = cell.area * cell.density;
  cell.weight = samples.weights[i];
  cell.status = status;
  return cell;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_CELL_POLYGON_H
