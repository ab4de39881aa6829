// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kernels of the backend's loops and reductions.
#ifndef CGAL_POWER_RTF_CUDA_KERNELS_CUH
#define CGAL_POWER_RTF_CUDA_KERNELS_CUH

#include "Eight_lanes.cuh"
#include "Warp_lanes.cuh"
#include "teams.cuh"
#include <CGAL/PowerRTF/internal/Single_lane.h>
#include <CGAL/PowerRTF/internal/Totals.h>

#include <cstddef>

namespace CGAL::PowerRTF::device {

template <class F>
__global__ void for_each_kernel(int n, F f)
{
  const int i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < n) f(i);
}

template <class F>
__global__ void for_each_by_one_kernel(int n, const __grid_constant__ F f)
{
  const int i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < n) f(i, Single_lane());
}

template <class F>
__global__ void for_each_by_eight_kernel(int n, const __grid_constant__ F f)
{
  const int i = (blockIdx.x * blockDim.x + threadIdx.x) / Eight_lanes::size;
  if (i < n) f(i, Eight_lanes());
}

template <class F>
__global__ void for_each_by_warp_kernel(int n, const __grid_constant__ F f)
{
  const int i = (blockIdx.x * blockDim.x + threadIdx.x) / Warp_lanes::size;
  if (i < n) f(i, Warp_lanes());
}

constexpr int reduction_threads = 256, reduction_blocks = 528;

/// Each block sums a fixed set of items; the block that ends last joins the blocks in a fixed
/// order.
template <int Sums, int Maxima, class F, class Finish>
__global__ void __launch_bounds__(reduction_threads)
    reduce_kernel(int n, F f, Finish finish, double* partials, unsigned* ticket)
{
  using T = Totals<Sums, Maxima>;
  constexpr int warps = reduction_threads / 32;
  __shared__ double of_warp[warps][T::size];
  T totals;
  totals.clear();
  for (int i = blockIdx.x * blockDim.x + threadIdx.x; i < n; i += gridDim.x * blockDim.x)
    f(i, totals);
  const int warp = threadIdx.x / 32, lane = threadIdx.x % 32;
#pragma unroll
  for (int k = 0; k < T::size; ++k) {
    double x = totals.values[k];
#pragma unroll
    for (int step = 16; step > 0; step /= 2)
      x = T::joined(k, x, __shfl_xor_sync(0xffffffffu, x, step));
    if (lane == 0) of_warp[warp][k] = x;
  }
  __syncthreads();
  for (int k = threadIdx.x; k < T::size; k += blockDim.x) {
    double x = of_warp[0][k];
    for (int w = 1; w < warps; ++w) x = T::joined(k, x, of_warp[w][k]);
    partials[blockIdx.x * T::size + k] = x;
  }
  if (!is_last_block(ticket)) return;
  const int blocks = gridDim.x;
  for (int k = warp; k < T::size; k += warps) {
    double x = k < Sums ? 0 : -1e300;
    for (int b = lane; b < blocks; b += 32) x = T::joined(k, x, __ldcg(partials + b * T::size + k));
    for (int step = 16; step > 0; step /= 2)
      x = T::joined(k, x, __shfl_xor_sync(0xffffffffu, x, step));
    if (lane == 0) of_warp[0][k] = x;
  }
  __syncthreads();
  if (threadIdx.x == 0) {
    for (int k = 0; k < T::size; ++k) totals.values[k] = of_warp[0][k];
    finish(totals);
    *ticket = 0; // for the next reduction of the stream
  }
}

/// By one block.
template <class F>
__global__ void __launch_bounds__(block_team_threads) sweeps_kernel(int n, int sweeps, const F f)
{
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    if (int(threadIdx.x) < n) f(sweep, threadIdx.x);
    __syncthreads();
  }
}

template <class T>
__global__ void fill_kernel(T* to, T value, std::size_t n)
{
  const std::size_t i = std::size_t(blockIdx.x) * blockDim.x + threadIdx.x;
  if (i < n) to[i] = value;
}

/// Two reductions by a team; see `Host_backend::reduce_twice()`.
template <class Rule>
struct Two_reductions {
  Rule rule;
  int n;

  template <class Team>
  __device__ void operator()(Team& team) const
  {
    typename Rule::First first;
    first.clear();
    for (int i = team.first(); i < n; i += team.stride()) rule.add_first(i, first);
    team.join(first);
    auto result = rule.middle(first);
    typename Rule::Second second;
    second.clear();
    for (int i = team.first(); i < n; i += team.stride()) rule.add_second(i, result, second);
    team.join(second);
    if (team.first() == 0) rule.finish(result, second);
  }
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_KERNELS_CUH
