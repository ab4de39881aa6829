// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order along a space-filling curve, made where a backend works: `spatial_order()`.
#ifndef CGAL_POWER_RTF_ENGINES_CURVE_ORDER_H
#define CGAL_POWER_RTF_ENGINES_CURVE_ORDER_H

#include <CGAL/PowerRTF/geometry/hilbert_code.h>
#include <CGAL/PowerRTF/internal/Totals.h>

#include <cstdint>

namespace CGAL::PowerRTF::internal {

/// The box around points, each corner's coordinates as maxima.
struct Extend_box {
  const Vec3d* points;

  CGAL_POWER_RTF_HD void operator()(int v, Totals<0, 6>& box) const
  {
    const Vec3d& p = points[v];
    const double sides[6] = {p.x, p.y, p.z, -p.x, -p.y, -p.z};
    for (int k = 0; k < 6; ++k) box.raise(k, sides[k]);
  }
};

struct Keep_maxima {
  double* maxima;

  CGAL_POWER_RTF_HD void operator()(const Totals<0, 6>& box) const
  {
    for (int k = 0; k < 6; ++k) maxima[k] = box.maximum(k);
  }
};

struct Set_curve_key {
  const Vec3d* points;
  Curve_cube cube;
  std::uint64_t* keys;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    const Hilbert_cube at = cube(points[v]);
    keys[v] = hilbert_index(at.i, at.j, at.k);
  }
};

/// Writes the order of `n` points. `maxima`: room for six; `keys`: for one of each point.
template <class Backend>
void order_along_curve(Backend& backend, int n, const Vec3d* points, double* maxima,
                       std::uint64_t* keys, int* order)
{
  backend.template reduce<0, 6>(n, Extend_box{points}, Keep_maxima{maxima});
  double sides[6];
  backend.download(sides, maxima, 6);
  const Box3<double> box{{-sides[3], -sides[4], -sides[5]}, {sides[0], sides[1], sides[2]}};
  backend.for_each(n, Set_curve_key{points, Curve_cube(box), keys});
  backend.sort_order(n, keys, order);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_CURVE_ORDER_H
