// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Before the sheets of a network are sewn together: edges inside two sheets with the same ends,
// which are samples on a seam, would become one edge where the sheets do not meet.
#ifndef CGAL_POWER_RTF_EXTRACTION_PART_CHORDS_H
#define CGAL_POWER_RTF_EXTRACTION_PART_CHORDS_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Chord_flipper {
public:
  /// \param name of each vertex once the sheets are sewn together
  Chord_flipper(Extracted_mesh& mesh, const std::vector<int>& name)
      : m_mesh(mesh), m_name(name),
        m_adjacency(facet_adjacency(mesh.triangles, mesh.points.size())),
        m_is_changed(mesh.triangles.size(), 0)
  {
    for (int h = 0; h < static_cast<int>(3 * mesh.triangles.size()); ++h)
      if (m_adjacency.opposite[h] < h) ++m_count[named_edge(h)];
    for (const Edge& e : mesh.feature_edges) m_count[named(e[0], e[1])] = on_seam;
  }

  /// Flips one of two such edges where that folds nothing. \returns whether there were any
  bool run()
  {
    bool found = false;
    for (int h = 0; h < static_cast<int>(m_adjacency.opposite.size()); ++h) {
      const int o = m_adjacency.opposite[h];
      if (o < h || m_is_changed[h / 3] || m_is_changed[o / 3] || is_feature(h)) continue;
      if (m_count[named_edge(h)] > 1) found = flip(h, o) || found;
    }
    return found;
  }

private:
  static constexpr int on_seam = 1 << 30; // more than any number of sheets

  int source(int h) const { return halfedge_source(m_mesh.triangles, h); }
  int target(int h) const { return halfedge_target(m_mesh.triangles, h); }
  Edge named(int a, int b) const { return sorted_edge(m_name[a], m_name[b]); }
  Edge named_edge(int h) const { return named(source(h), target(h)); }
  bool is_feature(int h) const
  {
    return std::binary_search(m_mesh.feature_edges.begin(), m_mesh.feature_edges.end(),
                              sorted_edge(source(h), target(h)));
  }
  Vec3d normal(const Triangle& t) const
  {
    const auto& p = m_mesh.points;
    return cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
  }

  bool flip(int h, int o)
  {
    const int a = source(h), b = target(h), c = opposite_vertex(m_mesh.triangles, h),
              d = opposite_vertex(m_mesh.triangles, o);
    if (m_name[c] == m_name[d] || m_count.count(named(c, d))) return false;
    Triangle &t = m_mesh.triangles[h / 3], &u = m_mesh.triangles[o / 3];
    const Triangle new_t{a, d, c}, new_u{d, b, c};
    const Vec3d n = normal(t) + normal(u);
    if (!(dot(normal(new_t), n) > 0 && dot(normal(new_u), n) > 0)) return false;
    --m_count[named_edge(h)];
    m_count[named(c, d)] = 1;
    m_is_changed[h / 3] = m_is_changed[o / 3] = 1;
    t = new_t;
    u = new_u;
    return true;
  }

  Extracted_mesh& m_mesh;
  const std::vector<int>& m_name;
  Facet_adjacency m_adjacency;
  std::vector<char> m_is_changed; // by triangle: its adjacency is no longer known
  std::map<Edge, int> m_count;    // how many edges of sheets become that edge
};

/// Flips edges inside sheets so that no two of them have the same ends once the sheets are sewn
/// together, as far as that can be.
/// \param name of each vertex then
inline void part_chords(Extracted_mesh& mesh, const std::vector<int>& name)
{
  constexpr int max_passes = 8;
  for (int pass = 0; pass < max_passes && Chord_flipper(mesh, name).run(); ++pass)
    ;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_PART_CHORDS_H
