// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eight threads of a warp that work on one item: one for each child of a node of a packed tree.
#ifndef CGAL_POWER_RTF_CUDA_EIGHT_LANES_CUH
#define CGAL_POWER_RTF_CUDA_EIGHT_LANES_CUH

namespace CGAL::PowerRTF::device {

struct Eight_lanes {
  static constexpr int size = 8;

  __device__ int rank() const { return threadIdx.x % size; }
  __device__ unsigned mask() const { return 0xffu << (threadIdx.x % 32 / size * size); }
  __device__ bool leads() const { return rank() == 0; }

  template <class T>
  __device__ T from(T x, int rank) const
  {
    return __shfl_sync(mask(), x, rank, size);
  }
  template <class T>
  __device__ T exchanged(T x, int distance) const
  {
    return __shfl_xor_sync(mask(), x, distance, size);
  }

  __device__ float least_of_eight(float x) const
  {
#pragma unroll
    for (int step = size / 2; step > 0; step /= 2) x = fminf(x, exchanged(x, step));
    return x;
  }
  /// The first lane for which `x` holds, or -1.
  __device__ int first_with(bool x) const
  {
    return __ffs(__ballot_sync(mask(), x) >> (threadIdx.x % 32 / size * size) & 0xffu) - 1;
  }
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_EIGHT_LANES_CUH
