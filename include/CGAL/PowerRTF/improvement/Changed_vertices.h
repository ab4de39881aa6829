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

/// The vertices and those that are at most so many edges away; sorted. None that has no edge.
inline std::vector<Working_mesh::Vertex>
vertices_around(const Working_mesh& working, const std::vector<int>& vertices, int rings)
{
  std::vector<Working_mesh::Vertex> around;
  for (const int v : vertices)
    if (const Working_mesh::Vertex u(v); !working.mesh.is_isolated(u)) around.push_back(u);
  working.add_neighbors(around, rings);
  return around;
}

/// The faces at these; sorted.
inline std::vector<Working_mesh::Face> faces_around(const Working_mesh& working,
                                                    const std::vector<int>& vertices, int rings)
{
  const auto faces = working.faces_at(vertices_around(working, vertices, rings));
  return {faces.begin(), faces.end()};
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
    const Working_mesh& working = m_mesh->working();
    const auto is_wanted = [&](Face f) { return !working.mesh.is_removed(f) && holds(f); };
    const std::vector<int> changed = m_changed.take();
    if (!m_changed.are_few(changed)) {
      m_faces.clear();
      for (const int f : select(m_mesh->concurrency(), int(working.mesh.num_faces()),
                                [&](int f) { return is_wanted(Face(f)); }))
        m_faces.push_back(Face(f));
    } else if (!changed.empty()) {
      std::vector<Face> near = faces_around(working, changed, 0), others, all;
      std::set_difference(m_faces.begin(), m_faces.end(), near.begin(), near.end(),
                          std::back_inserter(others));
      const auto drop = [](std::vector<Face>& faces, const auto& is_dropped) {
        faces.erase(std::remove_if(faces.begin(), faces.end(), is_dropped), faces.end());
      };
      drop(near, [&](Face f) { return !is_wanted(f); });
      drop(others, [&](Face f) { return working.mesh.is_removed(f); });
      std::merge(others.begin(), others.end(), near.begin(), near.end(), std::back_inserter(all));
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
