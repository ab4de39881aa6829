// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which faces of a mesh intersect others, decided by exact predicates: all of them, or those that
// have changed.
#ifndef CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H
#define CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H

#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/geometry/intersecting_pairs.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A mesh's faces for `Intersecting_pairs`.
class Face_triangles {
public:
  using Mesh = Working_mesh::Mesh;
  using Face = Working_mesh::Face;
  using Corners = Working_mesh::Corners;

  explicit Face_triangles(const Mesh& mesh) : m_mesh(mesh) {}

  Corners corners(Face f) const
  {
    const auto h = m_mesh.halfedge(f);
    return {m_mesh.source(h), m_mesh.target(h), m_mesh.target(m_mesh.next(h))};
  }
  Triangle_points points(const Corners& t) const
  {
    return {m_mesh.point(t[0]), m_mesh.point(t[1]), m_mesh.point(t[2])};
  }

private:
  const Mesh& m_mesh;
};

/// Two faces that intersect; see there.
using Face_pair = Intersecting_pairs<Face_triangles>::Pair;

/// Finds the pairs of a mesh.
class Intersection_finder : public Intersecting_pairs<Face_triangles> {
public:
  using Mesh = Face_triangles::Mesh;

  explicit Intersection_finder(const Mesh& mesh, Concurrency concurrency = Sequential_tag())
      : Intersecting_pairs(Face_triangles(mesh), concurrency), m_mesh(mesh)
  {}

  /// All of them, sorted.
  std::vector<Face_pair> all() const { return find(m_mesh.faces()); }

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
        find_where(m_mesh.faces(), [&](Face f) { return bool(has_changed[f]); });
    pairs.insert(pairs.end(), fresh.begin(), fresh.end());
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

private:
  const Mesh& m_mesh;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H
