// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// To which patch of the surface, between creases and borders, the triangles of a result belong.
#ifndef CGAL_POWER_RTF_EXTRACTION_MESH_PATCHES_H
#define CGAL_POWER_RTF_EXTRACTION_MESH_PATCHES_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// The part of each triangle of `mesh` between its pieces of creases and borders, numbered in the
/// order of the triangles; and the number of parts.
inline std::pair<std::vector<int>, int>
mesh_parts(const Extracted_mesh& mesh, internal::Concurrency concurrency = Sequential_tag())
{
  Facet_adjacency adjacency = facet_adjacency(mesh.triangles, mesh.points.size(), concurrency);
  internal::for_each_index(concurrency, static_cast<int>(adjacency.opposite.size()), [&](int h) {
    const Edge edge =
        sorted_edge(halfedge_source(mesh.triangles, h), halfedge_target(mesh.triangles, h));
    if (std::binary_search(mesh.feature_edges.begin(), mesh.feature_edges.end(), edge))
      adjacency.opposite[h] = Facet_adjacency::none;
  });
  return facet_components(adjacency, concurrency);
}

namespace internal {

/// The normal of a triangle, twice as long as its area.
inline Vec3d area_vector(const Extracted_mesh& mesh, int f)
{
  const auto [a, b, c] = mesh.triangles[f];
  return cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
}

inline Vec3d center(const Extracted_mesh& mesh, int f)
{
  const auto [a, b, c] = mesh.triangles[f];
  return (mesh.points[a] + mesh.points[b] + mesh.points[c]) * (1. / 3);
}

} // namespace internal

/// The patch of each triangle of `mesh`. Triangles that no piece of a crease parts are of the same
/// patch: that at the center of the largest of them.
///
/// \param patches the surface cut along its creases, with `facet_patches`
inline std::vector<int> mesh_patches(const Extracted_mesh& mesh, const Surface& patches,
                                     internal::Concurrency concurrency = Sequential_tag())
{
  std::vector<int> result(mesh.triangles.size(), 0);
  if (patches.facet_patches.empty()) return result;
  const auto [parts, count] = mesh_parts(mesh, concurrency);
  const auto area_vector = [&mesh](int f) { return internal::area_vector(mesh, f); };
  std::vector<int> largest(count, -1);
  for (int f = 0; f < static_cast<int>(parts.size()); ++f) {
    int& g = largest[parts[f]];
    if (g < 0 || squared_length(area_vector(f)) > squared_length(area_vector(g))) g = f;
  }
  const Facet_tree tree(patches.points, patches.triangles, {}, concurrency);
  std::vector<int> numbers(count);
  for (int part = 0; part < count; ++part) {
    const Vec3d center = internal::center(mesh, largest[part]);
    Surface_point<double> nearest = tree.nearest(center, area_vector(largest[part]), 0, -1);
    if (nearest.facet < 0) nearest = tree.nearest_anywhere(center);
    numbers[part] = patches.facet_patches[nearest.facet];
  }
  for (std::size_t f = 0; f < result.size(); ++f) result[f] = numbers[parts[f]];
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXTRACTION_MESH_PATCHES_H
