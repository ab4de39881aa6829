// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_BOX_AROUND_H
#define CGAL_POWER_RTF_GEOMETRY_BOX_AROUND_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/internal/parallel.h>

namespace CGAL::PowerRTF::internal {

inline const Vec3d& corner_of(const Vec3d& p) { return p; }
inline const Vec3d& corner_of(const Box3<double>& b) { return b.lo; }

/// The box around `n` items, at least one: points or boxes, by number.
template <class Items>
Box3<double> box_around(Concurrency concurrency, int n, const Items& items)
{
  const Box3<double> first{corner_of(items[0]), corner_of(items[0])};
  return reduce(
      concurrency, n, first, [&](Box3<double>& b, int i) { b.add(items[i]); },
      [](Box3<double>& b, const Box3<double>& part) { b.add(part); });
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_BOX_AROUND_H
