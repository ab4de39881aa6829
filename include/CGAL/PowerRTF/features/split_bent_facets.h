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

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

class Bent_facet_splitter {
public:
  /// \param spacing C of the spacing C / sqrt(rho)
  Bent_facet_splitter(Surface& surface, double spacing) : m(surface), m_spacing(spacing) {}

  /// Whether `run()` would find an edge.
  bool is_needed() const
  {
    for (int h = 0; h < 3 * int(m.triangles.size()); ++h)
      if (is_bent(h / 3) && is_long(h)) return true;
    return false;
  }

  /// Halves all long edges of bent facets. \param parents of the facets, if they have some
  /// \returns whether there were any
  bool run(std::vector<int>& parents)
  {
    const std::size_t halved = halve_edges();
    if (halved == 0) return false;
    std::vector<Triangle> triangles;
    std::vector<int> of_triangles, patches;
    triangles.reserve(m.triangles.size() + 2 * halved);
    for (std::size_t f = 0; f < m.triangles.size(); ++f) {
      split(m.triangles[f], {m_middles[3 * f], m_middles[3 * f + 1], m_middles[3 * f + 2]},
            triangles);
      of_triangles.resize(triangles.size(), parents.empty() ? int(f) : parents[f]);
      if (!m.facet_patches.empty()) patches.resize(triangles.size(), m.facet_patches[f]);
    }
    m.triangles.swap(triangles);
    m.facet_patches.swap(patches);
    m.adjacency = facet_adjacency(m.triangles, m.points.size());
    compute_geometry(m);
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

  std::size_t halve_edges()
  {
    const std::vector<int>& opposite = m.adjacency.opposite;
    m_middles.assign(opposite.size(), -1);
    std::size_t halved = 0;
    for (int h = 0; h < int(opposite.size()); ++h) {
      const int o = opposite[h];
      if (m_middles[h] >= 0 || !is_bent(h / 3) || !is_long(h)) continue;
      const int a = halfedge_source(m.triangles, h), b = halfedge_target(m.triangles, h);
      m_middles[h] = int(m.points.size());
      if (o != Facet_adjacency::none) m_middles[o] = m_middles[h];
      m.points.push_back((m.points[a] + m.points[b]) * 0.5);
      m.vertex_density.push_back((m.vertex_density[a] + m.vertex_density[b]) / 2);
      m.input_vertices.push_back(m.input_vertices[a]);
      ++halved;
    }
    return halved;
  }

  /// Cuts `t` at the middles of its edges (-1: not halved).
  void split(Triangle t, std::array<int, 3> middles, std::vector<Triangle>& pieces) const
  {
    const auto count = 3 - std::count(middles.begin(), middles.end(), -1);
    const auto turn = [&] {
      std::rotate(t.begin(), t.begin() + 1, t.end());
      std::rotate(middles.begin(), middles.begin() + 1, middles.end());
    };
    if (count == 0) {
      pieces.push_back(t);
    } else if (count == 1) {
      while (middles[0] < 0) turn();
      pieces.insert(pieces.end(), {{t[0], middles[0], t[2]}, {middles[0], t[1], t[2]}});
    } else if (count == 2) { // the quadrangle t0, t1, m1, m2 by its shorter diagonal
      while (middles[0] >= 0) turn();
      const auto [m0, m1, m2] = middles;
      pieces.push_back({m1, t[2], m2});
      if (squared_length(m.points[t[0]] - m.points[m1]) <
          squared_length(m.points[t[1]] - m.points[m2]))
        pieces.insert(pieces.end(), {{t[0], t[1], m1}, {t[0], m1, m2}});
      else
        pieces.insert(pieces.end(), {{t[0], t[1], m2}, {t[1], m1, m2}});
    } else {
      const auto [m0, m1, m2] = middles;
      pieces.insert(pieces.end(), {{t[0], m0, m2}, {m0, t[1], m1}, {m2, m1, t[2]}, {m0, m1, m2}});
    }
  }

  Surface& m;
  double m_spacing;
  std::vector<int> m_middles; // by halfedge: the vertex that halves it, or -1
};

} // namespace internal

/// Whether `split_bent_facets()` would split one.
inline bool has_long_bent_facets(Surface& surface, std::size_t n)
{
  return internal::Bent_facet_splitter(surface, spacing_constant(surface, n)).is_needed();
}

/// Splits the facets of `surface` until none that has an edge longer than three times the local
/// spacing of `n` samples has a corner whose normal is 30 degrees or more away from its own (but
/// makes no more than 16 n + 4 #F facets). The surface stays where it is; its first vertices are
/// the old ones. It must have no creases. Normals and areas are computed anew. \returns for each
/// facet the one that it is a part of; empty: nothing was split
inline std::vector<int> split_bent_facets(Surface& surface, std::size_t n)
{
  const std::size_t most = 16 * n + 4 * surface.triangles.size();
  std::vector<int> parents;
  internal::Bent_facet_splitter splitter(surface, spacing_constant(surface, n));
  while (surface.triangles.size() < most / 4 && splitter.run(parents)) {
  }
  return parents;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_SPLIT_BENT_FACETS_H
