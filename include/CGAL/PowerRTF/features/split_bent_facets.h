// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Facets with a vertex whose normal is far from their own are split where they are long against the
// spacing of the samples, so that such a normal acts over a few samples only: the one at the tip of
// a cone whose side is one row of long facets would tilt the tangent planes all the way down.
#ifndef CGAL_POWER_RTF_FEATURES_SPLIT_BENT_FACETS_H
#define CGAL_POWER_RTF_FEATURES_SPLIT_BENT_FACETS_H

#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/surface_geometry.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

class Bent_facet_splitter {
public:
  /// \param spacing C of the spacing C / sqrt(rho)
  Bent_facet_splitter(Surface& surface, double spacing, Concurrency concurrency)
      : m(surface), m_spacing(spacing), m_concurrency(concurrency)
  {}

  /// Whether `run()` would find an edge.
  bool is_needed() const { return !long_edges().empty(); }

  /// Halves all long edges of bent facets. \param parents of the facets, if they have some
  /// \returns whether there were any
  bool run(std::vector<int>& parents)
  {
    if (!halve_edges()) return false;
    const int facets = int(m.triangles.size());
    std::vector<int> first(facets + 1, 0); // of a facet's pieces
    for_each_index(m_concurrency, facets, [&](int f) {
      const auto middles = middles_of(f);
      first[f] = int(4 - std::count(middles.begin(), middles.end(), -1));
    });
    exclusive_scan(m_concurrency, facets + 1, first.data());
    std::vector<Triangle> triangles(first.back());
    std::vector<int> of_triangles(first.back());
    std::vector<int> patches(m.facet_patches.empty() ? 0 : first.back());
    for_each_index(m_concurrency, facets, [&](int f) {
      split(m.triangles[f], middles_of(f), &triangles[first[f]]);
      for (int k = first[f]; k < first[f + 1]; ++k) {
        of_triangles[k] = parents.empty() ? f : parents[f];
        if (!patches.empty()) patches[k] = m.facet_patches[f];
      }
    });
    m.triangles.swap(triangles);
    m.facet_patches.swap(patches);
    m.adjacency = facet_adjacency(m.triangles, m.points.size(), m_concurrency);
    compute_geometry(m, m_concurrency);
    parents.swap(of_triangles);
    return true;
  }

private:
  bool is_bent(int f) const
  {
    constexpr double largest_turn = 0.87; // cosine of 30 degrees
    for (const int v : m.triangles[f])
      if (dot(m.vertex_normals[v], m.facet_normals[f]) < largest_turn) return true;
    return false;
  }

  bool is_long(int h) const
  {
    constexpr double longest = 3; // in units of the spacing
    const int a = halfedge_source(m.triangles, h), b = halfedge_target(m.triangles, h);
    const double rho = (std::max)(m.vertex_density[a], m.vertex_density[b]);
    return squared_length(m.points[a] - m.points[b]) * rho >
           longest * longest * m_spacing * m_spacing;
  }

  /// A halfedge of each long edge of a bent facet.
  std::vector<int> long_edges() const
  {
    const std::vector<int>& opposite = m.adjacency.opposite;
    return select(m_concurrency, int(opposite.size()), [&](int h) {
      const int o = opposite[h];
      const bool is_first = o == Facet_adjacency::none || h < o;
      return is_first && is_long(h) &&
             (is_bent(h / 3) || (o != Facet_adjacency::none && is_bent(o / 3)));
    });
  }

  /// \returns whether there was one
  bool halve_edges()
  {
    const std::vector<int>& opposite = m.adjacency.opposite;
    const std::vector<int> edges = long_edges();
    const std::size_t old = m.points.size();
    if (edges.empty()) return false;
    m_middles.assign(opposite.size(), -1);
    m.points.resize(old + edges.size());
    m.vertex_density.resize(m.points.size());
    m.input_vertices.resize(m.points.size());
    for_each_index(m_concurrency, int(edges.size()), [&](int k) {
      const int h = edges[k], o = opposite[h], middle = int(old) + k;
      const int a = halfedge_source(m.triangles, h), b = halfedge_target(m.triangles, h);
      m_middles[h] = middle;
      if (o != Facet_adjacency::none) m_middles[o] = middle;
      m.points[middle] = (m.points[a] + m.points[b]) * 0.5;
      m.vertex_density[middle] = (m.vertex_density[a] + m.vertex_density[b]) / 2;
      m.input_vertices[middle] = m.input_vertices[a];
    });
    return true;
  }

  std::array<int, 3> middles_of(int f) const
  {
    return {m_middles[3 * f], m_middles[3 * f + 1], m_middles[3 * f + 2]};
  }

  /// Cuts `t` at the middles of its edges (-1: not halved), into one piece more than there are
  /// middles.
  void split(Triangle t, std::array<int, 3> middles, Triangle* pieces) const
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
      if (squared_length(m.points[t[0]] - m.points[m1]) <
          squared_length(m.points[t[1]] - m.points[m2]))
        put({{t[0], t[1], m1}, {t[0], m1, m2}});
      else
        put({{t[0], t[1], m2}, {t[1], m1, m2}});
    } else {
      const auto [m0, m1, m2] = middles;
      put({{t[0], m0, m2}, {m0, t[1], m1}, {m2, m1, t[2]}, {m0, m1, m2}});
    }
  }

  Surface& m;
  double m_spacing;
  Concurrency m_concurrency;
  std::vector<int> m_middles; // by halfedge: the vertex that halves it, or -1
};

} // namespace internal

/// Whether `split_bent_facets()` would split one.
inline bool has_long_bent_facets(Surface& surface, std::size_t n,
                                 internal::Concurrency concurrency = Sequential_tag())
{
  return internal::Bent_facet_splitter(surface, spacing_constant(surface, n, concurrency),
                                       concurrency)
      .is_needed();
}

/// Splits the facets of `surface` until none that has an edge longer than three times the local
/// spacing of `n` samples has a corner whose normal is 30 degrees or more away from its own (but
/// makes no more than 16 n + 4 #F facets). The surface stays where it is; its first vertices are
/// the old ones. It must have no creases. Normals and areas are computed anew. \returns for each
/// facet the one that it is a part of; empty: nothing was split
inline std::vector<int> split_bent_facets(Surface& surface, std::size_t n,
                                          internal::Concurrency concurrency = Sequential_tag())
{
  const std::size_t most = 16 * n + 4 * surface.triangles.size();
  std::vector<int> parents;
  internal::Bent_facet_splitter splitter(surface, spacing_constant(surface, n, concurrency),
                                         concurrency);
  while (surface.triangles.size() < most / 4 && splitter.run(parents)) {
  }
  return parents;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_SPLIT_BENT_FACETS_H
