// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Euler characteristic and border loops of each component, and whether a mesh on samples has those
// of the surface that these lie on.
#ifndef CGAL_POWER_RTF_EXTRACTION_COMPONENT_TOPOLOGY_H
#define CGAL_POWER_RTF_EXTRACTION_COMPONENT_TOPOLOGY_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Of an oriented 2-manifold.
struct Component_topology {
  std::vector<int> component_of_facet;
  std::vector<long> euler_characteristic; ///< by component
  std::vector<long> border_loops;         ///< by component

  Component_topology(const std::vector<Triangle>& triangles, const Facet_adjacency& adjacency,
                     std::size_t vertices)
  {
    auto found = facet_components(adjacency);
    component_of_facet = std::move(found.first);
    border_loops.assign(found.second, 0);
    std::vector<long> twice(found.second, 0); // the Euler characteristics
    std::vector<char> is_counted(vertices, 0);
    std::vector<int> outgoing(vertices, Facet_adjacency::none); // along the border
    for (int h = 0; h < static_cast<int>(3 * triangles.size()); ++h) {
      const int c = component_of_facet[h / 3], v = halfedge_source(triangles, h);
      if (!is_counted[v]) twice[c] += 2;
      is_counted[v] = 1;
      if (h % 3 == 0) twice[c] += 2;
      twice[c] -= adjacency.opposite[h] == Facet_adjacency::none ? 2 : 1;
      if (adjacency.opposite[h] == Facet_adjacency::none) outgoing[v] = h;
    }
    for (std::size_t v = 0; v < vertices; ++v) {
      if (outgoing[v] == Facet_adjacency::none) continue;
      ++border_loops[component_of_facet[outgoing[v] / 3]];
      for (int h = outgoing[v]; h != Facet_adjacency::none;
           h = std::exchange(outgoing[halfedge_target(triangles, h)], Facet_adjacency::none))
        ;
    }
    for (const long t : twice) euler_characteristic.push_back(t / 2);
  }

  int components() const { return static_cast<int>(border_loops.size()); }
};

/// Whether the triangles on the samples, which form one fan at each, are homeomorphic to the
/// surface: oriented, and for each of its components there is one of theirs on the samples of that
/// with the same Euler characteristic and as many border loops.
inline bool is_homeomorphic(const Surface& surface, const Samples& samples,
                            const std::vector<Triangle>& triangles)
{
  const Facet_adjacency adjacency = facet_adjacency(triangles, samples.size());
  if (adjacency.non_manifold_edges > 0 || adjacency.same_direction) return false;
  const Component_topology mesh(triangles, adjacency, samples.size());
  const Component_topology whole(surface.triangles, surface.adjacency, surface.points.size());
  if (mesh.components() != whole.components()) return false;
  std::vector<int> partner(mesh.components(), -1); // of the mesh's components
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const int s : triangles[t]) {
      const int c = whole.component_of_facet[samples.facets[s]];
      int& its = partner[mesh.component_of_facet[t]];
      if (its >= 0 && its != c) return false;
      its = c;
    }
  std::vector<char> is_taken(whole.components(), 0);
  for (int c = 0; c < mesh.components(); ++c) {
    const int its = partner[c];
    if (is_taken[its] || mesh.euler_characteristic[c] != whole.euler_characteristic[its] ||
        mesh.border_loops[c] != whole.border_loops[its])
      return false;
    is_taken[its] = 1;
  }
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_COMPONENT_TOPOLOGY_H
