// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stars of a mesh as plain arrays, and a loop over all vertices that may move.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_FLAT_STARS_H
#define CGAL_POWER_RTF_IMPROVEMENT_FLAT_STARS_H

#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/color_order.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/Star_view.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Flags of `Star_kind`.
inline unsigned char star_kind(const Star_mesh& mesh, Star_mesh::Vertex v)
{
  return (mesh.is_movable(v) ? is_movable_kind : 0) |
         (mesh.is_on_feature(v) ? is_on_feature_kind : 0);
}

/// Of n vertices, as `vertex(i)` names them. \pre nothing is missing: no vertex has been collapsed
template <class Vertex>
Flat_stars flat_stars(const Star_mesh& mesh, int n, const Vertex& vertex)
{
  Flat_stars stars;
  const auto& topology = mesh.working().mesh;
  stars.first.resize(n + 1);
  stars.first[n] = 0;
  for (auto array : {&stars.points, &stars.normals}) array->resize(n);
  stars.facets.resize(n);
  stars.heights.resize(n);
  stars.kinds.resize(n);
  const int chunk = std::clamp(n / 128, 64, 1024);
  std::vector<std::vector<int>> parts((n + chunk - 1) / chunk); // of the neighbors
  for_each_chunk(mesh.concurrency(), n, chunk, [&](int begin, int end) {
    std::vector<int>& part = parts[begin / chunk];
    part.reserve(7 * chunk); // mostly enough
    for (int i = begin; i < end; ++i) {
      const Star_mesh::Vertex v(vertex(i));
      stars.points[i] = mesh.point(v);
      stars.normals[i] = mesh.normal(v);
      stars.facets[i] = mesh.facet(v);
      stars.heights[i] = mesh.height(v);
      stars.kinds[i] = star_kind(mesh, v);
      const std::size_t before = part.size();
      if (mesh.is_movable(v))
        for (const auto h : halfedges_around_target(v, topology))
          part.push_back(int(topology.source(h)));
      stars.first[i] = int(part.size() - before);
    }
  });
  stars.neighbors.resize(exclusive_scan(mesh.concurrency(), n + 1, stars.first.data()));
  for_each_chunk(mesh.concurrency(), int(parts.size()), 1, [&](int k, int) {
    std::copy(parts[k].begin(), parts[k].end(), stars.neighbors.begin() + stars.first[k * chunk]);
  });
  return stars;
}

/// Of all vertices.
inline Flat_stars flat_stars(const Star_mesh& mesh)
{
  return flat_stars(mesh, int(mesh.size()), [](int i) { return i; });
}

/// Of those that have changed.
inline Flat_stars flat_stars(const Star_mesh& mesh, std::vector<int>&& changed)
{
  Flat_stars stars = flat_stars(mesh, int(changed.size()), [&](int i) { return changed[i]; });
  stars.are_all = false;
  stars.vertices = std::move(changed);
  return stars;
}

/// Calls `f(v)` for all vertices that may move, many at once: it may change `v` and read its
/// neighbors.
template <class F>
void for_each_movable(const Star_mesh& mesh, F&& f)
{
  const Color_order order = color_order(flat_stars(mesh), mesh.concurrency());
  for (std::size_t c = 0; c + 1 < order.first.size(); ++c)
    for_each_chunk(mesh.concurrency(), order.first[c + 1] - order.first[c], 64,
                   [&](int begin, int end) {
                     for (int k = begin; k < end; ++k)
                       f(Star_mesh::Vertex(order.vertices[order.first[c] + k]));
                   });
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_FLAT_STARS_H
