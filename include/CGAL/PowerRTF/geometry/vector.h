// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plain 3D vectors for host and device. No CGAL, no STL containers.
#ifndef CGAL_POWER_RTF_GEOMETRY_VECTOR_H
#define CGAL_POWER_RTF_GEOMETRY_VECTOR_H

#include <CGAL/PowerRTF/internal/host_device.h>

#include <cmath>

namespace CGAL::PowerRTF {

/// A vector or a point of R^3; trivially copyable.
template <class FT>
struct Vec3 {
  FT x, y, z;

  CGAL_POWER_RTF_HD Vec3& operator+=(const Vec3& o)
  {
    x += o.x;
    y += o.y;
    z += o.z;
    return *this;
  }
  CGAL_POWER_RTF_HD Vec3& operator-=(const Vec3& o)
  {
    x -= o.x;
    y -= o.y;
    z -= o.z;
    return *this;
  }
  CGAL_POWER_RTF_HD Vec3& operator*=(FT s)
  {
    x *= s;
    y *= s;
    z *= s;
    return *this;
  }

  CGAL_POWER_RTF_HD friend Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
  CGAL_POWER_RTF_HD friend Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
  CGAL_POWER_RTF_HD friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  CGAL_POWER_RTF_HD friend Vec3 operator*(FT s, Vec3 a) { return a *= s; }
  CGAL_POWER_RTF_HD friend Vec3 operator*(Vec3 a, FT s) { return a *= s; }
  CGAL_POWER_RTF_HD friend bool operator==(const Vec3& a, const Vec3& b)
  {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
  CGAL_POWER_RTF_HD friend bool operator!=(const Vec3& a, const Vec3& b) { return !(a == b); }
};

template <class FT>
CGAL_POWER_RTF_HD inline FT dot(const Vec3<FT>& a, const Vec3<FT>& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class FT>
CGAL_POWER_RTF_HD inline Vec3<FT> cross(const Vec3<FT>& a, const Vec3<FT>& b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class FT>
CGAL_POWER_RTF_HD inline FT squared_length(const Vec3<FT>& a)
{
  return dot(a, a);
}

template <class FT>
CGAL_POWER_RTF_HD inline FT length(const Vec3<FT>& a)
{
  return std::sqrt(dot(a, a));
}

/// `a` scaled to length 1; `a` itself when it has no direction.
template <class FT>
CGAL_POWER_RTF_HD inline Vec3<FT> normalized(const Vec3<FT>& a)
{
  const FT l = length(a);
  return l > 0 ? a * (FT(1) / l) : a;
}

using Vec3d = Vec3<double>;

namespace internal {
/// Machine epsilon (std::numeric_limits is not for device code).
template <class FT>
CGAL_POWER_RTF_HD constexpr FT epsilon();
template <>
CGAL_POWER_RTF_HD constexpr double epsilon<double>()
{
  return 2.220446049250313e-16;
}
template <>
CGAL_POWER_RTF_HD constexpr float epsilon<float>()
{
  return 1.1920929e-7f;
}
} // namespace internal

template <class Real>
CGAL_POWER_RTF_HD inline Vec3<Real> to_real(const Vec3d& p)
{
  return {Real(p.x), Real(p.y), Real(p.z)};
}
template <class Real>
CGAL_POWER_RTF_HD inline Vec3d to_double(const Vec3<Real>& p)
{
  return {double(p.x), double(p.y), double(p.z)};
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_VECTOR_H
