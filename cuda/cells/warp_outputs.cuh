// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the results for the cell of a warp.
#ifndef CGAL_POWER_RTF_CUDA_WARP_OUTPUTS_CUH
#define CGAL_POWER_RTF_CUDA_WARP_OUTPUTS_CUH

#include "Warp_cell.cuh"
#include "cell_outputs.cuh"

#include <CGAL/PowerRTF/cells/clip_at_features.h>

namespace CGAL::PowerRTF::device {

/// The links of the patches' boundaries, as places; null: no features.
struct Feature_links {
  const int *next = nullptr, *previous = nullptr;
};

/// The cell in the warp's memory, for lane 0.
template <class Real>
__device__ inline Tangent_polygon<Real>& cell_in_memory(const Warp_cell<Real>& cell,
                                                        Warp_cell_memory<Real>& memory, int lane)
{
  const Warp_polygon<Real>& polygon = cell.polygon();
  const int neighbor = cell.neighbor();
  Tangent_polygon<Real>& result = memory.polygon();
  __syncwarp();
  if (lane < polygon.size) {
    result.x[lane] = polygon.x;
    result.y[lane] = polygon.y;
    result.neighbor[lane] = neighbor;
  }
  __syncwarp();
  if (lane == 0) {
    result.size = polygon.size;
    result.overflow = polygon.overflow;
  }
  return result;
}

/// Not inlined: few cells need it, and inlined its registers would count for all.
template <class Real>
__device__ __noinline__ void
cut_at_features(const Group_view<Real>& view, const Feature_links& links,
                const Tangent_frame<Real>& frame, int place, Tangent_polygon<Real>& polygon)
{
  Sites_view<Real> sites;
  sites.sites = reinterpret_cast<const Site<Real>*>(view.sites);
  clip_at_features(sites, place, links.next, links.previous, frame, polygon);
}

/// `cell_moments()`, a triangle for each lane; the same on all lanes.
template <class Real>
__device__ inline Cell_moments<Real> warp_moments(const Group_view<Real>& view,
                                                  const Warp_cell<Real>& cell, int place, int lane)
{
  const Warp_polygon<Real>& polygon = cell.polygon();
  const bool is_vertex = lane < polygon.size;
  const int next = lane + 1 < polygon.size ? lane + 1 : 0;
  const int before = lane > 0 ? lane - 1 : polygon.size - 1;
  const int neighbor = cell.neighbor();
  const Real own = view.density_root[place], at_site = own * own * own;
  const Real side = is_vertex && neighbor >= 0 ? view.density_root[neighbor] : own;
  const Real density = own * side * __shfl_sync(full_warp, side, before & 31);
  const Real next_density = __shfl_sync(full_warp, density, next);
  const Real x = polygon.x, y = polygon.y;
  const Real next_x = __shfl_sync(full_warp, x, next), next_y = __shfl_sync(full_warp, y, next);
  const Real area = is_vertex ? (x * next_y - next_x * y) / 2 : Real(0);
  const Real sum = at_site + density + next_density;
  Cell_moments<Real> m;
  m.area = warp_sum(area);
  m.mass = warp_sum(area != 0 ? area * sum / 3 : Real(0));
  const Real first = sum + density, second = sum + next_density;
  m.x = warp_sum(area != 0 ? area * (first * x + second * next_x) / 12 : Real(0));
  m.y = warp_sum(area != 0 ? area * (first * y + second * next_y) / 12 : Real(0));
  m.x = m.mass > 0 ? m.x / m.mass : Real(0);
  m.y = m.mass > 0 ? m.y / m.mass : Real(0);
  return m;
}

/// Writes what is wanted of the warp's cell.
template <class Real>
__device__ inline void
write_warp_cell(const Group_view<Real>& view, const Cell_targets<Real>& targets,
                const Feature_links& links, Warp_cell_memory<Real>& memory,
                const Warp_cell<Real>& cell, int place, int id, Cell_status status, int lane)
{
  const Cell_outputs<Real>& out = targets.out;
  if (view.has_features || targets.polygons.size || out.edge_count) {
    Tangent_polygon<Real>& polygon = cell_in_memory(cell, memory, lane);
    if (lane == 0) {
      if (targets.polygons.size) write_polygon(view, targets.polygons, id, polygon);
      if (view.has_features) cut_at_features(view, links, cell.frame(), place, polygon);
      write_cell(view, out, place, id, status, polygon, cell.frame());
    }
    __syncwarp();
    return;
  }
  const Cell_moments<Real> m = warp_moments(view, cell, place, lane);
  if (lane != 0) return;
  write_moments(out, id, m, cell.frame());
  if (out.status) out.status[id] = static_cast<unsigned char>(status);
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WARP_OUTPUTS_CUH
