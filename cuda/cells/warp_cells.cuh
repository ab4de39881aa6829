// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 1 by a warp for each cell: all cells, where they are few, else those that the groups of
// cells have deferred. And distances of sites, also by warps.
#ifndef CGAL_POWER_RTF_CUDA_WARP_CELLS_CUH
#define CGAL_POWER_RTF_CUDA_WARP_CELLS_CUH

#include "warp_outputs.cuh"

namespace CGAL::PowerRTF::device {

template <class Real>
constexpr int cell_warps = sizeof(Real) == 4 ? 4 : 2; // of a block: 48 KB of shared memory

/// A radius to begin with: the second distance to the sites before and after on the curve.
template <class Real>
__device__ inline Real guess_of_radius(const Group_view<Real>& view, int place, int lane)
{
  constexpr Real infinity = Real(1e30);
  const int other = place - 16 + lane;
  Real d2 = infinity;
  if (other >= 0 && other < view.tree.items && other != place)
    d2 = squared_length(load(view.sites + other).point - load(view.sites + place).point);
  if (!(d2 > 0)) d2 = infinity;
  const Real first = warp_min(d2);
  if (__ffs(int(__ballot_sync(full_warp, d2 == first))) - 1 == lane) d2 = infinity;
  const Real second = warp_min(d2);
  return second < infinity ? std::sqrt(second) : first < infinity ? std::sqrt(first) : Real(1);
}

/// Where the search for the sixth neighbor begins. `radius`: the cell's, or -guard radius.
template <class Real>
__device__ inline Real guess_of_sixth(const Group_view<Real>& view, Real radius)
{
  if (radius > 0) return 2 * radius; // a little more than the spacing
  return Real(-1.15) * radius / fmax(Real(1), fmin(view.guard_factor, Real(8)));
}

/// Makes the cell of the site at `place` by all lanes together. `radius`: the last one, if that was
/// ok, else -guard radius or anything below 0.
template <class Real>
__device__ inline void make_warp_cell(const Group_view<Real>& view,
                                      const Cell_targets<Real>& targets, const Feature_links& links,
                                      Warp_cell_memory<Real>& memory, int place, Real radius,
                                      int lane)
{
  const int id = view.caller[place];
  Warp_cell<Real> cell(view, memory, place, lane);
  Kept_sites<Real> kept;
  Real guard = targets.guard[place];
  const Cell_status status = cell.construct(Current_weights<Real>(cell.site().weight), radius,
                                            guard, guess_of_sixth(view, radius), kept);
  radius = status == Cell_status::ok ? cell.radius() : -guard;
  if (lane == 0) {
    if (radius != 0) targets.radius[id] = radius;
    targets.guard[place] = guard;
  }
  write_warp_cell(view, targets, links, memory, cell, place, id, status, lane);
}

/// The deferred cells. `next_count`: the counter of the next construction, to be cleared.
template <class Real>
__global__ void __launch_bounds__(32 * cell_warps<Real>)
    deferred_cells_kernel(const __grid_constant__ Group_view<Real> view,
                          const __grid_constant__ Cell_targets<Real> targets,
                          const __grid_constant__ Feature_links links, int* next_count)
{
  __shared__ Warp_cell_memory<Real> memories[cell_warps<Real>];
  if (blockIdx.x == 0 && threadIdx.x == 0) *next_count = 0;
  const int count = *targets.deferred_count, warps = gridDim.x * cell_warps<Real>;
  // The first cells lie in different blocks.
  for (int k = threadIdx.x / 32 * gridDim.x + blockIdx.x; k < count; k += warps) {
    const int place = targets.deferred[k];
    make_warp_cell(view, targets, links, memories[threadIdx.x / 32], place,
                   -std::fabs(targets.radius[view.caller[place]]), threadIdx.x % 32);
  }
}

/// All cells, where they are so few that there is a warp for each.
template <class Real>
__global__ void __launch_bounds__(32 * cell_warps<Real>, sizeof(Real) == 4 ? 5 : 2)
    warp_cells_kernel(const __grid_constant__ Group_view<Real> view,
                      const __grid_constant__ Cell_targets<Real> targets,
                      const __grid_constant__ Feature_links links)
{
  __shared__ Warp_cell_memory<Real> memories[cell_warps<Real>];
  const int place = blockIdx.x * cell_warps<Real> + threadIdx.x / 32, lane = threadIdx.x % 32;
  if (place >= view.tree.items || view.caller[place] >= view.cells) return;
  const Real last = targets.radius[view.caller[place]];
  const Real radius = last != 0 ? last : guess_of_radius(view, place, lane);
  make_warp_cell(view, targets, links, memories[threadIdx.x / 32], place, radius, lane);
}

/// Distances of the cells' sites to their first and sixth neighbors, one warp each.
template <class Real>
__global__ void __launch_bounds__(32 * cell_warps<Real>)
    neighbor_distances_kernel(const __grid_constant__ Group_view<Real> view, Real cos_angle,
                              const Real* radius, Real* first, Real* sixth)
{
  __shared__ Search_stack stacks[cell_warps<Real>];
  const int lane = threadIdx.x % 32, place = (blockIdx.x * blockDim.x + threadIdx.x) / 32;
  if (place >= view.tree.items) return;
  const int id = view.caller[place];
  if (id >= view.cells) return;
  const Neighbor_distances<Real> d =
      neighbor_distances(view, stacks[threadIdx.x / 32], place, guess_of_sixth(view, radius[id]),
                         {cos_angle, cos_angle}, sixth ? 6 : 1, lane);
  if (lane != 0) return;
  if (first) first[id] = d.first;
  if (sixth) sixth[id] = d.sixth;
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WARP_CELLS_CUH
