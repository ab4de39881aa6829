// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface as an engine gets it.
#ifndef CGAL_POWER_RTF_ENGINES_PACKED_SURFACE_H
#define CGAL_POWER_RTF_ENGINES_PACKED_SURFACE_H

#include <CGAL/PowerRTF/engines/Engine_base.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>
#include <numeric>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Adds what the rules over the nearest vertices look at. `places`: of the vertices.
inline void add_vertex_tree(const Surface& surface, const Facet_tree& tree,
                            const std::vector<int>& places, Packed_surface& result)
{
  const Packed_tree_layout layout(static_cast<int>(places.size()));
  result.vertex_nodes = child_boxes(layout, [&](int place) {
    const Vec3d& p = result.vertices[place].point;
    return Box3<double>{p, p};
  });
  std::vector<int>& first = result.first_facet;
  first.assign(places.size() + 1, 0);
  for (const Triangle& t : surface.triangles)
    for (const int v : t) ++first[places[v] + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  result.vertex_facets.resize(first.back());
  std::vector<int> end(first.begin(), first.end() - 1);
  for (std::size_t f = 0; f < surface.triangles.size(); ++f)
    for (const int v : surface.triangles[f])
      result.vertex_facets[end[places[v]]++] = tree.place(static_cast<int>(f));
}

/// The surface in the order of its trees; `tree`: of its facets.
inline Packed_surface packed_surface(const Surface& surface, const Facet_tree& tree,
                                     const Remeshing_options& options,
                                     Concurrency concurrency = Sequential_tag())
{
  Packed_surface result;
  std::vector<int> places(surface.points.size()); // of the vertices
  const std::vector<int> order = spatial_order(surface.points, concurrency);
  result.vertices.resize(order.size());
  for_each_index(concurrency, static_cast<int>(order.size()), [&](int k) {
    const int v = order[k];
    places[v] = k;
    result.vertices[k] = {surface.points[v], surface.vertex_normals[v], surface.vertex_density[v]};
  });
  const Surface_view<double> view = tree.view();
  result.has_patches = view.patches != nullptr;
  result.facets.resize(surface.triangles.size());
  for_each_index(concurrency, view.facet_tree.items, [&](int k) {
    const Facet_corners<double>& f = view.facets[k];
    const Triangle& t = surface.triangles[tree.order()[k]];
    result.facets[k] = {{f.a, f.b, f.c},
                        f.normal,
                        {places[t[0]], places[t[1]], places[t[2]]},
                        view.patches ? view.patches[k] : 0};
  });
  result.facet_nodes = tree.nodes();
  result.area = surface.area;
  if (options.projection == Projection::nearest_vertices ||
      options.attributes == Attributes::nearest_vertices)
    add_vertex_tree(surface, tree, places, result);
  return result;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_PACKED_SURFACE_H
