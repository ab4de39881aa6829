// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Atomic operations on plain memory, for the host's threads or the device's.
#ifndef CGAL_POWER_RTF_INTERNAL_ATOMICS_H
#define CGAL_POWER_RTF_INTERNAL_ATOMICS_H

#include <CGAL/PowerRTF/internal/host_device.h>

namespace CGAL::PowerRTF {

/// Returns the value before.
CGAL_POWER_RTF_HD inline int atomic_add(int* p, int x)
{
#ifdef __CUDA_ARCH__
  return atomicAdd(p, x);
#else
  return __atomic_fetch_add(p, x, __ATOMIC_RELAXED);
#endif
}

CGAL_POWER_RTF_HD inline void atomic_add(long long* p, long long x)
{
#ifdef __CUDA_ARCH__
  atomicAdd(reinterpret_cast<unsigned long long*>(p), static_cast<unsigned long long>(x));
#else
  __atomic_fetch_add(p, x, __ATOMIC_RELAXED);
#endif
}

/// Whether `x` is less than what stood there.
CGAL_POWER_RTF_HD inline bool atomic_min(int* p, int x)
{
#ifdef __CUDA_ARCH__
  return x < atomicMin(p, x);
#else
  int before = __atomic_load_n(p, __ATOMIC_RELAXED);
  while (x < before)
    if (__atomic_compare_exchange_n(p, &before, x, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
      return true;
  return false;
#endif
}

/// Returns the value before.
CGAL_POWER_RTF_HD inline int atomic_exchange(int* p, int x)
{
#ifdef __CUDA_ARCH__
  return atomicExch(p, x);
#else
  return __atomic_exchange_n(p, x, __ATOMIC_RELAXED);
#endif
}

#ifndef __CUDA_ARCH__
/// Writes `x` if it is larger than what stands there.
inline void atomic_max(int* p, int x)
{
  int before = __atomic_load_n(p, __ATOMIC_RELAXED);
  while (before < x &&
         !__atomic_compare_exchange_n(p, &before, x, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
}

#endif

/// What other threads may have written meanwhile.
CGAL_POWER_RTF_HD inline double atomic_load(const double* p)
{
#ifdef __CUDA_ARCH__
  return *static_cast<const volatile double*>(p);
#else
  double x;
  __atomic_load(p, &x, __ATOMIC_RELAXED);
  return x;
#endif
}

/// Whether `x` is less than what stood there; on a device, neither may be negative.
CGAL_POWER_RTF_HD inline bool atomic_min(double* p, double x)
{
  double before = atomic_load(p);
#ifdef __CUDA_ARCH__
  if (!(x < before)) return false;
  const auto bits = static_cast<unsigned long long>(__double_as_longlong(x)); // in the same order
  return bits < atomicMin(reinterpret_cast<unsigned long long*>(p), bits);
#else
  while (x < before)
    if (__atomic_compare_exchange(p, &before, &x, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED))
      return true;
  return false;
#endif
}

/// Writes `x` where `expected` stands; returns what stood there.
CGAL_POWER_RTF_HD inline int atomic_exchange_if(int* p, int expected, int x)
{
#ifdef __CUDA_ARCH__
  return atomicCAS(p, expected, x);
#else
  __atomic_compare_exchange_n(p, &expected, x, false, __ATOMIC_RELAXED, __ATOMIC_RELAXED);
  return expected;
#endif
}

/// What other threads may have written meanwhile.
CGAL_POWER_RTF_HD inline int atomic_load(const int* p)
{
#ifdef __CUDA_ARCH__
  return *static_cast<const volatile int*>(p);
#else
  return __atomic_load_n(p, __ATOMIC_RELAXED);
#endif
}

CGAL_POWER_RTF_HD inline void atomic_store(int* p, int x)
{
#ifdef __CUDA_ARCH__
  *static_cast<volatile int*>(p) = x;
#else
  __atomic_store_n(p, x, __ATOMIC_RELAXED);
#endif
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INTERNAL_ATOMICS_H
