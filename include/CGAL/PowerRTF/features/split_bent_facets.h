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
#include <CGAL/PowerRTF/geometry/halve_edges.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
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
    const std::vector<int> edges = long_edges();
    if (edges.empty()) return false;
    std::vector<int> of_pieces = halve_edges(m, edges, m_concurrency).parents;
    if (!parents.empty())
      for (int& f : of_pieces) f = parents[f];
    parents.swap(of_pieces);
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

  Surface& m;
  double m_spacing;
  Concurrency m_concurrency;
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
