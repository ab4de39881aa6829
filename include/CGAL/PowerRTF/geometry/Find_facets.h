// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_FIND_FACETS_H
#define CGAL_POWER_RTF_GEOMETRY_FIND_FACETS_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <functional>

namespace CGAL::PowerRTF {

/// Of `n` points, the nearest facets of the surface on which an engine works, as far as its
/// precision tells them apart: places in the facets' tree. `places`: facets that are probably near,
/// on the patches that count; they become those that are found, -1 where the normals of none agree
/// with `normals` (`cos_angle`: cosine). Returns `false` where an engine finds none: then nothing
/// has changed.
using Find_facets = std::function<bool(int n, const Vec3d* points, const Vec3d* normals,
                                       double cos_angle, int* places)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_FIND_FACETS_H
