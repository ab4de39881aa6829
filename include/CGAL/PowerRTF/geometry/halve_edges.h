// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Splits facets at the middles of their edges: the surface stays where it is, in smaller facets.
#ifndef CGAL_POWER_RTF_GEOMETRY_HALVE_EDGES_H
#define CGAL_POWER_RTF_GEOMETRY_HALVE_EDGES_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/surface_geometry.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// Cuts `t` at the middles of its edges (-1: not halved), into one piece more than there are
/// middles.
inline void split_at_middles(const std::vector<Vec3d>& points, Triangle t,
                             std::array<int, 3> middles, Triangle* pieces)
{
  const auto count = 3 - std::count(middles.begin(), middles.end(), -1);
  const auto turn = [&] {
    std::rotate(t.begin(), t.begin() + 1, t.end());
    std::rotate(middles.begin(), middles.begin() + 1, middles.end());
  };
  const auto put = [&pieces](std::initializer_list<Triangle> all) {
    pieces = std::copy(all.begin(), all.end(), pieces);
  };
  if (count == 0) {
    put({t});
  } else if (count == 1) {
    while (middles[0] < 0) turn();
    put({{t[0], middles[0], t[2]}, {middles[0], t[1], t[2]}});
  } else if (count == 2) { // the quadrangle t0, t1, m1, m2 by its shorter diagonal
    while (middles[0] >= 0) turn();
    const auto [m0, m1, m2] = middles;
    put({{m1, t[2], m2}});
    if (squared_length(points[t[0]] - points[m1]) < squared_length(points[t[1]] - points[m2]))
      put({{t[0], t[1], m1}, {t[0], m1, m2}});
    else
      put({{t[0], t[1], m2}, {t[1], m1, m2}});
  } else {
    const auto [m0, m1, m2] = middles;
    put({{t[0], m0, m2}, {m0, t[1], m1}, {m2, m1, t[2]}, {m0, m1, m2}});
  }
}

/// Replaces each edge of `edges`, sorted, that has been halved by its halves.
inline void halve_listed(std::vector<Edge>& edges,
                         const std::vector<std::pair<Edge, int>>& sorted_middles)
{
  std::vector<Edge> halves;
  for (const Edge& e : edges) {
    const auto middle =
        std::lower_bound(sorted_middles.begin(), sorted_middles.end(), std::make_pair(e, -1));
    if (middle == sorted_middles.end() || middle->first != e) {
      halves.push_back(e);
    } else {
      halves.push_back({e[0], middle->second});
      halves.push_back({e[1], middle->second});
    }
  }
  std::sort(halves.begin(), halves.end());
  edges.swap(halves);
}

/// The halfedges at the seams of a network where more than two facets meet, which have no opposite,
/// by their edges.
inline std::vector<std::pair<Edge, int>> crowded_halfedges(const Surface& surface)
{
  std::vector<std::pair<Edge, int>> result;
  const int halfedges = surface.seams.empty() ? 0 : int(surface.adjacency.opposite.size());
  for (int h = 0; h < halfedges; ++h) {
    if (surface.adjacency.opposite[h] != Facet_adjacency::none) continue;
    const Edge edge =
        sorted_edge(halfedge_source(surface.triangles, h), halfedge_target(surface.triangles, h));
    if (std::binary_search(surface.seams.begin(), surface.seams.end(), edge))
      result.emplace_back(edge, h);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The first of `crowded`, which are `crowded_halfedges()`, that is not before those of an edge.
inline auto first_at(const std::vector<std::pair<Edge, int>>& crowded, const Edge& edge)
{
  return std::lower_bound(crowded.begin(), crowded.end(), std::make_pair(edge, -1));
}

/// One of `halfedges` for each edge.
inline std::vector<int> one_by_edge(const Surface& surface,
                                    const std::vector<std::pair<Edge, int>>& crowded,
                                    std::vector<int> halfedges)
{
  if (crowded.empty()) return halfedges;
  for (int& h : halfedges) {
    const Edge edge =
        sorted_edge(halfedge_source(surface.triangles, h), halfedge_target(surface.triangles, h));
    const auto first = first_at(crowded, edge);
    if (first != crowded.end() && first->first == edge) h = first->second;
  }
  sort_uniquely(halfedges);
  return halfedges;
}

} // namespace internal

/// What `halve_edges()` has done.
struct Halved_edges {
  std::vector<Edge> ends;   ///< for each new vertex, those of its edge
  std::vector<int> parents; ///< for each facet, the former facet that it is a part of
};

/// Halves edges of `surface`, given by one halfedge of each, or by several where more than two
/// facets meet. Its first vertices are the old ones; new ones have the mean density of their edge's
/// ends, and the place in the input of one of them. The halves of creases are creases, those of
/// kept edges kept. Normals and areas are computed anew.
inline Halved_edges halve_edges(Surface& surface, const std::vector<int>& given,
                                internal::Concurrency concurrency = Sequential_tag())
{
  const auto crowded = internal::crowded_halfedges(surface);
  const std::vector<int> halfedges = internal::one_by_edge(surface, crowded, given);
  const std::vector<int>& opposite = surface.adjacency.opposite;
  const int old = static_cast<int>(surface.points.size()),
            count = static_cast<int>(halfedges.size());
  std::vector<int> middles(opposite.size(), -1); // by halfedge
  Halved_edges result;
  result.ends.resize(count);
  surface.points.resize(old + count);
  surface.vertex_density.resize(old + count);
  surface.input_vertices.resize(old + count);
  internal::for_each_index(concurrency, count, [&](int k) {
    const int h = halfedges[k], o = opposite[h], middle = old + k;
    const int a = halfedge_source(surface.triangles, h), b = halfedge_target(surface.triangles, h);
    middles[h] = middle;
    if (o != Facet_adjacency::none) middles[o] = middle;
    const Edge edge = sorted_edge(a, b);
    for (auto other = internal::first_at(crowded, edge);
         other != crowded.end() && other->first == edge; ++other)
      middles[other->second] = middle;
    surface.points[middle] = (surface.points[a] + surface.points[b]) * 0.5;
    surface.vertex_density[middle] = (surface.vertex_density[a] + surface.vertex_density[b]) / 2;
    surface.input_vertices[middle] = surface.input_vertices[a];
    result.ends[k] = edge;
  });

  const int facets = static_cast<int>(surface.triangles.size());
  std::vector<int> first(facets + 1, 0); // of a facet's pieces
  const auto middles_of = [&](int f) {
    return std::array<int, 3>{middles[3 * f], middles[3 * f + 1], middles[3 * f + 2]};
  };
  internal::for_each_index(concurrency, facets, [&](int f) {
    const auto own = middles_of(f);
    first[f] = static_cast<int>(4 - std::count(own.begin(), own.end(), -1));
  });
  internal::exclusive_scan(concurrency, facets + 1, first.data());
  std::vector<Triangle> triangles(first.back());
  result.parents.resize(first.back());
  internal::for_each_index(concurrency, facets, [&](int f) {
    internal::split_at_middles(surface.points, surface.triangles[f], middles_of(f),
                               &triangles[first[f]]);
    for (int k = first[f]; k < first[f + 1]; ++k) result.parents[k] = f;
  });
  surface.topology = {};
  surface.triangles.swap(triangles);
  for (std::vector<int>* const numbers : {&surface.facet_patches, &surface.facet_labels}) {
    if (numbers->empty()) continue;
    std::vector<int> of_pieces(first.back());
    internal::for_each_index(concurrency, first.back(),
                             [&](int k) { of_pieces[k] = (*numbers)[result.parents[k]]; });
    numbers->swap(of_pieces);
  }
  if (!surface.creases.empty() || !surface.kept_edges.empty()) {
    std::vector<std::pair<Edge, int>> sorted_middles;
    for (int k = 0; k < count; ++k) sorted_middles.emplace_back(result.ends[k], old + k);
    std::sort(sorted_middles.begin(), sorted_middles.end());
    internal::halve_listed(surface.creases, sorted_middles);
    internal::halve_listed(surface.seams, sorted_middles);
    internal::halve_listed(surface.kept_edges, sorted_middles);
  }
  surface.adjacency = facet_adjacency(surface.triangles, surface.points.size(), concurrency);
  compute_geometry(surface, concurrency);
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_HALVE_EDGES_H
