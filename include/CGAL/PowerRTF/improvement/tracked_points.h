// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vertices of the surface, or points of its edges, too, from which the distance to the mesh is
// measured.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_TRACKED_POINTS_H
#define CGAL_POWER_RTF_IMPROVEMENT_TRACKED_POINTS_H

#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A vertex of the surface and where the mesh is nearest to it.
struct Tracked_point {
  Vec3d nearest;
  double distance;
  Working_mesh::Halfedge face;
  int vertex, facet; ///< of the surface; or the number of another point
  float weight;      ///< area of the surface that it stands for, of its vertices
};

/// The vertices in spatial order: that in which the facets of the tree come to them. Where they are
/// far more than `mesh_vertices`, every k-th. Their distances are infinite.
inline Unset_vector<Tracked_point> tracked_points(const Surface& surface, const Facet_tree& tree,
                                                  std::size_t mesh_vertices,
                                                  Concurrency concurrency)
{
  const std::size_t most = Improvement_parameters::Tracking::max_points_per_vertex * mesh_vertices;
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

/// Where a vertex at `p` may go for the mesh to come nearer to `x`, which is now nearest to
/// `nearest`: there, and from `p` all the way that the mesh is from it or a part.
inline std::array<Vec3d, 4> places_towards(const Vec3d& x, const Vec3d& nearest, const Vec3d& p)
{
  const Vec3d r = x - nearest;
  return {x, p + r, p + 0.5 * r, p + 0.25 * r};
}

/// Points and the facets that they are on.
struct Surface_points {
  std::vector<Vec3d> points;
  std::vector<int> facets;
};

/// All of them; their distances are infinite.
inline Unset_vector<Tracked_point> tracked_points(const Surface_points& all)
{
  Unset_vector<Tracked_point> points;
  points.resize(all.points.size());
  for (int i = 0; i < int(all.points.size()); ++i)
    points[i] = {all.points[i], std::numeric_limits<double>::infinity(), {}, i, all.facets[i], 0};
  return points;
}

/// The vertices, points of the edges, `step` apart or nearer, but no more than 63 of an edge, and
/// points inside the facets, twice as far apart, but no more than 21 of a facet.
inline Surface_points points_of_facets(const Surface& surface, const Facet_tree& tree, double step)
{
  constexpr double most = 64, most_inside = 8;
  Surface_points all;
  const auto add = [&all](const Vec3d& p, int facet) {
    all.points.push_back(p);
    all.facets.push_back(facet);
  };
  std::vector<char> is_there(surface.points.size(), false);
  for (const int f : tree.order()) {
    const auto& t = surface.triangles[f];
    const Vec3d &a = surface.points[t[0]], ab = surface.points[t[1]] - a,
                ac = surface.points[t[2]] - a;
    double longest = 0;
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      const int v = halfedge_source(surface.triangles, h), o = surface.adjacency.opposite[h];
      const Vec3d &p = surface.points[v],
                  &q = surface.points[halfedge_target(surface.triangles, h)];
      longest = std::max(longest, length(q - p));
      if (!std::exchange(is_there[v], true)) add(p, f);
      if (o > h) continue; // the other facet's turn
      const int parts = int(std::min(most, std::ceil(length(q - p) / step)));
      for (int i = 1; i < parts; ++i) add(p + double(i) / parts * (q - p), f);
    }
    const int parts = int(std::min(most_inside, std::ceil(longest / (2 * step))));
    for (int i = 1; i < parts; ++i)
      for (int j = 1; i + j < parts; ++j)
        add(a + double(i) / parts * ab + double(j) / parts * ac, f);
  }
  return all;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_TRACKED_POINTS_H
