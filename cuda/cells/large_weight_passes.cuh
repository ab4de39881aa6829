// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The passes of the paper's rule over the weights of many cells: a kernel for each step, since each
// keeps the device busy. (Fewer cells: list_weight_passes.cuh and warp_weight_passes.cuh.)
#ifndef CGAL_POWER_RTF_CUDA_LARGE_WEIGHT_PASSES_CUH
#define CGAL_POWER_RTF_CUDA_LARGE_WEIGHT_PASSES_CUH

#include "../device/teams.cuh"
#include "Large_pass_state.h"
#include "sort_sites.cuh"

#include <CGAL/PowerRTF/optimization/multiplicative_weights.h>

namespace CGAL {
namespace PowerRTF {
namespace device {

constexpr int sum_threads = 256;

/// The mean of f(0) .. f(n - 1), in a fixed order; the block that ends last writes it.
template <class F>
__device__ inline void mean_over_grid(int n, F&& f, double* partials, unsigned* ticket, double* out)
{
  __shared__ Team_memory memory;
  __shared__ bool is_last;
  Totals<1, 0> sum;
  sum.clear();
  for (int i = blockIdx.x * sum_threads + threadIdx.x; i < n; i += gridDim.x * sum_threads)
    sum.add(0, f(i));
  join_over_block(sum, memory);
  if (threadIdx.x == 0) {
    partials[blockIdx.x] = sum.sum(0);
    __threadfence();
    is_last = atomicAdd(ticket, 1u) == gridDim.x - 1;
  }
  __syncthreads();
  if (!is_last) return;
  sum.clear();
  for (int b = threadIdx.x; b < int(gridDim.x); b += sum_threads) sum.add(0, __ldcg(partials + b));
  join_over_block(sum, memory);
  if (threadIdx.x == 0) {
    *out = sum.sum(0) / n;
    *ticket = 0;
  }
}

template <class Real>
__global__ void __launch_bounds__(sum_threads)
mean_mass_kernel(int n, const Real* density, const Real* area, double* partials, unsigned* ticket,
                 Large_pass_state* state)
{
  mean_over_grid(n, [&](int i) { return double(density[i]) * area[i]; }, partials, ticket,
                 &state->mean_mass);
}

template <class Real>
__global__ void __launch_bounds__(sum_threads)
mean_weight_kernel(int n, const Packed_site<Real>* sites, double* partials, unsigned* ticket,
                   Large_pass_state* state)
{
  mean_over_grid(n, [&](int i) { return double(sites[i].weight); }, partials, ticket,
                 &state->mean_weight);
}

/// What the rule reads, in the caller's order.
template <class Real>
struct Pass_masses {
  const Real *density, *area, *first, *sixth;
  Multiplicative_weight_rule rule;
};

constexpr int change_threads = 256, changes_per_thread = 4; // of a node of level 1

/// One change of all weights, and of the largest ones in the nodes of levels 0 and 1. `compare`
/// with the weights that the lists were made for, or note these for lists that are to be made.
/// `open`: how many groups the lists did not suffice for.
template <class Real>
__global__ void __launch_bounds__(change_threads)
change_weights_kernel(const __grid_constant__ Pass_masses<Real> masses, int cells, const int* order,
                      Packed_site<Real>* sites, Group_node<Real>* nodes,
                      const __grid_constant__ Group_layout tree,
                      const __grid_constant__ Kept_lists<Real> lists, bool compare,
                      Large_pass_state* state, int pass, const int* open)
{
  static_assert(change_threads * changes_per_thread == Group_layout::arity * Group_layout::arity,
                "a block per node of level 1");
  constexpr int n = changes_per_thread;
  const int lane = threadIdx.x % 32, warp = threadIdx.x / 32;
  const int begin = blockIdx.x * change_threads * n + threadIdx.x;
  Multiplicative_weight_rule rule = masses.rule;
  rule.mean_mass = state->mean_mass;
  // Loads that wait together.
  int id[n];
  Real weight[n], before[n], area[n], density[n], first[n];
#pragma unroll
  for (int k = 0; k < n; ++k) {
    const int place = begin + k * change_threads;
    const bool exists = place < tree.items;
    id[k] = exists ? order[place] : cells;
    weight[k] = exists ? sites[place].weight : Real(-1e30);
    before[k] = exists && compare ? lists.weights[place] : weight[k];
  }
#pragma unroll
  for (int k = 0; k < n; ++k) {
    const bool has_cell = id[k] < cells;
    area[k] = has_cell ? masses.area[id[k]] : Real(0);
    density[k] = has_cell ? masses.density[id[k]] : Real(0);
    first[k] = has_cell ? masses.first[id[k]] : Real(0);
  }

  bool is_outside = false;
  Real most_weight = Real(-1e30), most_growth = 0;
#pragma unroll
  for (int k = 0; k < n; ++k) {
    const int place = begin + k * change_threads;
    if (id[k] < cells) {
      const double mass = double(density[k]) * area[k];
      is_outside |= fabs(mass / rule.mean_mass - 1) > rule.tolerance;
      weight[k] += Real(rule(mass, mass > 0 ? first[k] : masses.sixth[id[k]]));
      sites[place].weight = weight[k];
    }
    if (!compare && place < tree.items) lists.weights[place] = weight[k];
    const Real growth = warp_max(compare ? fmax(weight[k] - before[k], Real(0)) : Real(0));
    const Real heaviest = warp_max(weight[k]);
    if (lane == 0 && place < tree.items) {
      lists.growth[place / 32] = growth;
      nodes[place / 32].max_weight = heaviest;
    }
    most_growth = fmax(most_growth, growth);
    most_weight = fmax(most_weight, heaviest);
  }
  __shared__ Real growths[change_threads / 32], weights[change_threads / 32];
  if (lane == 0) {
    growths[warp] = most_growth;
    weights[warp] = most_weight;
  }
  is_outside = __syncthreads_or(is_outside);
  if (threadIdx.x != 0) return;
  for (int w = 1; w < change_threads / 32; ++w) {
    most_growth = fmax(most_growth, growths[w]);
    most_weight = fmax(most_weight, weights[w]);
  }
  if (most_growth > 0) atomic_raise(lists.all_growth, most_growth);
  if (tree.levels > 1) nodes[tree.first[1] + blockIdx.x].max_weight = most_weight;
  if (is_outside) state->outside[pass] = 1;
  if (blockIdx.x == 0) state->open = *open;
}

/// The largest weights of the nodes above level 1, by one block.
template <class Real>
__global__ void __launch_bounds__(1024)
raise_weights_kernel(Group_node<Real>* nodes, const __grid_constant__ Group_layout tree)
{
  const int warp = threadIdx.x / 32, lane = threadIdx.x % 32;
  for (int level = 2; level < tree.levels; ++level) {
    for (int k = warp; k < tree.nodes(level); k += 32) {
      const int child = k * Group_layout::arity + lane;
      const bool exists = child < tree.nodes(level - 1);
      const Real weight =
          warp_max(exists ? nodes[tree.first[level - 1] + child].max_weight : Real(-1e30));
      if (lane == 0) nodes[tree.first[level] + k].max_weight = weight;
    }
    __syncthreads();
  }
}

/// The weights less their mean, or as they are, in the caller's order.
template <class Real>
__global__ void give_weights_kernel(int n, int cells, const int* order,
                                    const Packed_site<Real>* sites, const Large_pass_state* state,
                                    bool subtract, Site<Real>* out)
{
  const int place = blockIdx.x * blockDim.x + threadIdx.x;
  if (place >= n || order[place] >= cells) return;
  out[order[place]].weight = Real(sites[place].weight - (subtract ? state->mean_weight : 0));
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_LARGE_WEIGHT_PASSES_CUH
