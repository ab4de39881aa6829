// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Atomic operations, plain ones on the host.
#ifndef CGAL_POWER_RTF_CUDA_ATOMICS_H
#define CGAL_POWER_RTF_CUDA_ATOMICS_H

#include <CGAL/PowerRTF/cells/vector.h>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// Returns the value before.
CGAL_POWER_RTF_HD inline int atomic_add(int* p, int x)
{
#ifdef __CUDA_ARCH__
  return atomicAdd(p, x);
#else
  const int before = *p;
  *p += x;
  return before;
#endif
}

CGAL_POWER_RTF_HD inline void atomic_add(long long* p, long long x)
{
#ifdef __CUDA_ARCH__
  atomicAdd(reinterpret_cast<unsigned long long*>(p), static_cast<unsigned long long>(x));
#else
  *p += x;
#endif
}

/// Writes `x` where `expected` stands; returns what stood there.
CGAL_POWER_RTF_HD inline int atomic_exchange_if(int* p, int expected, int x)
{
#ifdef __CUDA_ARCH__
  return atomicCAS(p, expected, x);
#else
  const int before = *p;
  if (before == expected) *p = x;
  return before;
#endif
}

/// What other threads may have written meanwhile.
CGAL_POWER_RTF_HD inline int fresh(const int* p) { return *static_cast<const volatile int*>(p); }

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_ATOMICS_H
