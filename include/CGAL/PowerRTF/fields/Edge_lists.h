// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_FIELDS_EDGE_LISTS_H
#define CGAL_POWER_RTF_FIELDS_EDGE_LISTS_H

#include <CGAL/PowerRTF/geometry/Edges_view.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/Surface_facets.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/scan.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// The edges of a surface, listed where a backend works.
template <class Backend>
class Edge_lists {
public:
  Edge_lists(Backend& backend, const Surface& surface)
      : m_facets(facets_there(backend, surface, surface.resident.value.get(), m_buffers))
  {
    allocate_listed(backend, *this, surface);
    const int vertices = m_facets.vertices;
    const Vertex_neighbors neighbors{m_facets.first_corner, m_facets.vertex_corners,
                                     m_facets.corners, m_facets.opposite};
    int* const first = m_first.data();
    backend.fill(first + vertices, 0, 1);
    backend.for_each(vertices, Count_neighbors{neighbors, first});
    exclusive_scan(backend, vertices + 1, first, m_sums.data());
    backend.for_each(vertices, List_neighbors{neighbors, m_facets.points, first, m_neighbor.data(),
                                              m_length.data()});
  }

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, const Surface& surface)
  {
    using E = Edge_lists;
    const std::size_t vertices = surface.points.size(), corners = 3 * surface.triangles.size(),
                      neighbors = corners + surface.adjacency.border_edges;
    f(&E::m_first, vertices + 1);
    f(&E::m_neighbor, neighbors);
    f(&E::m_length, neighbors);
    f(&E::m_sums, scan_sums(static_cast<int>(vertices + 1)));
  }

  /// What a construction takes.
  static std::size_t bytes(const Backend& backend, const Surface& surface)
  {
    return bytes_of_listed<Edge_lists>(surface) +
           bytes_of_facets(backend, surface, surface.resident.value.get());
  }

  Edges_view view() const { return {m_first.data(), m_neighbor.data(), m_length.data()}; }
  /// Of the surface.
  const Surface_facets& facets() const { return m_facets; }

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Facet_buffers<Backend> m_buffers;
  Surface_facets m_facets;
  Buffer<int> m_first, m_sums, m_neighbor;
  Buffer<double> m_length;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_FIELDS_EDGE_LISTS_H
