// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_TANGENT_FRAME_H
#define CGAL_POWER_RTF_GEOMETRY_TANGENT_FRAME_H

#include <CGAL/PowerRTF/geometry/vector.h>

namespace CGAL::PowerRTF {

/// An orthonormal frame (u, v) of the plane with unit normal `n`; u x v = n. (Duff et al.,
/// "Building an orthonormal basis, revisited", 2017.)
template <class FT>
struct Tangent_frame {
  Vec3<FT> u, v;

  CGAL_POWER_RTF_HD explicit Tangent_frame(const Vec3<FT>& n)
  {
    const FT sign = n.z < 0 ? FT(-1) : FT(1);
    const FT a = -1 / (sign + n.z), b = n.x * n.y * a;
    u = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    v = {b, sign + n.y * n.y * a, -n.y};
  }

  /// A vector's components along u and v.
  struct Components {
    FT a, b;
  };

  /// Those of `offset`, the square of whose length is `d2`; zero where rounding alone would give
  /// them their direction: `offset` is then parallel to the normal.
  CGAL_POWER_RTF_HD Components components(const Vec3<FT>& offset, FT d2) const
  {
    constexpr FT least_slope = 64 * internal::epsilon<FT>();
    const FT a = dot(offset, u), b = dot(offset, v);
    return a * a + b * b > least_slope * least_slope * d2 ? Components{a, b} : Components{0, 0};
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_TANGENT_FRAME_H
