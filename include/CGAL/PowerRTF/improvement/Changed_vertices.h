// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which vertices of a mesh have changed since one last looked, so that what depends on them is
// found anew only there.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_CHANGED_VERTICES_H
#define CGAL_POWER_RTF_IMPROVEMENT_CHANGED_VERTICES_H

#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Changed_vertices {
public:
  using Vertex = Star_mesh::Vertex;

  /// At first all vertices have changed.
  explicit Changed_vertices(const Star_mesh& mesh)
      : m_mesh(&mesh), m_seen(filled(mesh.concurrency(), mesh.size(), 0u))
  {}

  /// All count as changed.
  void add_all()
  {
    for_each_index(m_mesh->concurrency(), int(m_seen.size()), [&](int v) { m_seen[v] = 0; });
  }

  /// These count as changed, and no others.
  void assign(const std::vector<int>& vertices)
  {
    for_each_index(m_mesh->concurrency(), int(m_seen.size()),
                   [&](int v) { m_seen[v] = m_mesh->changes(Vertex(v)); });
    for (const int v : vertices) m_seen[v] = 0;
  }

  /// Those that have changed, or their edges, since they were taken last; in order.
  std::vector<int> find() const
  {
    return select(m_mesh->concurrency(), int(m_seen.size()),
                  [&](int v) { return m_mesh->changes(Vertex(v)) != m_seen[v]; });
  }
  /// The same, and takes them.
  std::vector<int> take()
  {
    std::vector<int> changed = find();
    for_each_index(m_mesh->concurrency(), int(changed.size()),
                   [&](int k) { m_seen[changed[k]] = m_mesh->changes(Vertex(changed[k])); });
    return changed;
  }

  /// Whether so few have changed, one in so many, that it pays to look at these alone.
  bool are_few(const std::vector<int>& changed, std::size_t vertices_per_change = 32) const
  {
    return changed.size() < m_seen.size() / vertices_per_change;
  }

private:
  const Star_mesh* m_mesh;
  Unset_vector<unsigned> m_seen; // by vertex: its changes
};

/// The vertices that have edges, and their neighbors; sorted.
template <class Vertices>
std::vector<Star_mesh::Vertex> vertices_around(const Star_mesh& m, const Vertices& vertices)
{
  using Vertex = Star_mesh::Vertex;
  const auto& mesh = m.working().mesh;
  return gather_uniquely<Vertex>(m.concurrency(), int(vertices.size()), [&](int k, auto&& add) {
    const Vertex v(vertices[k]);
    if (!m.working().has_edges(v)) return;
    add(v);
    for (const auto h : halfedges_around_target(v, mesh)) add(mesh.source(h));
  });
}

/// The faces at the vertices that have edges, of which `holds(face)`; sorted.
template <class Vertices, class Holds>
std::vector<Working_mesh::Face> faces_around(const Star_mesh& m, const Vertices& vertices,
                                             const Holds& holds)
{
  using Face = Working_mesh::Face;
  const auto& mesh = m.working().mesh;
  return gather_uniquely<Face>(m.concurrency(), int(vertices.size()), [&](int k, auto&& add) {
    const Star_mesh::Vertex v(vertices[k]);
    if (!m.working().has_edges(v)) return;
    for (const auto h : halfedges_around_target(v, mesh))
      if (!mesh.is_border(h) && holds(mesh.face(h))) add(mesh.face(h));
  });
}

/// All of them.
template <class Vertices>
std::vector<Working_mesh::Face> faces_around(const Star_mesh& m, const Vertices& vertices)
{
  return faces_around(m, vertices, [](Working_mesh::Face) { return true; });
}

/// The edges of the faces at the vertices that have edges, of which `holds(edge)`; sorted.
template <class Vertices, class Holds>
std::vector<Star_mesh::Edge> edges_around(const Star_mesh& m, const Vertices& vertices,
                                          const Holds& holds)
{
  using Edge = Star_mesh::Edge;
  const auto& mesh = m.working().mesh;
  return gather_uniquely<Edge>(m.concurrency(), int(vertices.size()), [&](int k, auto&& add) {
    const Star_mesh::Vertex v(vertices[k]);
    if (!m.working().has_edges(v)) return;
    for (const auto h : halfedges_around_target(v, mesh))
      for (const auto side : {h, mesh.prev(h)}) {
        const Edge e(mesh.edge(side).idx()); // whichever halfedge it was found by
        if (holds(e)) add(e);
      }
  });
}

/// The faces of which something holds that their corners and edges decide.
class Watched_faces {
public:
  using Face = Working_mesh::Face;

  explicit Watched_faces(const Star_mesh& mesh) : m_mesh(&mesh), m_changed(mesh) {}

  /// It holds at most of faces at these vertices.
  void assign(const std::vector<int>& vertices)
  {
    m_changed.assign(vertices);
    m_faces.clear();
  }

  /// Those of which `holds(face)`, sorted. \pre it is always the same question
  template <class Holds>
  const std::vector<Face>& find(const Holds& holds)
  {
    const auto& mesh = m_mesh->working().mesh;
    // Of those with these numbers, as `face` names them.
    const auto wanted = [&](int n, const auto& face) {
      std::vector<Face> faces;
      for (const int k : select(m_mesh->concurrency(), n,
                                [&](int k) { return !mesh.is_removed(face(k)) && holds(face(k)); }))
        faces.push_back(face(k));
      return faces;
    };
    constexpr std::size_t vertices_per_change = 6;
    const std::vector<int> changed = m_changed.take();
    if (!m_changed.are_few(changed, vertices_per_change)) {
      m_faces = wanted(int(mesh.num_faces()), [](int f) { return Face(f); });
    } else if (!changed.empty()) {
      const std::vector<Face> before =
                                  wanted(int(m_faces.size()), [&](int k) { return m_faces[k]; }),
                              near = faces_around(*m_mesh, changed, holds);
      m_faces.clear();
      std::set_union(before.begin(), before.end(), near.begin(), near.end(),
                     std::back_inserter(m_faces));
    }
    return m_faces;
  }

private:
  const Star_mesh* m_mesh;
  Changed_vertices m_changed;
  std::vector<Face> m_faces;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_CHANGED_VERTICES_H
