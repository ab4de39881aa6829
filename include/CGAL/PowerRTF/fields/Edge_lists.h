// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_FIELDS_EDGE_LISTS_H
#define CGAL_POWER_RTF_FIELDS_EDGE_LISTS_H

#include <CGAL/PowerRTF/geometry/Edges_view.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/scan.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// The edges of a surface, listed where a backend works.
template <class Backend>
class Edge_lists {
public:
  Edge_lists(Backend& backend, const Surface& surface)
  {
    allocate_listed(backend, *this, surface);
    const Facet_adjacency& adjacency = surface.adjacency;
    const int vertices = static_cast<int>(surface.points.size());
    const Vertex_neighbors neighbors{
        uploaded(backend, m_first_corner, adjacency.corners.first.data()),
        uploaded(backend, m_corners, adjacency.corners.entries.data()),
        uploaded(backend, m_vertices, surface.triangles.data()->data()),
        uploaded(backend, m_opposite, adjacency.opposite.data())};
    uploaded(backend, m_points, surface.points.data());
    int* const first = m_first.data();
    backend.fill(first + vertices, 0, 1);
    backend.for_each(vertices, Count_neighbors{neighbors, first});
    exclusive_scan(backend, vertices + 1, first, m_sums.data());
    backend.for_each(
        vertices, List_neighbors{neighbors, points(), first, m_neighbor.data(), m_length.data()});
  }

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, const Surface& surface)
  {
    using E = Edge_lists;
    const std::size_t vertices = surface.points.size(), corners = 3 * surface.triangles.size(),
                      neighbors = corners + surface.adjacency.border_edges;
    f(&E::m_points, vertices);
    for (auto array : {&E::m_vertices, &E::m_corners, &E::m_opposite}) f(array, corners);
    for (auto array : {&E::m_first_corner, &E::m_first}) f(array, vertices + 1);
    f(&E::m_neighbor, neighbors);
    f(&E::m_length, neighbors);
    f(&E::m_sums, scan_sums(static_cast<int>(vertices + 1)));
  }

  Edges_view view() const { return {m_first.data(), m_neighbor.data(), m_length.data()}; }
  const Vec3d* points() const { return m_points.data(); }
  /// Three of each facet.
  const int* vertices() const { return m_vertices.data(); }

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Vec3d> m_points;
  Buffer<int> m_vertices, m_first_corner, m_corners, m_opposite, m_first, m_sums, m_neighbor;
  Buffer<double> m_length;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_FIELDS_EDGE_LISTS_H
