// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Flips, collapses and splits of the edges of a mesh that can be undone: what the connectivity was
// around them is kept, which takes no copy of the whole mesh.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_UNDOABLE_EDITS_H
#define CGAL_POWER_RTF_IMPROVEMENT_UNDOABLE_EDITS_H

#include <CGAL/PowerRTF/extraction/Working_mesh.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Undoable_edits {
public:
  using Mesh = Working_mesh::Mesh;
  using Vertex = Working_mesh::Vertex;
  using Halfedge = Working_mesh::Halfedge;
  using Edge = Working_mesh::Edge;
  using Face = Working_mesh::Face;

  /// `are_noted`: whether they can be undone.
  explicit Undoable_edits(bool are_noted) : m_are_noted(are_noted) {}

  /// \pre the edge is not on the border, here and below
  void flip(Mesh& mesh, Edge e)
  {
    const Halfedge h = mesh.halfedge(e);
    if (m_are_noted) begin(mesh, faces_at(mesh, h));
    Euler::flip_edge(h, mesh);
  }

  /// \pre the link condition holds, and neither end is on the border
  /// \returns the end that stays.
  Vertex collapse(Working_mesh& m, Halfedge h)
  {
    if (m_are_noted) {
      begin(m.mesh, m.faces_at(std::array<Vertex, 2>{m.mesh.source(h), m.mesh.target(h)}));
      m_edits.back().is_collapse = true;
    }
    return Euler::collapse_edge(m.mesh.edge(h), m.mesh);
  }

  /// Splits an edge and its two triangles. \returns the new vertex.
  Vertex split(Mesh& mesh, Halfedge h)
  {
    if (m_are_noted) begin(mesh, faces_at(mesh, h));
    const Halfedge o = mesh.opposite(h), first = Euler::split_edge(h, mesh);
    const Halfedge left = Euler::split_face(first, mesh.next(h), mesh);
    const Halfedge right = Euler::split_face(o, mesh.next(mesh.opposite(first)), mesh);
    if (m_are_noted) {
      m_edits.back().new_vertex = mesh.target(first);
      m_edits.back().new_edges = {mesh.edge(first), mesh.edge(left), mesh.edge(right)};
      m_edits.back().new_faces = {mesh.face(mesh.opposite(left)), mesh.face(mesh.opposite(right))};
    }
    return mesh.target(first);
  }

  /// Undoes all edits.
  void undo(Mesh& mesh)
  {
    for (; !m_edits.empty(); m_edits.pop_back()) {
      recycle(mesh, m_edits.back());
      for (const Corner& c : m_edits.back().corners) {
        mesh.set_next(c.halfedge, c.next);
        mesh.set_target(c.halfedge, c.target);
        mesh.set_face(c.halfedge, c.face);
        mesh.set_halfedge(c.target, c.of_target);
        mesh.set_halfedge(c.face, c.of_face);
      }
    }
  }

  /// Those of `later` come after these.
  void append(Undoable_edits&& later)
  {
    std::move(later.m_edits.begin(), later.m_edits.end(), std::back_inserter(m_edits));
  }

private:
  // Of a face.
  struct Corner {
    Halfedge halfedge, next, of_target, of_face;
    Vertex target;
    Face face;
  };
  struct Edit {
    std::vector<Corner> corners; // before it
    bool is_collapse = false;
    Vertex new_vertex; // of a split, as what follows; in the order in which they have come
    std::array<Edge, 3> new_edges;
    std::array<Face, 2> new_faces;
  };

  static std::array<Face, 2> faces_at(const Mesh& mesh, Halfedge h)
  {
    return {mesh.face(h), mesh.face(mesh.opposite(h))};
  }

  // `faces`: those that change.
  template <class Faces>
  void begin(const Mesh& mesh, const Faces& faces)
  {
    Edit edit;
    for (const Face f : faces)
      for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
        edit.corners.push_back(
            {h, mesh.next(h), mesh.halfedge(mesh.target(h)), mesh.halfedge(f), mesh.target(h), f});
    m_edits.push_back(std::move(edit));
  }

  // The mesh gives the numbers of what was taken out last to what is added first.
  static void recycle(Mesh& mesh, const Edit& edit)
  {
    if (edit.is_collapse) {
      mesh.add_vertex();
      for (int k = 0; k < 3; ++k) mesh.add_edge();
      for (int k = 0; k < 2; ++k) mesh.add_face();
    }
    if (edit.new_vertex.is_valid()) {
      for (int k = 2; k-- > 0;) mesh.remove_face(edit.new_faces[k]);
      for (int k = 3; k-- > 0;) mesh.remove_edge(edit.new_edges[k]);
      mesh.remove_vertex(edit.new_vertex);
    }
  }

  bool m_are_noted;
  std::vector<Edit> m_edits;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_UNDOABLE_EDITS_H
