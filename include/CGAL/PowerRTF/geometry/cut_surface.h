// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface cut open along its creases: each side of a crease gets vertices and normals of its
// own, so that nothing that works on edges or normals (curvature, smoothing, interpolation) looks
// across. The facets keep their numbers.
#ifndef CGAL_POWER_RTF_GEOMETRY_CUT_SURFACE_H
#define CGAL_POWER_RTF_GEOMETRY_CUT_SURFACE_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/surface_geometry.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

struct Cut_surface {
  Surface surface;            ///< no creases; its patches are its components
  std::vector<int> originals; ///< for each vertex of `surface`, the one that it is a copy of
};

namespace internal {

/// Names the kept edges of `surface` by the vertices of `cut`, which has the same facets.
inline void keep_cut_edges(const Surface& surface, Surface& cut)
{
  if (surface.kept_edges.empty()) return;
  const auto edge = [](const Surface& s, int h) {
    return sorted_edge(halfedge_source(s.triangles, h), halfedge_target(s.triangles, h));
  };
  cut.kept_edges.clear();
  for (int h = 0; h < static_cast<int>(3 * surface.triangles.size()); ++h)
    if (std::binary_search(surface.kept_edges.begin(), surface.kept_edges.end(), edge(surface, h)))
      cut.kept_edges.push_back(edge(cut, h));
  sort_uniquely(cut.kept_edges);
}

} // namespace internal

/// Cuts `surface` along its creases (which are edges between two facets). The first copy of a
/// vertex keeps its number.
inline Cut_surface cut_along_creases(const Surface& surface)
{
  const auto& triangles = surface.triangles;
  const auto opposite = [&](int h) {
    const int o = surface.adjacency.opposite[h];
    if (o == Facet_adjacency::none) return o;
    const bool is_crease = std::binary_search(
        surface.creases.begin(), surface.creases.end(),
        sorted_edge(halfedge_source(triangles, h), halfedge_target(triangles, h)));
    return is_crease ? Facet_adjacency::none : o;
  };

  Cut_surface cut;
  cut.surface = surface;
  cut.surface.creases.clear();
  cut.surface.contacts.clear();
  cut.surface.kept_vertices.clear();
  cut.surface.kept_points.clear();
  for (std::size_t v = 0; v < surface.points.size(); ++v)
    cut.originals.push_back(static_cast<int>(v));
  std::vector<char> taken(surface.points.size(), 0);
  for_each_fan(surface.adjacency.opposite.size(), opposite, [&](const std::vector<int>& fan) {
    const int v = halfedge_source(triangles, fan[0]);
    if (!taken[v]) {
      taken[v] = 1;
      return;
    }
    for (const int h : fan)
      cut.surface.triangles[h / 3][h % 3] = static_cast<int>(cut.surface.points.size());
    cut.originals.push_back(v);
    cut.surface.points.push_back(surface.points[v]);
    cut.surface.vertex_density.push_back(surface.vertex_density[v]);
    cut.surface.input_vertices.push_back(surface.input_vertices[v]);
  });
  internal::keep_cut_edges(surface, cut.surface);
  cut.surface.adjacency = facet_adjacency(cut.surface.triangles, cut.surface.points.size());
  compute_geometry(cut.surface);
  cut.surface.facet_patches = facet_components(cut.surface.adjacency).first;
  return cut;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_CUT_SURFACE_H
