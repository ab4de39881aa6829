// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Removes facets without area and keeps the rest of the surface as it is: needles lose their short
// edge, caps are flipped away (Botsch and Kobbelt 2001).
#ifndef CGAL_POWER_RTF_GEOMETRY_DEGENERATE_FACETS_H
#define CGAL_POWER_RTF_GEOMETRY_DEGENERATE_FACETS_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/facet_shape.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

namespace CGAL::PowerRTF {

inline std::vector<int> degenerate_facets(const std::vector<Vec3d>& points,
                                          const std::vector<Triangle>& triangles,
                                          internal::Concurrency concurrency = Sequential_tag())
{
  return internal::select(concurrency, static_cast<int>(triangles.size()), [&](int f) {
    const Triangle& t = triangles[f];
    return is_degenerate(points[t[0]], points[t[1]], points[t[2]]);
  });
}

namespace internal {

inline double edge_length(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles,
                          int h)
{
  return length(points[halfedge_target(triangles, h)] - points[halfedge_source(triangles, h)]);
}

/// The longest halfedge of facet `f`.
inline int longest_halfedge(const std::vector<Vec3d>& points,
                            const std::vector<Triangle>& triangles, int f)
{
  int longest = 3 * f;
  for (int h = 3 * f + 1; h < 3 * f + 3; ++h)
    if (edge_length(points, triangles, h) > edge_length(points, triangles, longest)) longest = h;
  return longest;
}

/// Whether the triangle repeats a vertex.
inline bool is_collapsed(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Removes the triangles that repeat a vertex. \returns their number
inline std::size_t drop_collapsed(std::vector<Triangle>& triangles)
{
  const auto kept = std::remove_if(triangles.begin(), triangles.end(), is_collapsed);
  const std::size_t dropped = triangles.end() - kept;
  triangles.erase(kept, triangles.end());
  return dropped;
}

/// Merges the ends of edges that are short within a degenerate facet; facets that lose a corner so
/// are dropped.
/// \returns the number of merged vertices
inline std::size_t collapse_needles(const std::vector<Vec3d>& points,
                                    std::vector<Triangle>& triangles)
{
  boost::disjoint_sets_with_storage<> merged(points.size());
  std::size_t count = 0;
  for (const int f : degenerate_facets(points, triangles)) {
    const double longest = edge_length(points, triangles, longest_halfedge(points, triangles, f));
    const double limit = (std::max)(degenerate_aspect * longest, unit_box_rounding);
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      if (edge_length(points, triangles, h) > limit) continue;
      const int a = merged.find_set(halfedge_source(triangles, h));
      const int b = merged.find_set(halfedge_target(triangles, h));
      if (a == b) continue;
      merged.link(a, b);
      ++count;
    }
  }
  if (count == 0) return 0;
  for (Triangle& t : triangles)
    for (int& v : t) v = merged.find_set(v);
  drop_collapsed(triangles);
  return count;
}

/// One pass of flips of the longest edges of degenerate facets; at a border the facet is dropped.
/// \returns whether anything changed
inline bool flip_caps(const std::vector<Vec3d>& points, std::vector<Triangle>& triangles)
{
  const std::vector<int> caps = degenerate_facets(points, triangles);
  if (caps.empty()) return false;
  const auto key = [](int a, int b) {
    return std::uint64_t((std::min)(a, b)) << 32 | std::uint32_t((std::max)(a, b));
  };
  const Facet_adjacency adjacency = facet_adjacency(triangles, points.size());
  std::unordered_set<std::uint64_t> edges;
  for (int h = 0; h < static_cast<int>(3 * triangles.size()); ++h)
    edges.insert(key(halfedge_source(triangles, h), halfedge_target(triangles, h)));

  std::vector<char> touched(triangles.size(), 0), dropped(triangles.size(), 0);
  bool changed = false;
  for (const int f : caps) {
    const int h = longest_halfedge(points, triangles, f), o = adjacency.opposite[h];
    if (touched[f]) continue;
    if (o == Facet_adjacency::none) {
      touched[f] = dropped[f] = 1;
      changed = true;
      continue;
    }
    const int g = o / 3;
    const int b = halfedge_source(triangles, h), c = halfedge_target(triangles, h);
    const int a = opposite_vertex(triangles, h), d = opposite_vertex(triangles, o);
    if (touched[g] || a == d || edges.count(key(a, d))) continue;
    const bool both = is_degenerate(points[b], points[c], points[d]);
    if (both && length(points[d] - points[a]) >= length(points[c] - points[b])) continue;
    triangles[f] = {a, b, d};
    triangles[g] = {a, d, c};
    edges.insert(key(a, d));
    edges.erase(key(b, c));
    touched[f] = touched[g] = 1;
    changed = true;
  }
  std::size_t kept = 0;
  for (std::size_t f = 0; f < triangles.size(); ++f)
    if (!dropped[f]) triangles[kept++] = triangles[f];
  triangles.resize(kept);
  return changed;
}

} // namespace internal

/// Removes the degenerate facets of an oriented 2-manifold as far as it stays one; otherwise leaves
/// `triangles` as they are.
/// \returns the number of vertices that were merged with others
inline std::size_t remove_degenerate_facets(const std::vector<Vec3d>& points,
                                            std::vector<Triangle>& triangles)
{
  constexpr int max_passes = 20; // a pass frees the next facet of a row of caps
  std::vector<Triangle> mended = triangles;
  std::size_t merged = 0;
  for (int pass = 0; pass < max_passes; ++pass) {
    merged += internal::collapse_needles(points, mended);
    if (!internal::flip_caps(points, mended)) break;
  }
  if (mended.empty()) return 0;
  const Facet_adjacency adjacency = facet_adjacency(mended, points.size());
  if (adjacency.non_manifold_edges > 0 || adjacency.same_direction || adjacency.repeated_facets ||
      count_non_manifold_vertices(adjacency) > 0)
    return 0;
  triangles = std::move(mended);
  return merged;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_DEGENERATE_FACETS_H
