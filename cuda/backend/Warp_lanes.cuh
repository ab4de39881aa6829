// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CUDA_WARP_LANES_CUH
#define CGAL_POWER_RTF_CUDA_WARP_LANES_CUH

namespace CGAL::PowerRTF::device {

/// The threads of a warp, that work on one item.
struct Warp_lanes {
  static constexpr int size = 32;
  static constexpr unsigned all = 0xffffffffu;
  static constexpr int in_block = 4; ///< items of a block

  __device__ int rank() const { return threadIdx.x % size; }
  __device__ bool leads() const { return rank() == 0; }

  template <class T>
  __device__ T from(T x, int rank) const
  {
    return __shfl_sync(all, x, rank);
  }
  template <class T>
  __device__ T from_before(T x, int distance = 1) const
  {
    return __shfl_up_sync(all, x, distance);
  }
  template <class T>
  __device__ T exchanged(T x, int distance) const
  {
    return __shfl_xor_sync(all, x, distance);
  }
  /// What a lane has written to shared memory the others may read.
  __device__ void synchronize() const { __syncwarp(); }
  __device__ unsigned those_with(bool x) const { return __ballot_sync(all, x); }
  /// The lanes of lower rank.
  __device__ unsigned those_before() const { return (1u << rank()) - 1; }
  /// Of this lane and those whose rank differs in the last three bits.
  __device__ float least_of_eight(float x) const
  {
#pragma unroll
    for (int step = 4; step > 0; step /= 2) x = fminf(x, exchanged(x, step));
    return x;
  }
  /// The first lane for which `x` holds, or -1.
  __device__ int first_with(bool x) const { return __ffs(int(those_with(x))) - 1; }
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WARP_LANES_CUH
