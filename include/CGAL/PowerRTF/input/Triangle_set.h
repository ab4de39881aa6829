// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
#ifndef CGAL_POWER_RTF_INPUT_TRIANGLE_SET_H
#define CGAL_POWER_RTF_INPUT_TRIANGLE_SET_H

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <vector>

namespace CGAL::PowerRTF::internal {

/// Any triangles, in the unit box.
struct Triangle_set {
  std::vector<Vec3d> points;
  std::vector<Triangle> triangles;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INPUT_TRIANGLE_SET_H
