// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 2, lines 3 to 10: the passes of the paper's rule over the weights in one cooperative
// kernel. Cells come from kept lists; those that these do not prove are made as in the second pass.
// The barriers between the steps carry the mean mass and whether any mass is outside the interval.
#ifndef CGAL_POWER_RTF_CUDA_WEIGHT_PASSES_CUH
#define CGAL_POWER_RTF_CUDA_WEIGHT_PASSES_CUH

#include "Weight_pass_state.h"
#include "group_cells.cuh"
#include "second_pass.cuh"

#include <CGAL/PowerRTF/optimization/multiplicative_weights.h>

#include <cooperative_groups.h>

namespace CGAL {
namespace PowerRTF {
namespace device {

template <class Real>
struct Weight_pass_arguments {
  Group_view<Real> view;
  Kept_lists<Real> lists;
  Cell_targets<Real> targets; ///< out.area: of the current weights
  Feature_links links;
  Packed_site<Real>* sites = nullptr; ///< those of `view`, to be written
  Group_node<Real>* nodes = nullptr;
  Site<Real>* caller_sites = nullptr;
  const Real *density = nullptr, *first = nullptr, *sixth = nullptr; ///< the caller's order
  Multiplicative_weight_rule rule{};
  int passes = 0;
  double* partials = nullptr; ///< 2 per block
  Weight_pass_state* state = nullptr;
};

/// Sum over the block's threads, valid on thread 0; in a fixed order.
__device__ inline double block_sum(double x)
{
  __shared__ double of_warps[32];
#pragma unroll
  for (int step = 16; step > 0; step /= 2) x += __shfl_xor_sync(full_warp, x, step);
  __syncthreads();
  if (threadIdx.x % 32 == 0) of_warps[threadIdx.x / 32] = x;
  __syncthreads();
  double sum = 0;
  for (int w = 0; w < int(blockDim.x) / 32; ++w) sum += of_warps[w];
  return sum;
}

/// Sum of what all blocks have left, the same on all threads of all blocks.
__device__ inline double grid_sum(const double* partials)
{
  double x = 0;
  for (int b = threadIdx.x; b < int(gridDim.x); b += blockDim.x) x += __ldcg(partials + b);
  return block_sum(x);
}

template <class Real>
union Pass_memory {
  Ring_memory<Real, 32> polygons;
  Second_memory<Real> second;
  __device__ Pass_memory() {}
};

/// The largest weights of the nodes above level 0.
template <class Real>
__device__ inline void refit_weights(const Weight_pass_arguments<Real>& a,
                                     const cooperative_groups::grid_group& grid, int warp,
                                     int warps, int lane)
{
  const Group_layout& tree = a.view.tree;
  for (int level = 1; level < tree.levels; ++level) {
    for (int k = warp; k < tree.nodes(level); k += warps) {
      const int child = k * Group_layout::arity + lane;
      const bool exists = child < tree.nodes(level - 1);
      const Real weight =
          warp_max(exists ? a.nodes[tree.first[level - 1] + child].max_weight : Real(-1e30));
      if (lane == 0) a.nodes[tree.first[level] + k].max_weight = weight;
    }
    grid.sync();
  }
}

// The cells that need the second pass are few: registers are for the others.
template <class Real>
__global__ void __launch_bounds__(32 * group_warps<Real>, sizeof(Real) == 4 ? 5 : 4)
weight_passes_kernel(const __grid_constant__ Weight_pass_arguments<Real> a)
{
  const cooperative_groups::grid_group grid = cooperative_groups::this_grid();
  __shared__ Pass_memory<Real> memories[group_warps<Real>];
  Pass_memory<Real>& memory = memories[threadIdx.x / 32];
  const Group_view<Real>& view = a.view;
  const int lane = threadIdx.x % 32;
  const int warp = (blockIdx.x * blockDim.x + threadIdx.x) / 32;
  const int warps = gridDim.x * blockDim.x / 32, groups = view.tree.nodes(0);
  Real* const area = a.targets.out.area;
  double* const masses = a.partials;
  double* const weights = a.partials + gridDim.x;
  // Calls f(place, id) for the cells of this warp.
  const auto for_each_cell = [&](auto&& f) {
    for (int group = warp; group < groups; group += warps) {
      const int place = group * 32 + lane;
      if (place < view.tree.items && view.caller[place] < view.cells) f(place, view.caller[place]);
    }
  };
  const auto leave_masses = [&]() {
    double mass = 0;
    for_each_cell([&](int, int id) { mass += double(a.density[id]) * area[id]; });
    mass = block_sum(mass);
    if (threadIdx.x == 0) masses[blockIdx.x] = mass;
  };

  int usually_left = view.cells; // cells that have no list
  for (int pass = 0;; ++pass) {
    int* const rest = a.state->rest + pass;
    if (pass > 0) {
      for (int group = warp; group < groups; group += warps) {
        const Real near = near_growth(a.lists, group, lane);
        const int place = group * 32 + lane;
        if (place >= view.tree.items || view.caller[place] >= view.cells) continue;
        Lane_cell<Real> cell;
        cell.place = place;
        cell.site = load(view.sites + place);
        const Tangent_frame<Real> frame(load(view.normals + place).normal);
        Ring_polygon<Real, 32> polygon(memory.polygons, lane);
        if (make_kept(view, a.lists, cell, frame, near, polygon)) {
          const Listed_polygon<Real> listed(polygon, nullptr, 0);
          area[view.caller[place]] = cell_area(listed);
        } else {
          a.targets.rest[atomicAdd(rest, 1)] = place;
        }
      }
    }
    leave_masses();
    grid.sync();
    const int left = pass > 0 ? __ldcg(rest) : 0;
    if (pass == 1) usually_left = left;
    if (left > 0) {
      refit_weights(a, grid, warp, warps, lane);
      for (int k = warp; k < left; k += warps)
        second_pass_cell(view, a.targets, a.links, memory.second, __ldcg(a.targets.rest + k), lane);
      grid.sync();
      leave_masses();
      grid.sync();
    }

    Multiplicative_weight_rule rule = a.rule;
    rule.mean_mass = grid_sum(masses) / view.cells;
    bool is_outside = false;
    Real most = 0;
    for (int group = warp; group < groups; group += warps) {
      const int place = group * 32 + lane;
      const bool exists = place < view.tree.items;
      Real weight = exists ? a.sites[place].weight : Real(-1e30), growth = 0;
      if (exists && view.caller[place] < view.cells) {
        const int id = view.caller[place];
        const double mass = double(a.density[id]) * area[id];
        is_outside |= fabs(mass / rule.mean_mass - 1) > rule.tolerance;
        weight += Real(rule(mass, mass > 0 ? a.first[id] : a.sixth[id]));
        a.sites[place].weight = weight;
        growth = fmax(weight - a.lists.weights[place], Real(0));
      }
      growth = warp_max(growth);
      weight = warp_max(weight);
      if (lane == 0) {
        a.lists.growth[group] = growth;
        a.nodes[group].max_weight = weight;
      }
      most = fmax(most, growth);
    }
    if (lane == 0 && most > 0) atomic_raise(a.lists.all_growth, most);
    if (__any_sync(full_warp, is_outside) && lane == 0) a.state->outside[pass] = 1;
    grid.sync();
    const bool equal = __ldcg(a.state->outside + pass) == 0;
    // Where many cells are not proved by their lists, new lists are better.
    if (equal || pass + 1 == a.passes || left > usually_left + view.cells / 16) {
      if (grid.thread_rank() == 0) {
        a.state->done = pass + !equal;
        a.state->equal = equal;
      }
      break;
    }
  }

  double mean = 0;
  if (view.cells == view.tree.items) { // else the weights are relative to those of the features
    double sum = 0;
    for_each_cell([&](int place, int) { sum += a.sites[place].weight; });
    sum = block_sum(sum);
    if (threadIdx.x == 0) weights[blockIdx.x] = sum;
    grid.sync();
    mean = grid_sum(weights) / view.cells;
  }
  for_each_cell(
      [&](int place, int id) { a.caller_sites[id].weight = Real(a.sites[place].weight - mean); });
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_WEIGHT_PASSES_CUH
