// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_FIND_DISTANCES_H
#define CGAL_POWER_RTF_GEOMETRY_FIND_DISTANCES_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <functional>

namespace CGAL::PowerRTF {

/// A mesh as plain arrays. Non-owning.
struct Mesh_arrays {
  int vertices;
  const Vec3d* points;
  int faces;
  const int* corners; ///< three per face
};

/// What is known of the distances of a surface's points from another one.
struct Sampled_distances {
  double sum = 0, sum_of_squares = 0; ///< over samples
  double max_squared = 0;             ///< of the samples and the vertices
  Vec3d farthest{0, 0, 0};            ///< the first of those, when it is not 0
};

/// From a surface to a mesh, and back.
struct Two_sided_distances {
  Sampled_distances from_surface, from_mesh;
};

/// Finds distances between an engine's surface and a mesh, both with a face, from so many samples
/// each way, where the engine works. Returns `false` where it does not: then they are left to the
/// caller.
using Find_distances =
    std::function<bool(const Mesh_arrays& mesh, int samples, Two_sided_distances& result)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_FIND_DISTANCES_H
