// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges of a surface in compressed rows, and how they are listed, for host and device.
#ifndef CGAL_POWER_RTF_GEOMETRY_EDGES_VIEW_H
#define CGAL_POWER_RTF_GEOMETRY_EDGES_VIEW_H

#include <CGAL/PowerRTF/geometry/halfedge_numbers.h>
#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/host_device.h>

namespace CGAL::PowerRTF {

/// As `Surface_edges`. Non-owning.
struct Edges_view {
  const int *first, *neighbor;
  const double* length;
};

namespace internal {

/// The vertices next to those of a surface.
struct Vertex_neighbors {
  const int *first, *corners; ///< `vertex_corners()`
  const int* vertices;        ///< three per facet
  const int* opposite;        ///< as in `Facet_adjacency`

  /// Calls `f(u)` for the neighbors u of `v`.
  template <class F>
  CGAL_POWER_RTF_HD void for_each(int v, const F& f) const
  {
    // Every edge is one halfedge from each of its ends, except border edges: they have one only.
    for (int k = first[v]; k < first[v + 1]; ++k) {
      const int h = corners[k], before = previous_halfedge(h);
      if (opposite[before] < 0) f(vertices[before]);
      f(vertices[next_halfedge(h)]);
    }
  }
};

struct Count_neighbors {
  Vertex_neighbors neighbors;
  int* counts;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    int count = 0;
    neighbors.for_each(v, [&](int) { ++count; });
    counts[v] = count;
  }
};

struct List_neighbors {
  Vertex_neighbors neighbors;
  const Vec3d* points;
  const int* first; ///< the rows, which are to be filled
  int* neighbor;
  double* lengths;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    int end = first[v];
    neighbors.for_each(v, [&](int u) {
      neighbor[end] = u;
      lengths[end++] = length(points[u] - points[v]);
    });
  }
};

} // namespace internal
} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_EDGES_VIEW_H
