// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vertices of the surface from which the distance to the mesh is measured.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_TRACKED_POINTS_H
#define CGAL_POWER_RTF_IMPROVEMENT_TRACKED_POINTS_H

#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A vertex of the surface and where the mesh is nearest to it.
struct Tracked_point {
  Vec3d nearest;
  double distance;
  Working_mesh::Halfedge face;
  int vertex, facet; ///< of the surface
  float weight;      ///< area of the surface that it stands for, of its vertices
};

/// The vertices in spatial order: that in which the facets of the tree come to them. Of more than
/// `most`, every k-th. Their distances are infinite.
inline Unset_vector<Tracked_point> tracked_points(const Surface& surface, const Facet_tree& tree,
                                                  std::size_t most, Concurrency concurrency)
{
  const int vertices = int(surface.points.size()), places = int(tree.order().size());
  const Buckets<int>& corners = surface.adjacency.corners;
  const auto for_each_corner = [&](int v, auto&& f) {
    for (int c = corners.first[v]; c < corners.first[v + 1]; ++c) f(corners.entries[c]);
  };
  const auto vertex = [&](int rank) { return surface.triangles[tree.order()[rank / 3]][rank % 3]; };
  std::vector<int> ranks(vertices, std::numeric_limits<int>::max()); // of the first corners
  for_each_index(concurrency, vertices, [&](int v) {
    for_each_corner(v,
                    [&](int c) { ranks[v] = std::min(ranks[v], 3 * tree.place(c / 3) + c % 3); });
  });
  const std::vector<int> first =
      select(concurrency, 3 * places, [&](int rank) { return ranks[vertex(rank)] == rank; });
  const int stride = 1 + int(vertices / most);
  Unset_vector<Tracked_point> points;
  points.resize((first.size() + stride - 1) / stride);
  for_each_index(concurrency, int(points.size()), [&](int i) {
    const int rank = first[i * stride], v = vertex(rank);
    double area = 0;
    for_each_corner(v, [&](int c) { area += surface.facet_areas[c / 3] / 3; });
    points[i] = {
        surface.points[v], std::numeric_limits<double>::infinity(), {}, v, tree.order()[rank / 3],
        float(area)};
  });
  return points;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_TRACKED_POINTS_H
