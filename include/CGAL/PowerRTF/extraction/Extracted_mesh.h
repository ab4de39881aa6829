// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the extraction makes of the samples.
#ifndef CGAL_POWER_RTF_EXTRACTION_EXTRACTED_MESH_H
#define CGAL_POWER_RTF_EXTRACTION_EXTRACTED_MESH_H

#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFSurface
/// A point of the input that the result has.
struct Input_point {
  int number = -1;            ///< among those of the input; -1: it is none
  Vec3d coordinates{0, 0, 0}; ///< in the input
};

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
  /// By point, the others have none: that of the input that it is, where it has to stay.
  std::vector<Input_point> input_points{};
  /// Where an engine has the points and triangles as they are: see `there()`. What changes them
  /// resets it.
  mutable internal::Known<Resident_mesh, std::weak_ptr<Resident_mesh>> resident{};

  /// Whether point `v` has to stay.
  bool is_kept(int v) const { return v < int(input_points.size()) && input_points[v].number >= 0; }
  /// Point `v` in the input's coordinates: exactly as there, if it has to stay.
  Vec3d outside(int v, const Normalization& normalization) const
  {
    return is_kept(v) ? input_points[v].coordinates : normalization.to_outside(points[v]);
  }
  /// All points in the input's coordinates.
  std::vector<Vec3d> outside(const Normalization& normalization,
                             internal::Concurrency concurrency = Sequential_tag()) const
  {
    std::vector<Vec3d> result(points.size());
    internal::for_each_index(concurrency, int(points.size()),
                             [&](int v) { result[v] = outside(v, normalization); });
    return result;
  }

  Mesh_arrays arrays() const
  {
    return {int(points.size()), points.data(), int(triangles.size()),
            triangles.empty() ? nullptr : triangles.front().data()};
  }
  /// Where an engine has the mesh: it goes up if it is not there. Null: it has no triangles, or
  /// `bring` is empty or does not bring it.
  std::shared_ptr<Resident_mesh> there(const Bring_mesh& bring) const
  {
    std::shared_ptr<Resident_mesh> known = resident.value.lock();
    if (known || !bring || triangles.empty()) return known;
    known = bring(arrays());
    resident.value = known;
    return known;
  }

  /// Gets other points and triangles, those of `mesh`.
  void take(Extracted_mesh&& mesh)
  {
    points.swap(mesh.points);
    triangles.swap(mesh.triangles);
    resident = std::move(mesh.resident);
  }

  /// Puts the triangles into an order that depends on nothing but which triangles there are.
  void sort_triangles(internal::Concurrency concurrency = Sequential_tag())
  {
    resident = {};
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
