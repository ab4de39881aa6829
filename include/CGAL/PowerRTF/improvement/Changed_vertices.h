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

  /// Those that have changed, or their edges, since this was called last; in order.
  std::vector<int> take()
  {
    std::vector<int> changed = select(m_mesh->concurrency(), int(m_seen.size()), [&](int v) {
      return m_mesh->changes(Vertex(v)) != m_seen[v];
    });
    for_each_index(m_mesh->concurrency(), int(changed.size()),
                   [&](int k) { m_seen[changed[k]] = m_mesh->changes(Vertex(changed[k])); });
    return changed;
  }

  /// Whether so few have changed that it pays to look at these alone.
  bool are_few(const std::vector<int>& changed) const
  {
    constexpr std::size_t vertices_per_change = 32;
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
    if (mesh.is_isolated(v)) return;
    add(v);
    for (const auto h : halfedges_around_target(v, mesh)) add(mesh.source(h));
  });
}

/// The faces at the vertices that have edges; sorted.
template <class Vertices>
std::vector<Working_mesh::Face> faces_around(const Star_mesh& m, const Vertices& vertices)
{
  using Face = Working_mesh::Face;
  const auto& mesh = m.working().mesh;
  return gather_uniquely<Face>(m.concurrency(), int(vertices.size()), [&](int k, auto&& add) {
    const Star_mesh::Vertex v(vertices[k]);
    if (mesh.is_isolated(v)) return;
    for (const auto h : halfedges_around_target(v, mesh))
      if (!mesh.is_border(h)) add(mesh.face(h));
  });
}

/// The faces of which something holds that their corners and edges decide.
class Watched_faces {
public:
  using Face = Working_mesh::Face;

  explicit Watched_faces(const Star_mesh& mesh) : m_mesh(&mesh), m_changed(mesh) {}

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
    const std::vector<int> changed = m_changed.take();
    if (!m_changed.are_few(changed)) {
      m_faces = wanted(int(mesh.num_faces()), [](int f) { return Face(f); });
    } else if (!changed.empty()) {
      const std::vector<Face> near = faces_around(*m_mesh, changed);
      std::vector<Face> others, all;
      std::set_difference(m_faces.begin(), m_faces.end(), near.begin(), near.end(),
                          std::back_inserter(others));
      others.erase(
          std::remove_if(others.begin(), others.end(), [&](Face f) { return mesh.is_removed(f); }),
          others.end());
      const std::vector<Face> found = wanted(int(near.size()), [&](int k) { return near[k]; });
      std::merge(others.begin(), others.end(), found.begin(), found.end(), std::back_inserter(all));
      m_faces.swap(all);
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
