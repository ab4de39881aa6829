// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cell of the exact engine: the rule of `construct_cell()` (status, guard square) over cells with
// exact combinatorics. The guard radius and the tangent frame are the same doubles as in the fast
// path, so that both decide alike; no clipping code is shared.
#ifndef CGAL_POWER_RTF_EXACT_CONSTRUCT_EXACT_CELL_H
#define CGAL_POWER_RTF_EXACT_CONSTRUCT_EXACT_CELL_H

#include <CGAL/PowerRTF/cells/construct_cell.h>
#include <CGAL/PowerRTF/exact/Exact_cells.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace CGAL::PowerRTF {

/// A polygon of any size with the members of `Tangent_polygon` that its readers use.
struct Exact_polygon {
  using Number = double;
  int size = 0;
  std::vector<double> x, y;  ///< in the tangent frame, relative to the site, counter-clockwise
  std::vector<int> neighbor; ///< of the edge from vertex k to k + 1; -1 .. -4: side of the square
  int next(int k) const { return k + 1 < size ? k + 1 : 0; }

  /// Sets the polygon to a cell that is bounded.
  void set(const Exact_cell& cell, const Exact_cell_geometry& geometry,
           const Tangent_frame<double>& frame)
  {
    size = int(cell.neighbors.size());
    neighbor = cell.neighbors;
    x.clear();
    y.clear();
    for (int k = 0; k < size; ++k) { // geometry's vertex k ends edge k
      const Vec3d& p = geometry.vertices[(k + size - 1) % size];
      x.push_back(dot(p, frame.u));
      y.push_back(dot(p, frame.v));
    }
  }

  double radius() const
  {
    double r2 = 0;
    for (int k = 0; k < size; ++k) r2 = (std::max)(r2, x[k] * x[k] + y[k] * y[k]);
    return std::sqrt(r2);
  }
};

/// The radius beyond which cell `i` is guarded, as `construct_cell()` takes it.
inline double guard_radius(const Sites_view<double>& view, int i)
{
  return view.guard_factor * distance_to_neighbor(view, i, 6);
}

/// Constructs cell `i` of `cells` and hands it to `sink(i, status, polygon, frame)`. `view`: the
/// same samples.
template <class Kernel, class Sink>
void construct_exact_cell(const Exact_cells<Kernel>& cells, const Sites_view<double>& view, int i,
                          Sink&& sink)
{
  const Tangent_frame<double> frame(view.normals[i]);
  const double guard = guard_radius(view, i);
  Exact_polygon polygon;
  if (!(guard > 0)) { // no room: alone, or at least seven samples at one place
    if (!cells.cell_of_all(i).contains_site) return sink(i, Cell_status::empty, polygon, frame);
    polygon = {4, {0, 0, 0, 0}, {0, 0, 0, 0}, {-1, -2, -3, -4}};
    return sink(i, Cell_status::guarded, polygon, frame);
  }
  // Within the square it is known whether the whole cell reaches beyond the guard radius.
  const Exact_square square{frame.u, frame.v, guard};
  Exact_cell cell = cells.cell(i, &square);
  if (cell.is_empty()) return sink(i, Cell_status::empty, polygon, frame);
  if (!cell.reaches_square()) {
    polygon.set(cell, cells.geometry(i, cell, &square), frame);
    if (polygon.radius() <= guard) return sink(i, Cell_status::ok, polygon, frame);
  }
  cell = cells.cell_of_all(i, &square);
  polygon.set(cell, cells.geometry(i, cell, &square), frame);
  sink(i, cell.is_empty() ? Cell_status::empty : Cell_status::guarded, polygon, frame);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXACT_CONSTRUCT_EXACT_CELL_H
