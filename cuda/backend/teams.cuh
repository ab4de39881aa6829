// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Teams of threads that iterate within one kernel: one block for few items, all multiprocessors for
// many. Sums come in a fixed order, and each is a barrier for the memory of the team.
#ifndef CGAL_POWER_RTF_CUDA_TEAMS_CUH
#define CGAL_POWER_RTF_CUDA_TEAMS_CUH

#include <CGAL/PowerRTF/internal/Totals.h>

#include <cooperative_groups.h>

namespace CGAL::PowerRTF::device {

constexpr int block_team_threads = 1024, block_team_items = 8192;
constexpr int grid_team_threads = 256, grid_team_blocks = 1056;
constexpr int max_team_totals = 8;

/// Whether all other blocks have called this, and what they wrote before it can be read. To be
/// called by all threads of a block. `*ticket`: 0 before the kernel, and to be set to 0 by the last
/// block.
__device__ inline bool is_last_block(unsigned* ticket)
{
  __shared__ bool is_last;
  __threadfence();
  __syncthreads();
  if (threadIdx.x == 0) is_last = atomicAdd(ticket, 1u) == gridDim.x - 1;
  __syncthreads();
  if (!is_last) return false;
  __threadfence();
  return true;
}

/// What the threads of a block need to add up.
struct Team_memory {
  double of_warps[max_team_totals][32], totals[max_team_totals];
};

/// Joins the totals of a warp's lanes: that number k in lane 32 / Slots * k and those after it,
/// where `Slots` >= T::size is a power of two. The lanes halve the numbers that each looks after.
template <int Slots, class T>
__device__ inline double join_over_warp(const T& totals)
{
  const int lane = threadIdx.x % 32;
  double x[Slots];
#pragma unroll
  for (int k = 0; k < Slots; ++k) x[k] = k < T::size ? totals.values[k] : 0;
  int first = 0, step = 16; // number of x[0]
#pragma unroll
  for (int half = Slots / 2; half > 0; half /= 2, step /= 2) {
    const bool is_upper = lane & step;
    if (is_upper) first += half;
#pragma unroll
    for (int k = 0; k < half; ++k) {
      const double kept = is_upper ? x[k + half] : x[k], given = is_upper ? x[k] : x[k + half];
      x[k] = T::joined(first + k, kept, __shfl_xor_sync(0xffffffffu, given, step));
    }
  }
#pragma unroll
  for (int rest = 16 / Slots; rest > 0; rest /= 2)
    x[0] = T::joined(first, x[0], __shfl_xor_sync(0xffffffffu, x[0], rest));
  return x[0];
}

/// Joins the totals of the block's threads; the result is valid in all of them.
template <class T>
__device__ inline void join_over_block(T& totals, Team_memory& memory)
{
  static_assert(T::size <= max_team_totals, "the totals have no room");
  constexpr int slots = T::size > 4 ? 8 : T::size > 2 ? 4 : T::size;
  const int lane = threadIdx.x % 32, warp = threadIdx.x / 32, warps = blockDim.x / 32;
  const double x = join_over_warp<slots>(totals);
  if (lane % (32 / slots) == 0) memory.of_warps[lane / (32 / slots)][warp] = x;
  __syncthreads();
  for (int k = warp; k < T::size; k += warps) {
    double y = memory.of_warps[k][lane < warps ? lane : 0];
    if (lane >= warps && k < T::sums) y = 0;
#pragma unroll
    for (int step = 16; step > 0; step /= 2)
      y = T::joined(k, y, __shfl_xor_sync(0xffffffffu, y, step));
    if (lane == 0) memory.totals[k] = y;
  }
  __syncthreads();
#pragma unroll
  for (int k = 0; k < T::size; ++k) totals.values[k] = memory.totals[k];
}

struct Block_team {
  Team_memory& memory;

  __device__ int first() const { return threadIdx.x; }
  __device__ int stride() const { return blockDim.x; }
  /// Joins the totals of all threads, for all of them.
  template <class T>
  __device__ void join(T& totals)
  {
    join_over_block(totals, memory);
  }
};

struct Grid_team {
  Team_memory& memory;
  double* partials; // of two joinings in turn
  int turn;

  static constexpr int warp = 32;
  /// Over the threads of this one's warp.
  __device__ double sum_over_warp(double x) const
  {
#pragma unroll
    for (int step = warp / 2; step > 0; step /= 2) x += __shfl_xor_sync(0xffffffffu, x, step);
    return x;
  }

  __device__ int first() const { return blockIdx.x * blockDim.x + threadIdx.x; }
  __device__ int stride() const { return gridDim.x * blockDim.x; }
  template <class T>
  __device__ void join(T& totals)
  {
    double* const mine = partials + turn * max_team_totals * grid_team_blocks;
    turn = 1 - turn;
    join_over_block(totals, memory);
#pragma unroll
    for (int k = 0; k < T::size; ++k)
      if (int(threadIdx.x) == k) mine[k * grid_team_blocks + blockIdx.x] = totals.values[k];
    cooperative_groups::this_grid().sync();
    totals.clear();
#pragma unroll
    for (int k = 0; k < T::size; ++k)
      for (int b = threadIdx.x; b < int(gridDim.x); b += blockDim.x)
        totals.values[k] = T::joined(k, totals.values[k], __ldcg(mine + k * grid_team_blocks + b));
    join_over_block(totals, memory);
  }
};

template <class F>
__global__ void __launch_bounds__(block_team_threads) block_team_kernel(const F f)
{
  __shared__ Team_memory memory;
  Block_team team{memory};
  f(team);
}

template <class F>
__global__ void __launch_bounds__(grid_team_threads) grid_team_kernel(const F f, double* partials)
{
  __shared__ Team_memory memory;
  Grid_team team{memory, partials, 0};
  f(team);
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_TEAMS_CUH
