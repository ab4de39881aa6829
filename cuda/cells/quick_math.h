// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fast approximate intrinsics.
#ifndef CGAL_POWER_RTF_CUDA_QUICK_MATH_H
#define CGAL_POWER_RTF_CUDA_QUICK_MATH_H

#include <CGAL/PowerRTF/geometry/vector.h>

namespace CGAL::PowerRTF::device {

// On the device these are off by a few units in the last place.
CGAL_POWER_RTF_HD inline float quick_sqrt(float x)
{
#ifdef __CUDA_ARCH__
  float root;
  asm("sqrt.approx.f32 %0, %1;" : "=f"(root) : "f"(x));
  return root;
#else
  return std::sqrt(x);
#endif
}
CGAL_POWER_RTF_HD inline double quick_sqrt(double x) { return std::sqrt(x); }
CGAL_POWER_RTF_HD inline float quick_quotient(float a, float b)
{
#ifdef __CUDA_ARCH__
  return __fdividef(a, b);
#else
  return a / b;
#endif
}
CGAL_POWER_RTF_HD inline double quick_quotient(double a, double b) { return a / b; }

template <class Real>
CGAL_POWER_RTF_HD inline Real greatest(Real a, Real b, Real c)
{
  return std::fmax(std::fmax(a, b), c);
}

#ifdef __CUDA_ARCH__
CGAL_POWER_RTF_HD inline int lowest_bit(unsigned bits) { return __ffs(int(bits)) - 1; }
CGAL_POWER_RTF_HD inline int highest_bit(unsigned bits) { return 31 - __clz(int(bits)); }
#else
CGAL_POWER_RTF_HD inline int lowest_bit(unsigned bits) { return __builtin_ctz(bits); }
CGAL_POWER_RTF_HD inline int highest_bit(unsigned bits) { return 31 - __builtin_clz(bits); }
#endif

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_QUICK_MATH_H
