// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A halfedge mesh from triangles, all at once.
#ifndef CGAL_POWER_RTF_EXTRACTION_CONNECT_HALFEDGES_H
#define CGAL_POWER_RTF_EXTRACTION_CONNECT_HALFEDGES_H

#include <CGAL/PowerRTF/geometry/Triangle_links.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {

template <class Point>
class Surface_mesh;

namespace PowerRTF::internal {

/// The links of `triangles`, on vertices below `vertices`; unknown if they are no oriented
/// 2-manifold.
inline Triangle_links triangle_links(const std::vector<Triangle>& triangles, int vertices,
                                     Concurrency concurrency)
{
  Triangle_links links;
  links.opposite = filled(concurrency, 3 * triangles.size(), -1);
  const Buckets<int> corners = vertex_corners(triangles, vertices, concurrency);
  const Facet_adjacency adjacency =
      find_opposites(triangles, corners, links.opposite.data(), concurrency);
  if (adjacency.non_manifold_edges > 0 || adjacency.same_direction ||
      count_non_manifold_vertices(corners, links.opposite.data(), concurrency) > 0)
    return {};
  links.last_corner.resize(vertices);
  for_each_index(concurrency, vertices, [&](int v) {
    const bool has_any = corners.first[v] < corners.first[v + 1];
    links.last_corner[v] = has_any ? corners.entries[corners.first[v + 1] - 1] : -1;
  });
  return links;
}

/// Makes `triangles`, on vertices below `vertices`, the faces of a mesh that is empty, or has only
/// been resized; its points are not set. The halfedges of edge e are 2 e, of the first of its
/// triangles, and 2 e + 1; the edges count in the order of these.
///
/// \param find what finds the links of the triangles instead, where it does
/// \returns `false`, with nothing done, if the triangles are no oriented 2-manifold.
template <class Point>
bool connect_halfedges(CGAL::Surface_mesh<Point>& mesh, const std::vector<Triangle>& triangles,
                       int vertices, Concurrency concurrency, const Find_links& find = {})
{
  using Mesh = CGAL::Surface_mesh<Point>;
  using Vertex = typename Mesh::Vertex_index;
  using Halfedge = typename Mesh::Halfedge_index;
  using Face = typename Mesh::Face_index;
  const int halfedges = static_cast<int>(3 * triangles.size());
  Triangle_links links;
  Unset_vector<int> numbers(halfedges); // in the mesh
  std::size_t edges = 0;
  const auto resize = [&](std::size_t e) { mesh.resize(vertices, e, triangles.size()); };
  const auto number_edges = [&] {
    const int* const opposite = links.opposite.data();
    select(
        concurrency, halfedges, [=](int h) { return opposite[h] < 0 || h < opposite[h]; },
        [&](std::size_t count) { edges = count; },
        [&](int e, int h) {
          numbers[h] = 2 * e;
          if (opposite[h] >= 0) numbers[opposite[h]] = 2 * e + 1;
        });
  };
  // One thread has to come by the memory of the mesh: nearly all of it while the others do this.
  // Without `reserve()`: GCC's vectors take seven times as long to grow into memory that is there.
  call_at_once(
      concurrency,
      [&] {
        if (!find || !find(links)) links = triangle_links(triangles, vertices, concurrency);
        if (links.are_known()) number_edges();
      },
      [&] { resize(halfedges / 2 + halfedges / 128); });
  if (!links.are_known() && halfedges > 0) {
    mesh.resize(0, 0, 0);
    return false;
  }
  resize(edges);
  const Unset_vector<int>& opposite = links.opposite;

  const auto halfedge = [&](int h) { return Halfedge(numbers[h]); };
  for_each_index(concurrency, static_cast<int>(triangles.size()), [&](int f) {
    const std::array<Halfedge, 3> around = {halfedge(3 * f), halfedge(3 * f + 1),
                                            halfedge(3 * f + 2)};
    for (int i = 0; i < 3; ++i) {
      mesh.set_target(around[i], Vertex(triangles[f][(i + 1) % 3]));
      mesh.set_next(around[i], around[(i + 1) % 3]);
      mesh.set_face(around[i], Face(f));
    }
    mesh.set_halfedge(Face(f), around[0]);
  });
  for_each_index(concurrency, vertices, [&](int v) { // the last halfedge to it
    if (halfedges > 0 && links.last_corner[v] >= 0)
      mesh.set_halfedge(Vertex(v), halfedge(previous_halfedge(links.last_corner[v])));
  });
  if (2 * edges == std::size_t(halfedges)) return true; // no border
  const std::vector<int> at_border =
      select(concurrency, halfedges, [&](int h) { return opposite[h] < 0; });
  std::vector<Halfedge> leaving(vertices); // on the border
  for (const int h : at_border) {
    mesh.set_target(mesh.opposite(halfedge(h)), Vertex(halfedge_source(triangles, h)));
    leaving[halfedge_target(triangles, h)] = mesh.opposite(halfedge(h));
  }
  for (const int h : at_border) {
    const Halfedge border = mesh.opposite(halfedge(h));
    mesh.set_next(border, leaving[halfedge_source(triangles, h)]);
    mesh.set_halfedge(mesh.target(border), border);
  }
  return true;
}

} // namespace PowerRTF::internal
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_CONNECT_HALFEDGES_H
