// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_TRANSFER_POINT_OF_FACE_H
#define CGAL_POWER_RTF_TRANSFER_POINT_OF_FACE_H

#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/transfer/Sources.h>

namespace CGAL::PowerRTF::internal {

/// The center of the k-th of the 16 parts of a triangle that is cut into four along each side,
/// k < `points_of_face`. The first is in the middle.
inline Vec3d point_of_face(int k, const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  constexpr int to_b[] = {4, 1, 1, 1, 1, 4, 4, 7, 7, 10, 2, 2, 2, 5, 5, 8}, // twelfths of the way
      to_c[] = {4, 1, 4, 7, 10, 1, 7, 1, 4, 1, 2, 5, 8, 2, 5, 2};
  return a + (b - a) * (to_b[k] / 12.) + (c - a) * (to_c[k] / 12.);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_TRANSFER_POINT_OF_FACE_H
