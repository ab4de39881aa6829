// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which faces of a mesh intersect others, decided by exact predicates: all of them, or those that
// have changed.
#ifndef CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H
#define CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H

#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/intersecting_pairs.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A mesh's faces for `Intersecting_pairs`.
class Face_triangles {
public:
  using Face = Working_mesh::Face;
  using Vertex = Working_mesh::Vertex;
  using Corners = Working_mesh::Corners;

  explicit Face_triangles(const Working_mesh& mesh) : m(mesh) {}

  Corners corners(Face f) const { return m.corners(f); }
  Triangle_points points(const Corners& t) const
  {
    return {m.mesh.point(t[0]), m.mesh.point(t[1]), m.mesh.point(t[2])};
  }

  /// The places that a change will join by an edge of a seam, so that it counts as one.
  void set_coming_seam(const Edge& places) { m_coming_seam = places; }

  /// Of triangles with area, with their points. In an opened surface, vertices at the same place
  /// count as one; sheets that get an edge in common off their seams count as intersecting.
  bool intersect(const Corners& s, const Triangle_points& p, const Corners& t,
                 const Triangle_points& q) const
  {
    if (m.places.empty()) return triangles_intersect(s, p, t, q);
    return triangles_intersect(places(s), p, places(t), q) || meet_off_seams(s, t);
  }

private:
  int place(Vertex v) const { return m.is_on_seam(v) ? m.places[v] : -1 - static_cast<int>(v); }
  std::array<int, 3> places(const Corners& t) const
  {
    return {place(t[0]), place(t[1]), place(t[2])};
  }

  bool meet_off_seams(const Corners& s, const Corners& t) const
  {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const Vertex a = s[i], b = s[(i + 1) % 3], c = t[j], d = t[(j + 1) % 3];
        if (std::minmax(a, b) == std::minmax(c, d)) continue; // it is one edge
        if (std::minmax(place(a), place(b)) == std::minmax(place(c), place(d)))
          return !(is_border(a, b) && is_border(c, d));
      }
    return false;
  }

  bool is_border(Vertex a, Vertex b) const
  {
    if (sorted_edge(place(a), place(b)) == m_coming_seam) return true;
    const auto h = m.mesh.halfedge(a, b);
    return h.is_valid() && m.mesh.is_border(m.mesh.edge(h));
  }

  const Working_mesh& m;
  Edge m_coming_seam{-1, -1};
};

/// Two faces that intersect; see there.
using Face_pair = Intersecting_pairs<Face_triangles>::Pair;

/// Finds the pairs of a mesh.
class Intersection_finder : public Intersecting_pairs<Face_triangles> {
public:
  using Mesh = Working_mesh::Mesh;

  explicit Intersection_finder(const Working_mesh& mesh, Concurrency concurrency = Sequential_tag())
      : Intersecting_pairs(Face_triangles(mesh), concurrency), m_mesh(mesh)
  {}

  /// All of them, sorted.
  std::vector<Face_pair> all() const { return find(m_mesh.mesh.faces()); }

  /// The same, where an engine has the faces, in the order of `triangles`.
  std::vector<Face_pair> all(const std::vector<Triangle>& triangles, Resident_mesh& there) const
  {
    Face_pairs close;
    if (!there.find_close_faces(close)) return all();
    std::vector<Face_pair> pairs;
    pairs.reserve(close.size());
    for (const auto& [t, u] : close) pairs.emplace_back(face(triangles[t]), face(triangles[u]));
    return find_among(pairs);
  }

  /// Those of `pairs`, all that there were before the faces with `has_changed[f]` changed, as they
  /// are now, sorted.
  std::vector<Face_pair> updated(std::vector<Face_pair> pairs,
                                 const std::vector<char>& has_changed) const
  {
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [&](const Face_pair& p) {
                                 return has_changed[p.first] || has_changed[p.second];
                               }),
                pairs.end());
    const std::vector<Face_pair> fresh =
        find_where(m_mesh.mesh.faces(), [&](Face f) { return bool(has_changed[f]); });
    pairs.insert(pairs.end(), fresh.begin(), fresh.end());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

private:
  Face face(const Triangle& t) const
  {
    return m_mesh.mesh.face(
        m_mesh.mesh.halfedge(Working_mesh::Vertex(t[0]), Working_mesh::Vertex(t[1])));
  }

  const Working_mesh& m_mesh;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H
