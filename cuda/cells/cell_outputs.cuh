// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the results of the construction for a cell.
#ifndef CGAL_POWER_RTF_CUDA_CELL_OUTPUTS_CUH
#define CGAL_POWER_RTF_CUDA_CELL_OUTPUTS_CUH

#include "Lane_cell.h"
#include <CGAL/PowerRTF/cells/Cell_arrays.h>

#include <CGAL/PowerRTF/cells/cell_moments.h>
#include <CGAL/PowerRTF/cells/construct_cell.h>

namespace CGAL::PowerRTF::device {

/// The cells [begin, end) in full: vertex and edge k of cell i at [(i - begin) * 64 + k].
template <class Real>
struct Polygon_outputs {
  static constexpr int capacity = Tangent_polygon<Real>::capacity;
  int begin = 0, end = 0;
  int* size = nullptr;
  Real *x = nullptr, *y = nullptr;
  int* neighbor = nullptr;
};

/// Where the construction writes; indices are the caller's.
template <class Real>
struct Cell_targets {
  Real* radius = nullptr;  ///< R of the last construction; 0: unknown, < 0: it was deferred
  Real* guard = nullptr;   ///< guard radius of the site at each place; 0: not known
  int* deferred = nullptr; ///< places of the cells that a warp makes
  int* deferred_count = nullptr;
  Cell_outputs<Real> out;
  Polygon_outputs<Real> polygons;
};

template <class Real, class Polygon>
__device__ inline void write_edges(const Group_view<Real>& view, const Cell_outputs<Real>& out,
                                   int place, int id, const Polygon& polygon,
                                   const Tangent_frame<Real>& frame)
{
  const Vec3<Real> own = view.sites[place].point;
  int count = 0;
  for (int k = 0; k < polygon.size && count < out.edge_capacity; ++k) {
    const int j = polygon.neighbor[k], l = polygon.next(k);
    if (j < 0) continue;
    const Vec3<Real> offset = view.sites[j].point - own;
    const Real a = dot(offset, frame.u), b = dot(offset, frame.v);
    const Real dx = polygon.x[l] - polygon.x[k], dy = polygon.y[l] - polygon.y[k];
    const std::size_t at = std::size_t(count) * view.cells + id;
    out.edge_neighbor[at] = view.caller[j];
    out.edge_ratio[at] = float(std::sqrt((dx * dx + dy * dy) / (a * a + b * b)));
    ++count;
  }
  out.edge_count[id] = count;
}

template <class Real, class Polygon>
__device__ inline void write_polygon(const Group_view<Real>& view, const Polygon_outputs<Real>& out,
                                     int id, const Polygon& polygon)
{
  if (id < out.begin || id >= out.end) return;
  const std::size_t first = std::size_t(id - out.begin) * Polygon_outputs<Real>::capacity;
  out.size[id - out.begin] = polygon.size;
  for (int k = 0; k < polygon.size; ++k) {
    const int j = polygon.neighbor[k];
    if (out.x) out.x[first + k] = polygon.x[k];
    if (out.y) out.y[first + k] = polygon.y[k];
    out.neighbor[first + k] = j < 0 ? j : view.caller[j];
  }
}

template <class Polygon, class Real = typename Polygon::Number>
__device__ inline Real cell_area(const Polygon& polygon)
{
  Real twice = 0;
  for (int k = 0; k < polygon.size; ++k) {
    const int l = polygon.next(k);
    twice += polygon.x[k] * polygon.y[l] - polygon.x[l] * polygon.y[k];
  }
  return twice / 2;
}

/// Writes the moments that are wanted.
template <class Real>
__device__ inline void write_moments(const Cell_outputs<Real>& out, int id,
                                     const Cell_moments<Real>& m, const Tangent_frame<Real>& frame)
{
  if (out.area) out.area[id] = m.area;
  if (out.mass) out.mass[id] = m.mass;
  if (out.offset) out.offset[id] = frame.u * m.x + frame.v * m.y;
}

/// Writes what is wanted of the cell of the site at `place`, but for the polygon in full.
template <class Real, class Polygon>
__device__ inline void write_cell(const Group_view<Real>& view, const Cell_outputs<Real>& out,
                                  int place, int id, Cell_status status, const Polygon& polygon,
                                  const Tangent_frame<Real>& frame)
{
  if (out.area && !out.mass && !out.offset) {
    out.area[id] = cell_area(polygon);
  } else if (out.area || out.mass || out.offset) {
    write_moments(out, id,
                  cell_moments(polygon, place, [&](int j) { return __ldg(view.density_root + j); }),
                  frame);
  }
  if (out.status) out.status[id] = static_cast<unsigned char>(status);
  if (out.edge_count) write_edges(view, out, place, id, polygon, frame);
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_CELL_OUTPUTS_CUH
