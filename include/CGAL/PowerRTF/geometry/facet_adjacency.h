// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which facets share an edge, and whether the triangles form an oriented 2-manifold.
// Everything is linear in the number of facets: edges are found at their smaller vertices.
#ifndef CGAL_POWER_RTF_GEOMETRY_FACET_ADJACENCY_H
#define CGAL_POWER_RTF_GEOMETRY_FACET_ADJACENCY_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/halfedge_numbers.h>
#include <CGAL/PowerRTF/geometry/vertex_corners.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/connected_components.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <boost/container/small_vector.hpp>
#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

inline int halfedge_source(const std::vector<Triangle>& triangles, int h)
{
  return triangles[h / 3][h % 3];
}
inline int halfedge_target(const std::vector<Triangle>& triangles, int h)
{
  return triangles[h / 3][(h + 1) % 3];
}
/// The facet's corner that is not on halfedge `h`.
inline int opposite_vertex(const std::vector<Triangle>& triangles, int h)
{
  return triangles[h / 3][(h + 2) % 3];
}

namespace internal {

/// Writes for each halfedge that of the other facet, where there is one. `corners`:
/// `vertex_corners()`.
/// \returns what else there is to know of the adjacency
inline Facet_adjacency find_opposites(const std::vector<Triangle>& triangles,
                                      const Buckets<int>& corners, int* opposite,
                                      Concurrency concurrency)
{
  using Ends = boost::container::small_vector<std::pair<int, int>, 16>;
  // The facets at one edge.
  const auto join = [&](Facet_adjacency& found, Ends::const_iterator begin,
                        Ends::const_iterator stop) {
    for (auto f = begin; f != stop; ++f)
      for (auto g = begin; g != f; ++g)
        if (opposite_vertex(triangles, g->second) == opposite_vertex(triangles, f->second))
          found.repeated_facets = true;
    if (stop - begin == 1) {
      ++found.border_edges;
    } else if (stop - begin == 2) {
      const int h = begin->second, o = (begin + 1)->second;
      opposite[h] = o;
      opposite[o] = h;
      if (halfedge_source(triangles, h) == halfedge_source(triangles, o))
        found.same_direction = true;
    } else {
      ++found.non_manifold_edges;
    }
  };
  return reduce(
      concurrency, static_cast<int>(corners.first.size()) - 1, Facet_adjacency(),
      [&](Facet_adjacency& found, int v) {
        Ends ends; // of the edges from v to larger vertices: these, and the halfedges
        for (int k = corners.first[v]; k < corners.first[v + 1]; ++k) {
          const int h = corners.entries[k], before = previous_halfedge(h);
          const int to = halfedge_target(triangles, h), from = opposite_vertex(triangles, h);
          if (to > v) ends.emplace_back(to, h);
          if (from > v) ends.emplace_back(from, before);
        }
        std::sort(ends.begin(), ends.end());
        for (auto e = ends.begin(), f = e; e != ends.end(); e = f) {
          while (f != ends.end() && f->first == e->first) ++f;
          join(found, e, f);
        }
      },
      [](Facet_adjacency& sum, const Facet_adjacency& part) {
        sum.border_edges += part.border_edges;
        sum.non_manifold_edges += part.non_manifold_edges;
        sum.same_direction |= part.same_direction;
        sum.repeated_facets |= part.repeated_facets;
      });
}

} // namespace internal

/// Finds the facets that share each edge of `triangles`, whose indices are in
/// `[0, number_of_vertices)` and differ within a triangle.
inline Facet_adjacency facet_adjacency(const std::vector<Triangle>& triangles,
                                       std::size_t number_of_vertices,
                                       internal::Concurrency concurrency = Sequential_tag())
{
  internal::Buckets<int> corners = vertex_corners(triangles, number_of_vertices, concurrency);
  std::vector<int> opposite;
  internal::resize_in_parallel(concurrency, opposite, 3 * triangles.size(), Facet_adjacency::none);
  Facet_adjacency result =
      internal::find_opposites(triangles, corners, opposite.data(), concurrency);
  result.opposite = std::move(opposite);
  result.corners = std::move(corners);
  return result;
}

/// The edges where no facet follows, smaller vertex first, sorted.
inline std::vector<Edge> border_edges(const std::vector<Triangle>& triangles,
                                      const Facet_adjacency& adjacency)
{
  std::vector<Edge> edges;
  for (int h = 0; h < static_cast<int>(adjacency.opposite.size()); ++h)
    if (adjacency.opposite[h] == Facet_adjacency::none)
      edges.push_back(sorted_edge(halfedge_source(triangles, h), halfedge_target(triangles, h)));
  sort_uniquely(edges);
  return edges;
}

/// The component of each facet: facets that share an edge have the same number. Numbered by
/// the first facet of each component.
/// \returns the numbers (#F) and the number of components
inline std::pair<std::vector<int>, int>
facet_components(const Facet_adjacency& adjacency,
                 internal::Concurrency concurrency = Sequential_tag())
{
  return internal::connected_components(
      concurrency, static_cast<int>(adjacency.opposite.size() / 3), [&](int f, auto&& join) {
        for (int h = 3 * f; h < 3 * f + 3; ++h)
          if (adjacency.opposite[h] > h) join(adjacency.opposite[h] / 3);
      });
}

/// Calls `at_fan` for each fan of facets around a vertex, in the order of their first halfedges,
/// with the fan's halfedges that leave the vertex (as a vector). Needs consistent orientations.
/// \param opposite function halfedge -> the halfedge of the next facet, or `none`
template <class Opposite, class At_fan>
void for_each_fan(std::size_t halfedges, const Opposite& opposite, const At_fan& at_fan)
{
  std::vector<char> visited(halfedges, 0);
  std::vector<int> fan;
  for (int start = 0; start < static_cast<int>(halfedges); ++start) {
    internal::Cancellation::poll_now_and_then();
    if (visited[start]) continue;
    fan.clear();
    const auto visit = [&](int h) {
      visited[h] = 1;
      fan.push_back(h);
    };
    int h = start; // counter-clockwise around the source, then clockwise if a border stopped it
    do {
      visit(h);
      h = opposite(previous_halfedge(h));
    } while (h != Facet_adjacency::none && h != start);
    if (h != start)
      for (h = opposite(start); h != Facet_adjacency::none; h = opposite(h)) {
        h = next_halfedge(h);
        visit(h);
      }
    at_fan(fan);
  }
}

/// The number of vertices whose facets form more than one fan. Needs consistent orientations.
inline std::size_t count_non_manifold_vertices(const internal::Buckets<int>& corners,
                                               const int* opposite,
                                               internal::Concurrency concurrency)
{
  // Whether the fan of one facet is not all that there is.
  const auto has_more = [&](int v) {
    const int facets_at = corners.first[v + 1] - corners.first[v];
    if (facets_at == 0) return false;
    const int start = corners.entries[corners.first[v]];
    int facets = 0, h = start;
    do { // counter-clockwise, then clockwise if a border stopped it
      ++facets;
      h = opposite[previous_halfedge(h)];
    } while (h != Facet_adjacency::none && h != start);
    if (h == Facet_adjacency::none)
      for (h = opposite[start]; h != Facet_adjacency::none; h = opposite[next_halfedge(h)])
        ++facets;
    return facets < facets_at;
  };
  return internal::reduce(
      concurrency, static_cast<int>(corners.first.size()) - 1, std::size_t(0),
      [&](std::size_t& count, int v) { count += has_more(v); },
      [](std::size_t& count, std::size_t part) { count += part; });
}
inline std::size_t count_non_manifold_vertices(const Facet_adjacency& adjacency,
                                               internal::Concurrency concurrency = Sequential_tag())
{
  return count_non_manifold_vertices(adjacency.corners, adjacency.opposite.data(), concurrency);
}

/// Turns facets so that neighbors agree; in each component as few as possible.
/// \param partners function halfedge -> range of the halfedges that must run the other way
/// \param is_allowed function halfedge, partner -> bool, called where neighbors cannot agree:
///   whether to go on
/// \returns false if a component cannot be oriented; `turned` counts the turned facets
template <class Partners, class IsAllowed>
bool orient_facets(std::vector<Triangle>& triangles, const Partners& partners,
                   const IsAllowed& is_allowed, std::size_t& turned)
{
  const int facets = static_cast<int>(triangles.size());
  std::vector<char> side(facets, -1); // 1: turned with respect to the component's first facet
  std::vector<int> component;
  for (int seed = 0; seed < facets; ++seed) {
    if (side[seed] >= 0) continue;
    component.assign(1, seed);
    side[seed] = 0;
    std::size_t ones = 0;
    for (std::size_t k = 0; k < component.size(); ++k) {
      internal::Cancellation::poll_now_and_then();
      const int f = component[k];
      ones += side[f];
      for (int h = 3 * f; h < 3 * f + 3; ++h)
        for (const int o : partners(h)) {
          const bool differ = halfedge_source(triangles, h) == halfedge_source(triangles, o);
          const char expected = differ ? 1 - side[f] : side[f];
          if (side[o / 3] < 0) {
            side[o / 3] = expected;
            component.push_back(o / 3);
          } else if (side[o / 3] != expected && !is_allowed(h, o))
            return false;
        }
    }
    const char minority = 2 * ones <= component.size() ? 1 : 0;
    for (const int f : component) side[f] = side[f] == minority;
    turned += minority == 1 ? ones : component.size() - ones;
  }
  for (int f = 0; f < facets; ++f)
    if (side[f]) std::swap(triangles[f][1], triangles[f][2]);
  return true;
}

/// The same, of facets that share an edge with one other.
/// \returns the edges, smaller vertex first, sorted, at which neighbors do not agree: a component
///   with one side only is oriented once it is cut there
inline std::vector<Edge> orient_facets(std::vector<Triangle>& triangles,
                                       const Facet_adjacency& adjacency, std::size_t& turned)
{
  std::vector<Edge> seams;
  orient_facets(
      triangles,
      [&](int h) {
        return boost::make_iterator_range_n(&adjacency.opposite[h],
                                            adjacency.opposite[h] == Facet_adjacency::none ? 0 : 1);
      },
      [&](int h, int) {
        seams.push_back(sorted_edge(halfedge_source(triangles, h), halfedge_target(triangles, h)));
        return true;
      },
      turned);
  sort_uniquely(seams);
  return seams;
}

/// Whether the facets at each vertex form one fan, whatever their orientations.
inline bool has_single_fans(const std::vector<Triangle>& triangles,
                            const Facet_adjacency& adjacency, std::size_t number_of_vertices)
{
  // An edge joins two facets at both its ends; a fan of k facets has k - 1 edges, or k if closed.
  std::vector<int> parent(3 * triangles.size());
  for (std::size_t c = 0; c < parent.size(); ++c) parent[c] = static_cast<int>(c);
  const auto root = [&](int c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  const auto corner_at = [&](int f, int v) {
    return triangles[f][0] == v ? 3 * f : triangles[f][1] == v ? 3 * f + 1 : 3 * f + 2;
  };
  for (int h = 0; h < static_cast<int>(adjacency.opposite.size()); ++h) {
    if (adjacency.opposite[h] < h) continue;
    for (const int v : {halfedge_source(triangles, h), halfedge_target(triangles, h)})
      parent[root(corner_at(h / 3, v))] = root(corner_at(adjacency.opposite[h] / 3, v));
  }
  std::vector<int> fan(number_of_vertices, -1);
  for (int c = 0; c < static_cast<int>(parent.size()); ++c) {
    int& of_vertex = fan[triangles[c / 3][c % 3]];
    if (of_vertex < 0)
      of_vertex = root(c);
    else if (of_vertex != root(c))
      return false;
  }
  return true;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_FACET_ADJACENCY_H
