// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which faces of a mesh intersect others, decided by exact predicates: all of them, or those that
// have changed.
#ifndef CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H
#define CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H

#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/geometry/Find_close_faces.h>
#include <CGAL/PowerRTF/geometry/intersecting_pairs.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>

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

  /// All of them, sorted. `close_faces`: what finds most of the others instead, where it does.
  std::vector<Face_pair> all(const Find_close_faces& close_faces = {}) const
  {
    Face_pairs close;
    return close_faces && find_close(close_faces, close) ? find_among(close)
                                                         : find(m_mesh.mesh.faces());
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
  bool find_close(const Find_close_faces& close_faces, Face_pairs& pairs) const
  {
    const std::vector<int> faces =
        select(concurrency(), int(m_mesh.mesh.num_faces()),
               [this](int f) { return !m_mesh.mesh.is_removed(Working_mesh::Face(f)); });
    Unset_vector<Vec3d> points(m_mesh.mesh.num_vertices());
    for_each_index(concurrency(), int(points.size()),
                   [&](int v) { points[v] = m_mesh.point(Working_mesh::Vertex(v)); });
    Unset_vector<int> corners(3 * faces.size());
    for_each_index(concurrency(), int(faces.size()), [&](int k) {
      const auto at = m_mesh.corners(Working_mesh::Face(faces[k]));
      std::copy(at.begin(), at.end(), &corners[3 * k]);
    });
    if (!close_faces(int(points.size()), points.data(), int(faces.size()), corners.data(), pairs))
      return false;
    for (auto& [f, g] : pairs) f = faces[f], g = faces[g];
    return true;
  }

  const Working_mesh& m_mesh;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H
