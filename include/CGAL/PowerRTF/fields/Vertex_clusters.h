// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A coarser graph of a surface for what varies slowly against its edges: clusters of vertices
// around independent ones, and clusters of these. (The coarsening of multilevel methods; the
// independent sets are those of Blelloch, Fineman and Shun, "Greedy sequential maximal independent
// set and matching are parallel on average", 2012.)
#ifndef CGAL_POWER_RTF_FIELDS_VERTEX_CLUSTERS_H
#define CGAL_POWER_RTF_FIELDS_VERTEX_CLUSTERS_H

#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/mixed_bits.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

struct Vertex_clusters {
  std::vector<int> centers;    ///< a vertex of each cluster
  std::vector<int> cluster_of; ///< by vertex
  Surface_edges edges;         ///< of clusters that edges join, between their centers
  double longest = 0;          ///< of the edges within clusters
};

namespace internal {

/// Of the vertices that may be left as centers if there is to be a further level of clusters: it
/// costs as much as it has vertices.
constexpr double largest_share_of_centers = 0.7;

/// A maximal set of vertices no two of which an edge joins that is not longer than `longest`: the
/// one that is made by taking vertices in a random order, whatever the threads do.
class Independent_set {
public:
  Independent_set(const Surface_edges& edges, double longest)
      : m_edges(edges), m_longest(longest), m_states(edges.first.size() - 1, unknown)
  {}

  bool contains(int v)
  {
    const int known = atomic_load(&m_states[v]);
    if (known != unknown) return known == inside;
    bool is_free = true;
    for (int e = m_edges.first[v]; e < m_edges.first[v + 1] && is_free; ++e) {
      const int u = m_edges.neighbor[e];
      is_free = m_edges.length[e] > m_longest || rank(u) > rank(v) || !contains(u);
    }
    atomic_store(&m_states[v], is_free ? inside : outside);
    return is_free;
  }

private:
  enum State { unknown, inside, outside };
  static std::uint64_t rank(int v) { return mixed_bits(static_cast<std::uint64_t>(v)); }

  const Surface_edges& m_edges;
  double m_longest;
  std::vector<int> m_states;
};

/// The edges between clusters, given the vertices of each.
inline Surface_edges cluster_edges(const std::vector<Vec3d>& points, const Surface_edges& edges,
                                   const Vertex_clusters& clusters, Concurrency concurrency)
{
  const int vertices = static_cast<int>(clusters.cluster_of.size()),
            size = static_cast<int>(clusters.centers.size());
  const Buckets<int> members(
      concurrency, vertices, clusters.centers.size(), [&](int v) { return clusters.cluster_of[v]; },
      [](int v) { return v; });
  const auto find_neighbors = [&](int c, std::vector<int>& found) {
    found.clear();
    for (int k = members.first[c]; k < members.first[c + 1]; ++k) {
      const int v = members.entries[k];
      for (int e = edges.first[v]; e < edges.first[v + 1]; ++e) {
        const int d = clusters.cluster_of[edges.neighbor[e]];
        if (d != c) found.push_back(d);
      }
    }
    sort_uniquely(found);
  };
  const auto for_each_neighbors = [&](auto&& f) {
    for_each_chunk(concurrency, size, 256, [&](int begin, int end) {
      std::vector<int> found;
      for (int c = begin; c < end; ++c) {
        find_neighbors(c, found);
        f(c, found);
      }
    });
  };
  Surface_edges result;
  result.first.assign(size + 1, 0);
  for_each_neighbors([&](int c, const std::vector<int>& found) {
    result.first[c] = static_cast<int>(found.size());
  });
  exclusive_scan(concurrency, size + 1, result.first.data());
  result.neighbor.resize(result.first[size]);
  result.length.resize(result.first[size]);
  for_each_neighbors([&](int c, const std::vector<int>& found) {
    int end = result.first[c];
    for (const int d : found) {
      result.neighbor[end] = d;
      result.length[end++] = length(points[clusters.centers[d]] - points[clusters.centers[c]]);
    }
  });
  return result;
}

/// Clusters of an independent set, and of the vertices that edges not longer than `longest` join to
/// it, each to the nearest. `vertex(v)` is the surface's vertex that `v` of `edges` stands for.
template <class Vertex>
Vertex_clusters cluster_once(const std::vector<Vec3d>& points, const Surface_edges& edges,
                             const Vertex& vertex, double longest, Concurrency concurrency)
{
  constexpr double clearly_less = 0.999; // rounding must not decide between equal lengths
  const int vertices = static_cast<int>(edges.first.size()) - 1;
  Independent_set set(edges, longest);
  Vertex_clusters result;
  result.centers = select(concurrency, vertices, [&](int v) { return set.contains(v); });
  const int size = static_cast<int>(result.centers.size());
  std::vector<int>& cluster_of = result.cluster_of;
  cluster_of.resize(vertices);
  for_each_index(concurrency, size, [&](int c) { cluster_of[result.centers[c]] = c; });
  for_each_index(concurrency, vertices, [&](int v) {
    if (set.contains(v)) return;
    int nearest = -1;
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
      if (set.contains(edges.neighbor[e]) &&
          (nearest < 0 || edges.length[e] < clearly_less * edges.length[nearest]))
        nearest = e;
    cluster_of[v] = cluster_of[edges.neighbor[nearest]];
  });
  for_each_index(concurrency, size, [&](int c) { result.centers[c] = vertex(result.centers[c]); });
  result.edges = cluster_edges(points, edges, result, concurrency);
  return result;
}

} // namespace internal

/// Clusters along edges not longer than `longest`: between them there are hardly any shorter ones.
/// Longer edges stay as they are.
inline Vertex_clusters vertex_clusters(const std::vector<Vec3d>& points, const Surface_edges& edges,
                                       double longest,
                                       internal::Concurrency concurrency = Sequential_tag())
{
  Vertex_clusters all = internal::cluster_once(
      points, edges, [](int v) { return v; }, longest, concurrency);
  for (std::size_t before = points.size();
       double(all.centers.size()) < internal::largest_share_of_centers * double(before);) {
    before = all.centers.size();
    Vertex_clusters next = internal::cluster_once(
        points, all.edges, [&](int c) { return all.centers[c]; }, longest, concurrency);
    internal::for_each_index(concurrency, static_cast<int>(points.size()), [&](int v) {
      all.cluster_of[v] = next.cluster_of[all.cluster_of[v]];
    });
    all.centers.swap(next.centers);
    std::swap(all.edges, next.edges);
  }
  all.longest = longest;
  return all;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_VERTEX_CLUSTERS_H
