// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SMOOTHING_SYMMETRIC_MATRIX_H
#define CGAL_POWER_RTF_SMOOTHING_SYMMETRIC_MATRIX_H

#include <CGAL/PowerRTF/geometry/vector.h>

namespace CGAL::PowerRTF::internal {

/// A symmetric matrix of size 3.
template <class FT>
struct Symmetric_matrix {
  FT xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  /// Adds w d d^T.
  CGAL_POWER_RTF_HD void add(const Vec3<FT>& d, FT w)
  {
    xx += w * d.x * d.x, xy += w * d.x * d.y, xz += w * d.x * d.z;
    yy += w * d.y * d.y, yz += w * d.y * d.z, zz += w * d.z * d.z;
  }
  CGAL_POWER_RTF_HD void add_identity(FT w) { xx += w, yy += w, zz += w; }

  CGAL_POWER_RTF_HD Vec3<FT> operator*(const Vec3<FT>& v) const
  {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z};
  }

  /// 0 if the matrix is not positive definite.
  CGAL_POWER_RTF_HD Symmetric_matrix inverse() const
  {
    const Vec3<FT> a{xx, xy, xz}, b{xy, yy, yz}, c{xz, yz, zz};
    const Vec3<FT> bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const FT determinant = dot(a, bc);
    if (!(determinant > 0)) return {};
    const FT i = 1 / determinant;
    return {i * bc.x, i * bc.y, i * bc.z, i * ca.y, i * ca.z, i * ab.z};
  }

  CGAL_POWER_RTF_HD Symmetric_matrix<float> rounded() const
  {
    return {float(xx), float(xy), float(xz), float(yy), float(yz), float(zz)};
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_SYMMETRIC_MATRIX_H
