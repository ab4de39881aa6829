// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dislocations: where a row of the lattice of triangles ends there is an edge between a vertex with
// five edges and one with seven. A flip of an edge beside it moves it by one edge (it glides),
// until it meets another one: both are gone, or one is left of the two. Such a chain of flips is
// kept if, with the vertices around moved, it lowers the energy of the triangles. (Hirth and Lothe,
// "Theory of Dislocations", 1982, on glide and annihilation; the energy is that of smooth_mesh.h.)
#ifndef CGAL_POWER_RTF_IMPROVEMENT_ANNIHILATE_DISLOCATIONS_H
#define CGAL_POWER_RTF_IMPROVEMENT_ANNIHILATE_DISLOCATIONS_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/smooth_mesh.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Dislocation_annihilator {
public:
  explicit Dislocation_annihilator(Star_mesh& mesh) : m(mesh), m_smoother(mesh) {}

  /// The nearest pairs first. \returns the number of meetings.
  std::size_t run()
  {
    std::size_t meetings = 0;
    for (int length = 1; length <= Parameters::max_glide; ++length)
      for (const Vertex v : m.working().mesh.vertices()) {
        Cancellation::poll();
        if (excess(v) == -1) meetings += annihilate(v, length);
      }
    return meetings;
  }

private:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Edge = Star_mesh::Edge;
  using Face = Working_mesh::Face;
  using Parameters = Improvement_parameters::Dislocations;

  // At most `irregular_degree`.
  int degree(Vertex v) const { return m.working().degree_up_to(Parameters::irregular_degree, v); }

  // Edges above six; 0 where the mesh is not free, as on features and borders.
  int excess(Vertex v) const { return m.is_movable(v) ? degree(v) - 6 : 0; }

  // Of the corners of an edge's triangles: the sum of squares.
  int irregularity(Edge e) const
  {
    int sum = 0;
    for (const Vertex v : m.corners(e)) sum += excess(v) * excess(v);
    return sum;
  }

  // Makes a dislocation at `five` meet one that is `length` flips away.
  bool annihilate(Vertex five, int length)
  {
    const auto& mesh = m.working().mesh;
    std::vector<Vertex> sevens;
    for (const Halfedge h : halfedges_around_target(five, mesh))
      if (excess(mesh.source(h)) == 1) sevens.push_back(mesh.source(h));
    for (const Vertex seven : sevens)
      for (const bool to_left : {true, false}) {
        const std::vector<Edge> flips = find_meeting(five, seven, length, to_left);
        if (!flips.empty() && flip_if_better(flips)) return true;
      }
    return false;
  }

  // The `length` flips after which the dislocation meets another; empty: there is none.
  std::vector<Edge> find_meeting(Vertex five, Vertex seven, int length, bool to_left)
  {
    const auto& mesh = m.working().mesh;
    std::vector<Edge> flips;
    int change = 0;
    while (change == 0 && int(flips.size()) < length) {
      const Halfedge h = mesh.halfedge(five, seven), o = mesh.opposite(h);
      const Halfedge beside = to_left ? mesh.next(h) : mesh.opposite(mesh.prev(o)); // from seven
      const Edge e = mesh.edge(beside);
      if (!can_flip(e)) break;
      five = mesh.target(beside);
      seven = m.working().apex(to_left ? mesh.opposite(beside) : beside);
      const int before = irregularity(e);
      m.flip(e);
      flips.push_back(e);
      change = irregularity(e) - before;
    }
    const bool meets = change < 0 && int(flips.size()) == length;
    undo(flips);
    return meets ? flips : std::vector<Edge>();
  }

  bool can_flip(Edge e) const
  {
    if (!m.is_free(e) || !m.working().is_flippable(e)) return false;
    const auto corners = m.corners(e);
    return std::all_of(corners.begin(), corners.end(), [&](Vertex v) {
      return m.is_movable(v) && degree(v) > 4 && degree(v) < Parameters::irregular_degree;
    });
  }

  void undo(const std::vector<Edge>& flips)
  {
    for (auto e = flips.rbegin(); e != flips.rend(); ++e)
      for (int k = 0; k < 3; ++k) m.flip(*e); // four turns are a whole one
  }

  bool flip_if_better(const std::vector<Edge>& flips)
  {
    const std::vector<Vertex> near = vertices_near(flips);
    const auto faces = m.working().faces_at(near);
    std::vector<Surface_projector::Place> places;
    for (const Vertex v : near) places.push_back(m.place(v));
    const double before = energy(faces);
    for (const Edge e : flips) {
      m.flip(e);
      const std::vector<Vertex> around = vertices_near({e}, 1);
      for (int round = 0; round < Parameters::rounds_per_flip; ++round) m_smoother.sweep(around);
    }
    for (int round = 0; round < Parameters::rounds; ++round) m_smoother.sweep(near);
    if (energy(faces) < clearly_less * before && lie_well(faces)) return true;
    undo(flips);
    for (std::size_t k = 0; k < near.size(); ++k) m.move(near[k], places[k]);
    return false;
  }

  // Those that are at most so many edges away from the corners of the edges' triangles; no way
  // leads through a vertex that is far from regular.
  std::vector<Vertex> vertices_near(const std::vector<Edge>& edges,
                                    int rings = Parameters::rings) const
  {
    std::vector<Vertex> near;
    for (const Edge e : edges)
      for (const Vertex v : m.corners(e)) near.push_back(v);
    for (int ring = 0; ring < rings; ++ring)
      m.working().add_neighbors(
          near, [this](Vertex v) { return degree(v) < Parameters::irregular_degree; });
    return near;
  }

  template <class Faces>
  double energy(const Faces& faces) const
  {
    double sum = 0;
    for (const Face f : faces) {
      const auto [a, b, c] = m.points(m.working().mesh.halfedge(f));
      sum += Mesh_smoother::energy(a, b, c);
    }
    return sum;
  }

  template <class Faces>
  bool lie_well(const Faces& faces) const
  {
    return std::all_of(faces.begin(), faces.end(), [&](Face f) {
      const auto [a, b, c] = m.working().corners(f);
      return m.agreement(a, b, c) > Parameters::min_agreement;
    });
  }

  Star_mesh& m;
  Mesh_smoother m_smoother;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_ANNIHILATE_DISLOCATIONS_H
