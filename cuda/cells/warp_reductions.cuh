// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reductions over the lanes of a warp; all lanes get the result.
#ifndef CGAL_POWER_RTF_CUDA_WARP_REDUCTIONS_CUH
#define CGAL_POWER_RTF_CUDA_WARP_REDUCTIONS_CUH

namespace CGAL::PowerRTF::device {

constexpr unsigned full_warp = 0xffffffffu;

/// Reduces by `join(a, b)`, in the same order on all lanes.
template <class T, class Join>
__device__ inline T warp_reduce(T x, const Join& join)
{
#pragma unroll
  for (int step = 16; step > 0; step /= 2) x = join(x, __shfl_xor_sync(full_warp, x, step));
  return x;
}

template <class T>
__device__ inline T warp_sum(T x)
{
  return warp_reduce(x, [](T a, T b) { return a + b; });
}
template <class Real>
__device__ inline Real warp_min(Real x)
{
  return warp_reduce(x, [](Real a, Real b) { return fmin(a, b); });
}
template <class Real>
__device__ inline Real warp_max(Real x)
{
  return warp_reduce(x, [](Real a, Real b) { return fmax(a, b); });
}
__device__ inline int warp_min(int x)
{
#if __CUDA_ARCH__ >= 800
  return __reduce_min_sync(full_warp, x);
#else
  return warp_reduce(x, [](int a, int b) { return min(a, b); });
#endif
}

// Numbers that are not negative have the order of their bits, which the hardware reduces.

__device__ inline float warp_min_nonnegative(float x)
{
#if __CUDA_ARCH__ >= 800
  return __int_as_float(__reduce_min_sync(full_warp, __float_as_int(x)));
#else
  return warp_min(x);
#endif
}
__device__ inline float warp_max_nonnegative(float x)
{
#if __CUDA_ARCH__ >= 800
  return __int_as_float(__reduce_max_sync(full_warp, __float_as_int(x)));
#else
  return warp_max(x);
#endif
}
__device__ inline double warp_min_nonnegative(double x)
{
#if __CUDA_ARCH__ >= 800
  const int high = __reduce_min_sync(full_warp, __double2hiint(x));
  const unsigned low = __double2hiint(x) == high ? __double2loint(x) : 0xffffffffu;
  return __hiloint2double(high, int(__reduce_min_sync(full_warp, low)));
#else
  return warp_min(x);
#endif
}
__device__ inline double warp_max_nonnegative(double x)
{
#if __CUDA_ARCH__ >= 800
  const int high = __reduce_max_sync(full_warp, __double2hiint(x));
  const unsigned low = __double2hiint(x) == high ? __double2loint(x) : 0;
  return __hiloint2double(high, int(__reduce_max_sync(full_warp, low)));
#else
  return warp_max(x);
#endif
}

// atomicMax() of numbers that are not negative.

__device__ inline void atomic_max_nonnegative(float* p, float x)
{
  atomicMax(reinterpret_cast<int*>(p), __float_as_int(x));
}
__device__ inline void atomic_max_nonnegative(double* p, double x)
{
  atomicMax(reinterpret_cast<unsigned long long*>(p),
            static_cast<unsigned long long>(__double_as_longlong(x)));
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WARP_REDUCTIONS_CUH
