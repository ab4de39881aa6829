// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_FIND_DISTANCES_H
#define CGAL_POWER_RTF_GEOMETRY_FIND_DISTANCES_H

#include <CGAL/PowerRTF/geometry/Surface_view.h>

#include <functional>

namespace CGAL::PowerRTF {

/// Writes the squared distances of `n` points from a surface's nearest facets, of any patch, where
/// an engine works. Returns `false` where it does not: then they are left to the caller.
using Find_distances = std::function<bool(const Surface_view<double>& facets, int n,
                                          const Vec3d* points, double* squared_distances)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_FIND_DISTANCES_H
