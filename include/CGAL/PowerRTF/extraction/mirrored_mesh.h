// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the mesh of the half of a symmetric surface to that of the whole.
#ifndef CGAL_POWER_RTF_EXTRACTION_MIRRORED_MESH_H
#define CGAL_POWER_RTF_EXTRACTION_MIRRORED_MESH_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// The edges of the border that are on the plane.
inline std::vector<Edge> border_at_mirror(const std::vector<Vec3d>& points,
                                          const std::vector<Triangle>& triangles,
                                          const Facet_adjacency& adjacency,
                                          const Mirror_plane& mirror)
{
  std::vector<Edge> edges;
  for (int h = 0; h < static_cast<int>(adjacency.opposite.size()); ++h) {
    const int a = halfedge_source(triangles, h), b = halfedge_target(triangles, h);
    if (adjacency.opposite[h] == Facet_adjacency::none && mirror.has(points[a]) &&
        mirror.has(points[b]))
      edges.push_back(sorted_edge(a, b));
  }
  return edges;
}

/// Which edges at the mirror are creases of the whole.
class Mirror_creases {
public:
  /// \param half the surface
  explicit Mirror_creases(const Surface& half)
  {
    for (const Edge& e :
         border_at_mirror(half.points, half.triangles, half.adjacency, *half.mirror))
      m_edges.push_back({half.points[e[0]], half.points[e[1]],
                         std::binary_search(half.creases.begin(), half.creases.end(), e)});
    m_has_any = std::any_of(m_edges.begin(), m_edges.end(), [](const auto& e) { return e.crease; });
  }

  /// Whether the edge of the surface that is nearest to `p` is one.
  bool has(const Vec3d& p) const
  {
    if (!m_has_any) return false;
    double least = std::numeric_limits<double>::infinity();
    bool result = false;
    for (const Piece& e : m_edges) {
      const Vec3d d = e.b - e.a;
      const double t = std::clamp(dot(p - e.a, d) / squared_length(d), 0., 1.);
      const double distance = squared_length(e.a + t * d - p);
      if (distance < least) std::tie(least, result) = std::pair(distance, e.crease);
    }
    return result;
  }

private:
  struct Piece {
    Vec3d a, b;
    bool crease;
  };

  std::vector<Piece> m_edges;
  bool m_has_any;
};

} // namespace internal

/// `mesh` and its mirror image, joined where the border of `mesh` is on the plane: its vertices in
/// their order, then the images of the others.
/// \param half the surface, with its `mirror`, of which `mesh` is a result
inline Extracted_mesh mirrored_mesh(Extracted_mesh mesh, const Surface& half,
                                    internal::Concurrency concurrency = Sequential_tag())
{
  const Mirror_plane& mirror = *half.mirror;
  std::vector<char> is_shared(mesh.points.size(), 0);
  for (const auto& [a, b] : internal::border_at_mirror(
           mesh.points, mesh.triangles,
           facet_adjacency(mesh.triangles, mesh.points.size(), concurrency), mirror))
    is_shared[a] = is_shared[b] = 1;
  std::vector<int> images;
  const int vertices = static_cast<int>(mesh.points.size());
  for (int v = 0; v < vertices; ++v) {
    images.push_back(is_shared[v] ? v : static_cast<int>(mesh.points.size()));
    if (!is_shared[v]) mesh.points.push_back(mirror.image(mesh.points[v]));
  }
  mesh.resident = {};
  const std::size_t facets = mesh.triangles.size();
  for (std::size_t f = 0; f < facets; ++f) {
    const auto [a, b, c] = mesh.triangles[f];
    mesh.triangles.push_back({images[a], images[c], images[b]});
  }
  const internal::Mirror_creases creases(half);
  std::vector<Edge> features;
  for (const auto& [a, b] : mesh.feature_edges)
    if (!(is_shared[a] && is_shared[b]) || creases.has(0.5 * (mesh.points[a] + mesh.points[b]))) {
      features.push_back({a, b});
      features.push_back(sorted_edge(images[a], images[b]));
    }
  sort_uniquely(features);
  mesh.feature_edges = std::move(features);
  return mesh;
}

/// The facets whose mirror image, turned over, is none of the facets.
inline std::size_t facets_without_image(const Extracted_mesh& mesh, const Mirror_plane& mirror,
                                        internal::Concurrency concurrency = Sequential_tag())
{
  using Point = std::array<double, 3>;
  using Facet = std::array<Point, 3>;
  const auto facet = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    Facet result{Point{a.x, a.y, a.z}, Point{b.x, b.y, b.z}, Point{c.x, c.y, c.z}};
    std::rotate(result.begin(), std::min_element(result.begin(), result.end()), result.end());
    return result;
  };
  std::vector<Facet> facets;
  for (const auto& [a, b, c] : mesh.triangles)
    facets.push_back(facet(mesh.points[a], mesh.points[b], mesh.points[c]));
  internal::sort(concurrency, facets.begin(), facets.end());
  return std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
    return !std::binary_search(facets.begin(), facets.end(),
                               facet(mirror.image(mesh.points[t[0]]),
                                     mirror.image(mesh.points[t[2]]),
                                     mirror.image(mesh.points[t[1]])));
  });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXTRACTION_MIRRORED_MESH_H
