// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A part of a surface as a surface of its own, with the samples on it. Where it was cut out, the
// vertices of its border become samples on features, so that the border stays.
#ifndef CGAL_POWER_RTF_EXTRACTION_SURFACE_PIECE_H
#define CGAL_POWER_RTF_EXTRACTION_SURFACE_PIECE_H

#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/internal/Buckets.h>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The samples by where they lie. The last ones lie on features.
class Sample_places {
public:
  Sample_places(const Surface& surface, const Samples& samples, const Feature_samples& features,
                Concurrency concurrency)
      : m_first_feature(static_cast<int>(samples.size() - features.size())), m_features(features),
        m_on_facets(
            concurrency, m_first_feature, surface.triangles.size(),
            [&](int s) { return samples.facets[s]; }, [](int s) { return s; })
  {
    for (int k = 0; k < static_cast<int>(features.size()); ++k)
      m_on_edges.emplace_back(
          sorted_edge(place(m_first_feature + k).from, place(m_first_feature + k).to),
          m_first_feature + k);
    std::sort(m_on_edges.begin(), m_on_edges.end());
  }

  const Edge_place& place(int s) const { return m_features.places[s - m_first_feature]; }

  /// Calls `f(s)` for the samples on a facet.
  template <class F>
  void for_each_on_facet(int facet, F&& f) const
  {
    for (int k = m_on_facets.first[facet]; k < m_on_facets.first[facet + 1]; ++k)
      f(m_on_facets.entries[k]);
  }
  /// The same for those on an edge, or at a vertex: twice that.
  template <class F>
  void for_each_on_edge(const Edge& edge, F&& f) const
  {
    for (auto it = std::lower_bound(m_on_edges.begin(), m_on_edges.end(), std::pair(edge, -1));
         it != m_on_edges.end() && it->first == edge; ++it)
      f(it->second);
  }

private:
  int m_first_feature;
  const Feature_samples& m_features;
  Buckets<int> m_on_facets;
  std::vector<std::pair<Edge, int>> m_on_edges;
};

struct Surface_piece {
  Surface surface;
  Samples samples;
  std::vector<Edge_place> places; ///< of the last samples
  std::vector<int> names;         ///< of the samples in the whole; -1: a vertex of the border

  /// `facets`: of `whole`, sorted.
  Surface_piece(const Surface& whole, const Samples& all, const Sample_places& sample_places,
                const std::vector<int>& facets)
      : m_whole(whole), m_all(all), m_facets(facets)
  {
    cut_out();
    for (int f = 0; f < static_cast<int>(facets.size()); ++f)
      sample_places.for_each_on_facet(facets[f], [&](int s) { add_sample(s, f); });
    add_features(sample_places);
    add_border();
  }

private:
  // Facets that share a vertex, but no chain of edges at it, get copies of it.
  void cut_out()
  {
    const int halfedges = static_cast<int>(3 * m_facets.size());
    std::vector<int>& opposite = surface.adjacency.opposite;
    opposite.assign(halfedges, Facet_adjacency::none);
    for (int h = 0; h < halfedges; ++h) {
      const int o = m_whole.adjacency.opposite[3 * m_facets[h / 3] + h % 3];
      if (o == Facet_adjacency::none) continue;
      const auto f = std::lower_bound(m_facets.begin(), m_facets.end(), o / 3);
      if (f != m_facets.end() && *f == o / 3)
        opposite[h] = 3 * static_cast<int>(f - m_facets.begin()) + o % 3;
    }
    surface.triangles.resize(m_facets.size());
    for_each_fan(
        halfedges, [&](int h) { return opposite[h]; },
        [&](const std::vector<int>& fan) {
          const int v = whole_vertex(fan[0]);
          for (const int h : fan)
            surface.triangles[h / 3][h % 3] = static_cast<int>(surface.points.size());
          m_vertices.push_back(v);
          surface.points.push_back(m_whole.points[v]);
          surface.vertex_normals.push_back(m_whole.vertex_normals[v]);
        });
    for (const int f : m_facets) {
      surface.facet_normals.push_back(m_whole.facet_normals[f]);
      surface.facet_areas.push_back(m_whole.facet_areas[f]);
    }
    for (int h = 0; h < halfedges; ++h)
      if (opposite[h] > h &&
          std::binary_search(m_whole.creases.begin(), m_whole.creases.end(), whole_edge(h)))
        surface.creases.push_back(edge(h));
    std::sort(surface.creases.begin(), surface.creases.end());
    for (int h = 0; h < halfedges; ++h)
      if (std::binary_search(m_whole.kept_edges.begin(), m_whole.kept_edges.end(), whole_edge(h)))
        surface.kept_edges.push_back(edge(h));
    std::sort(surface.kept_edges.begin(), surface.kept_edges.end());
    surface.normalization = m_whole.normalization;
    surface.mirror = m_whole.mirror;
  }

  void add_sample(int s, int f)
  {
    names.push_back(s);
    samples.points.push_back(m_all.points[s]);
    samples.normals.push_back(m_all.normals[s]);
    samples.facets.push_back(f);
  }

  void add_features(const Sample_places& sample_places)
  {
    std::vector<std::pair<int, Edge_place>> found; // sample, where it lies here
    for (int h = 0; h < static_cast<int>(3 * m_facets.size()); ++h)
      if (surface.adjacency.opposite[h] < h)
        sample_places.for_each_on_edge(whole_edge(h), [&](int s) {
          const Edge_place& p = sample_places.place(s);
          const int a = halfedge_source(surface.triangles, h),
                    b = halfedge_target(surface.triangles, h);
          found.push_back(
              {s, m_vertices[a] == p.from ? Edge_place{a, b, p.at} : Edge_place{b, a, p.at}});
        });
    for (int v = 0; v < static_cast<int>(m_vertices.size()); ++v)
      sample_places.for_each_on_edge({m_vertices[v], m_vertices[v]}, [&](int s) {
        found.push_back({s, {v, v, 0}});
      });
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
      return std::tie(a.first, a.second.from) < std::tie(b.first, b.second.from);
    });
    m_is_taken.assign(m_vertices.size(), 0);
    for (const auto& [s, place] : found) {
      if (!places.empty() && names.back() == s) continue; // at the first copy of a vertex
      add_sample(s, 0);
      places.push_back(place);
      if (place.from == place.to) m_is_taken[place.from] = 1;
    }
  }

  void add_border()
  {
    for (int h = 0; h < static_cast<int>(3 * m_facets.size()); ++h) {
      if (surface.adjacency.opposite[h] != Facet_adjacency::none ||
          m_whole.adjacency.opposite[3 * m_facets[h / 3] + h % 3] == Facet_adjacency::none)
        continue;
      for (const int v : edge(h)) {
        if (m_is_taken[v]) continue;
        m_is_taken[v] = 1;
        names.push_back(-1);
        samples.points.push_back(surface.points[v]);
        samples.normals.push_back(surface.vertex_normals[v]);
        samples.facets.push_back(0);
        places.push_back({v, v, 0});
      }
    }
  }

  int whole_vertex(int h) const { return m_whole.triangles[m_facets[h / 3]][h % 3]; }
  Edge whole_edge(int h) const
  {
    return sorted_edge(whole_vertex(h), whole_vertex(next_halfedge(h)));
  }
  Edge edge(int h) const
  {
    return sorted_edge(halfedge_source(surface.triangles, h),
                       halfedge_target(surface.triangles, h));
  }

  const Surface& m_whole;
  const Samples& m_all;
  const std::vector<int>& m_facets;
  std::vector<int> m_vertices;  // of the whole, by vertex
  std::vector<char> m_is_taken; // by vertex: by a sample on features
};

/// The facets that are nearer to `p`, a point of facet `seed`, than `radius`, as far as they hang
/// together with that one; sorted.
inline std::vector<int> facets_near(const Surface& surface, const Vec3d& p, int seed, double radius)
{
  std::vector<int> found{seed}, frontier{seed}, next;
  while (!frontier.empty()) {
    next.clear();
    for (const int f : frontier)
      for (int i = 0; i < 3; ++i) {
        const int o = surface.adjacency.opposite[3 * f + i];
        if (o == Facet_adjacency::none) continue;
        const Triangle& t = surface.triangles[o / 3];
        const Vec3d q = nearest_point_on_triangle(p, surface.points[t[0]], surface.points[t[1]],
                                                  surface.points[t[2]]);
        if (squared_length(q - p) < radius * radius) next.push_back(o / 3);
      }
    sort_uniquely(next);
    frontier.clear();
    std::set_difference(next.begin(), next.end(), found.begin(), found.end(),
                        std::back_inserter(frontier));
    const std::size_t middle = found.size();
    found.insert(found.end(), frontier.begin(), frontier.end());
    std::inplace_merge(found.begin(), found.begin() + middle, found.end());
  }
  return found;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_SURFACE_PIECE_H
