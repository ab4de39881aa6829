// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_FIELDS_COMPUTE_DENSITY_H
#define CGAL_POWER_RTF_FIELDS_COMPUTE_DENSITY_H

#include <functional>
#include <vector>

namespace CGAL::PowerRTF {

struct Remeshing_options;
struct Surface;

/// Computes the density of the vertices that follows the curvature, where an engine works; see
/// `density_by_curvature()`. Returns `false` where it does not: then nothing has changed.
using Compute_density = std::function<bool(const Surface& surface, const Remeshing_options& options,
                                           std::vector<double>& density)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_COMPUTE_DENSITY_H
