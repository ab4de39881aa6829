// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order along the Hilbert curve, made where a backend works: what `spatial_order()` makes.
#ifndef CGAL_POWER_RTF_GEOMETRY_CURVE_ORDER_H
#define CGAL_POWER_RTF_GEOMETRY_CURVE_ORDER_H

#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/geometry/hilbert_code.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>
#include <cstdint>

namespace CGAL::PowerRTF::internal {

struct Face_centers {
  const Vec3d* points;
  const int* corners;

  CGAL_POWER_RTF_HD Vec3d operator()(int f) const
  {
    const int* const v = corners + 3 * std::size_t(f);
    return center_of(points[v[0]], points[v[1]], points[v[2]]);
  }
};

struct Points_themselves {
  const Vec3d* points;
  CGAL_POWER_RTF_HD const Vec3d& operator()(int v) const { return points[v]; }
};

/// The box around points as maxima.
template <class Points>
struct Raise_box {
  Points points;

  CGAL_POWER_RTF_HD void operator()(int i, Totals<0, 6>& t) const
  {
    const Vec3d p = points(i);
    const double sides[6] = {-p.x, -p.y, -p.z, p.x, p.y, p.z};
    for (int k = 0; k < 6; ++k) t.raise(k, sides[k]);
  }
};
struct Keep_box {
  Box3<double>* box;

  CGAL_POWER_RTF_HD void operator()(const Totals<0, 6>& t) const
  {
    *box = {{-t.maximum(0), -t.maximum(1), -t.maximum(2)},
            {t.maximum(3), t.maximum(4), t.maximum(5)}};
  }
};

template <class Points>
struct Curve_codes {
  Points points;
  const Box3<double>* box;
  std::uint64_t* codes;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    const Hilbert_cube cube = Curve_cube(*box)(points(i));
    codes[i] = hilbert_index(cube.i, cube.j, cube.k);
  }
};

template <class Backend>
struct Curve_order_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Box3<double>> box;
  Buffer<std::uint64_t> codes;

  /// See listed_arrays.h. `n`: points.
  template <class F>
  static void for_each_array(F&& f, std::size_t n)
  {
    f(&Curve_order_arrays::box, std::size_t(1));
    f(&Curve_order_arrays::codes, n);
  }
};

/// What `order_along_curve()` takes.
template <class Backend>
std::size_t order_bytes(std::size_t n)
{
  return bytes_of_listed<Curve_order_arrays<Backend>>(n) + Backend::sort_bytes(static_cast<int>(n));
}

/// Writes the numbers of n > 0 points, `points(i)`, by their places along the curve.
template <class Backend, class Points>
void order_along_curve(Backend& backend, int n, const Points& points, int* order)
{
  Curve_order_arrays<Backend> a;
  allocate_listed(backend, a, std::size_t(n));
  backend.template reduce<0, 6>(n, Raise_box<Points>{points}, Keep_box{a.box.data()});
  backend.for_each(n, Curve_codes<Points>{points, a.box.data(), a.codes.data()});
  backend.sort_order(n, a.codes.data(), order);
}

/// Takes the corners of faces to the faces' places in an order.
struct Order_corners {
  const int* corners;
  const int* order;
  int* ordered;

  CGAL_POWER_RTF_HD void operator()(int place) const
  {
    const std::size_t from = 3 * std::size_t(order[place]), to = 3 * std::size_t(place);
    for (int k = 0; k < 3; ++k) ordered[to + k] = corners[from + k];
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_CURVE_ORDER_H
