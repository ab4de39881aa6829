// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_BUILD_SURFACE_H
#define CGAL_POWER_RTF_GEOMETRY_BUILD_SURFACE_H

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <functional>
#include <vector>

namespace CGAL::PowerRTF {

/// Makes a surface of triangles and points of the unit box where an engine works, if they are an
/// oriented 2-manifold of all the points without degenerate facets, as nearly all inputs are: its
/// points and triangles in spatial order, their adjacency, normals and areas. Returns `false` where
/// they are not, or the memory does not suffice: then nothing has changed.
using Build_surface = std::function<bool(const std::vector<Vec3d>& points,
                                         const std::vector<Triangle>& triangles, Surface& surface)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_BUILD_SURFACE_H
