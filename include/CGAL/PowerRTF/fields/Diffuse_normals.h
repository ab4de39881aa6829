// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_FIELDS_DIFFUSE_NORMALS_H
#define CGAL_POWER_RTF_FIELDS_DIFFUSE_NORMALS_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <functional>

namespace CGAL::PowerRTF {

struct Surface;

/// Diffuses the vertex normals of a surface, which are in `normals`, where an engine works; see
/// `smooth_normals()`. `variance`: see `diffusion_variance()`. Returns `false` where it does not:
/// then nothing has changed.
using Diffuse_normals =
    std::function<bool(const Surface& surface, double variance, Vec3d* normals)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_DIFFUSE_NORMALS_H
