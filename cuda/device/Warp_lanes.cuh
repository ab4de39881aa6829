// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CUDA_WARP_LANES_CUH
#define CGAL_POWER_RTF_CUDA_WARP_LANES_CUH

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// The threads of a warp, that work on one item.
struct Warp_lanes {
  static constexpr int size = 32;
  static constexpr unsigned all = 0xffffffffu;

  __device__ int rank() const { return threadIdx.x % size; }
  __device__ bool leads() const { return rank() == 0; }

  template <class T>
  __device__ T from(T x, int rank) const
  {
    return __shfl_sync(all, x, rank);
  }
  template <class T>
  __device__ T from_before(T x) const
  {
    return __shfl_up_sync(all, x, 1);
  }
  template <class T>
  __device__ T exchanged(T x, int distance) const
  {
    return __shfl_xor_sync(all, x, distance);
  }
  __device__ unsigned those_with(bool x) const { return __ballot_sync(all, x); }
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_WARP_LANES_CUH
