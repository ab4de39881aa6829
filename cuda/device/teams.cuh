// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Teams of threads that iterate within one kernel: one block for few items, all multiprocessors for
// many. Sums come in a fixed order, and each is a barrier for the memory of the team.
#ifndef CGAL_POWER_RTF_CUDA_TEAMS_CUH
#define CGAL_POWER_RTF_CUDA_TEAMS_CUH

#include <cooperative_groups.h>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

constexpr int block_team_threads = 1024, block_team_items = 8192;
constexpr int grid_team_threads = 256, grid_team_blocks = 1056, grid_team_sums = 4;

/// Sums over the block's threads; the result is valid in all of them.
template <int N>
__device__ inline void sum_over_block(double (&x)[N], double* shared)
{
  const int lane = threadIdx.x % 32, warp = threadIdx.x / 32, warps = blockDim.x / 32;
#pragma unroll
  for (int k = 0; k < N; ++k)
#pragma unroll
    for (int step = 16; step > 0; step /= 2) x[k] += __shfl_xor_sync(0xffffffffu, x[k], step);
  __syncthreads(); // `shared` may still be read
  if (lane == 0)
    for (int k = 0; k < N; ++k) shared[k * 32 + warp] = x[k];
  __syncthreads();
#pragma unroll
  for (int k = 0; k < N; ++k) {
    x[k] = lane < warps ? shared[k * 32 + lane] : 0;
#pragma unroll
    for (int step = 16; step > 0; step /= 2) x[k] += __shfl_xor_sync(0xffffffffu, x[k], step);
  }
}

struct Block_team {
  double* shared;

  __device__ int first() const { return threadIdx.x; }
  __device__ int stride() const { return blockDim.x; }
  template <int N>
  __device__ void sum(double (&x)[N])
  {
    sum_over_block(x, shared);
  }
};

struct Grid_team {
  double* shared;
  double* partials; // of two sums in turn
  int turn;

  __device__ int first() const { return blockIdx.x * blockDim.x + threadIdx.x; }
  __device__ int stride() const { return gridDim.x * blockDim.x; }
  template <int N>
  __device__ void sum(double (&x)[N])
  {
    static_assert(N <= grid_team_sums, "the partial sums have no room");
    double* const mine = partials + turn * grid_team_sums * grid_team_blocks;
    turn = 1 - turn;
    sum_over_block(x, shared);
    if (threadIdx.x < N) {
#pragma unroll
      for (int k = 0; k < N; ++k)
        if (int(threadIdx.x) == k) mine[k * grid_team_blocks + blockIdx.x] = x[k];
    }
    cooperative_groups::this_grid().sync();
#pragma unroll
    for (int k = 0; k < N; ++k) {
      x[k] = 0;
      for (int b = threadIdx.x; b < int(gridDim.x); b += blockDim.x)
        x[k] += __ldcg(mine + k * grid_team_blocks + b);
    }
    sum_over_block(x, shared);
  }
};

template <class F>
__global__ void __launch_bounds__(block_team_threads) block_team_kernel(const F f)
{
  __shared__ double shared[32 * grid_team_sums];
  Block_team team{shared};
  f(team);
}

template <class F>
__global__ void __launch_bounds__(grid_team_threads) grid_team_kernel(const F f, double* partials)
{
  __shared__ double shared[32 * grid_team_sums];
  Grid_team team{shared, partials, 0};
  f(team);
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_TEAMS_CUH
