// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_VERTEX_FAN_H
#define CGAL_POWER_RTF_GEOMETRY_VERTEX_FAN_H

#include <CGAL/PowerRTF/geometry/halfedge_numbers.h>
#include <CGAL/PowerRTF/internal/host_device.h>

namespace CGAL::PowerRTF::internal {

/// The facets around a vertex, by their edges that leave it.
class Vertex_fan {
public:
  static constexpr int most_facets = 64; ///< more are left to others

  /// `vertices`: three of each triangle. `corners`: all `n` > 0 at `v`.
  CGAL_POWER_RTF_HD Vertex_fan(const int* vertices, int v, const int* corners, int n) : m_size(n)
  {
    if (n > most_facets) return;
    int before[most_facets]; // the vertices where edges come from
    for (int k = 0; k < n; ++k) {
      m_next[k] = vertices[next_halfedge(corners[k])];
      before[k] = vertices[previous_halfedge(corners[k])];
      if (m_next[k] == v) return; // a collapsed facet
    }
    m_is_single = is_chain(before);
  }

  /// Whether the facets make one disk or, at a border, one fan, and agree in their orientations.
  CGAL_POWER_RTF_HD bool is_single() const { return m_is_single; }
  /// The vertex to which the edge number k leads.
  CGAL_POWER_RTF_HD int next(int k) const { return m_next[k]; }
  /// The facet that follows number k, whose edge is the other side of the one that comes from
  /// number k, or -1.
  CGAL_POWER_RTF_HD int after(int k) const { return m_after[k]; }
  /// The edge that is on the border, or -1.
  CGAL_POWER_RTF_HD int border() const { return m_border; }

private:
  CGAL_POWER_RTF_HD bool is_chain(const int* before)
  {
    bool has_before[most_facets];
    int links = 0;
    for (int k = 0; k < m_size; ++k) {
      m_after[k] = -1;
      has_before[k] = false;
    }
    for (int k = 0; k < m_size; ++k)
      for (int l = 0; l < m_size; ++l) {
        if (m_next[l] != before[k]) continue;
        if (m_after[k] >= 0 || has_before[l]) return false; // an edge is there twice
        m_after[k] = l;
        has_before[l] = true;
        ++links;
      }
    if (links < m_size - 1) return false;
    if (links < m_size)
      for (m_border = 0; has_before[m_border];) ++m_border;
    const int first = m_border < 0 ? 0 : m_border;
    int count = 1;
    for (int k = m_after[first]; k >= 0 && k != first; k = m_after[k]) ++count;
    return count == m_size;
  }

  int m_size, m_border = -1;
  bool m_is_single = false;
  int m_next[most_facets];
  int m_after[most_facets]; // of each facet the next one
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_VERTEX_FAN_H
