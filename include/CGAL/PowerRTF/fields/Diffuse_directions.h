// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_FIELDS_DIFFUSE_DIRECTIONS_H
#define CGAL_POWER_RTF_FIELDS_DIFFUSE_DIRECTIONS_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <functional>

namespace CGAL::PowerRTF {

/// The vertices of a graph and the times of a diffusion there. Non-owning.
struct Diffusion_graph {
  int vertices, edges;         ///< edges count from both their ends
  const int *first, *neighbor; ///< as of `Surface_edges`
  const double* times;         ///< by vertex
  double longest;              ///< of the times
};

/// Diffuses unit vectors, in so many steps, where an engine works; see `diffuse_directions()`.
/// Returns `false` where it does not: then nothing has changed.
using Diffuse_directions =
    std::function<bool(const Diffusion_graph& graph, int steps, Vec3d* directions)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_DIFFUSE_DIRECTIONS_H
