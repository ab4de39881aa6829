// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the extraction makes of the samples.
#ifndef CGAL_POWER_RTF_EXTRACTION_EXTRACTED_MESH_H
#define CGAL_POWER_RTF_EXTRACTION_EXTRACTED_MESH_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <vector>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFSurface
/// Triangles on the samples, in the coordinates of the unit box.
struct Extracted_mesh {
  /// The samples in their order; then the vertices of the surface that the topology does not allow
  /// to remove (normally none).
  std::vector<Vec3d> points;
  std::vector<Triangle> triangles;   ///< counter-clockwise seen from outside
  std::vector<Edge> feature_edges{}; ///< the pieces of creases and borders; sorted
  /// Of an `Opened_surface`, by point: its place (see `Seam_places`), whose points will be one
  /// vertex. Empty: all are alone.
  std::vector<int> places{};
  /// By point, the others have none: that of the input that it is, where it has to stay; or -1.
  std::vector<int> input_points{};

  /// Whether point `v` has to stay.
  bool is_kept(int v) const { return v < int(input_points.size()) && input_points[v] >= 0; }

  /// Puts the triangles into an order that depends on nothing but which triangles there are.
  void sort_triangles(internal::Concurrency concurrency = Sequential_tag())
  {
    internal::for_each_index(concurrency, int(triangles.size()), [this](int f) {
      Triangle& t = triangles[f];
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    });
    const internal::Buckets<Triangle> at_vertices(
        concurrency, int(triangles.size()), points.size(),
        [this](int f) { return triangles[f][0]; }, [this](int f) { return triangles[f]; });
    internal::for_each_index(concurrency, int(triangles.size()),
                             [&](int k) { triangles[k] = at_vertices.entries[k]; });
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXTRACTION_EXTRACTED_MESH_H
