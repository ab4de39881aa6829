// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The faces of a mesh along a Hilbert curve, where a backend works: the order of `Facet_tree`.
#ifndef CGAL_POWER_RTF_ENGINES_FACE_ORDER_H
#define CGAL_POWER_RTF_ENGINES_FACE_ORDER_H

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

/// The box around the centers as maxima.
struct Raise_box {
  Face_centers centers;

  CGAL_POWER_RTF_HD void operator()(int f, Totals<0, 6>& t) const
  {
    const Vec3d c = centers(f);
    const double sides[6] = {-c.x, -c.y, -c.z, c.x, c.y, c.z};
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

struct Face_codes {
  Face_centers centers;
  const Box3<double>* box;
  std::uint64_t* codes;

  CGAL_POWER_RTF_HD void operator()(int f) const
  {
    const Hilbert_cube cube = Curve_cube(*box)(centers(f));
    codes[f] = hilbert_index(cube.i, cube.j, cube.k);
  }
};

template <class Backend>
struct Face_order_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Box3<double>> box;
  Buffer<std::uint64_t> codes;

  /// See listed_arrays.h. `n`: faces.
  template <class F>
  static void for_each_array(F&& f, std::size_t n)
  {
    f(&Face_order_arrays::box, std::size_t(1));
    f(&Face_order_arrays::codes, n);
  }
};

/// What `order_faces()` takes.
template <class Backend>
std::size_t order_bytes(std::size_t n)
{
  return bytes_of_listed<Face_order_arrays<Backend>>(n) + Backend::sort_bytes(static_cast<int>(n));
}

/// Writes the numbers of n > 0 faces, `corners` of `points`, by their places along the curve.
template <class Backend>
void order_faces(Backend& backend, const Vec3d* points, int n, const int* corners, int* order)
{
  Face_order_arrays<Backend> a;
  allocate_listed(backend, a, std::size_t(n));
  const Face_centers centers{points, corners};
  backend.template reduce<0, 6>(n, Raise_box{centers}, Keep_box{a.box.data()});
  backend.for_each(n, Face_codes{centers, a.box.data(), a.codes.data()});
  backend.sort_order(n, a.codes.data(), order);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_FACE_ORDER_H
