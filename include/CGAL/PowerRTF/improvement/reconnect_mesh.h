// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Another connectivity where triangles are not round, for a mesh with creases: between these the
// rows of the lattice have no room, and its dislocations are not healed by moves. An edge is
// flipped, or a vertex taken out at one place (edge collapse) and then put in at another (edge
// split), and the vertices around move, before it is judged whether the sum of unroundness (see
// round_mesh.h) has fallen. Only edges are tried whose corners have too many or too few triangles
// (edge_excess.h), and a try ends as soon as it is hopeless.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_RECONNECT_MESH_H
#define CGAL_POWER_RTF_IMPROVEMENT_RECONNECT_MESH_H

#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/edge_excess.h>
#include <CGAL/PowerRTF/improvement/round_mesh.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Mesh_reconnector {
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Edge = Star_mesh::Edge;
  using Face = Working_mesh::Face;
  using State = Star_mesh::State;

  /// `most`: unroundness that flips and splits may bring upon a triangle.
  Mesh_reconnector(Star_mesh& mesh, Mesh_rounder& rounder, double most)
      : m(mesh), m_rounder(rounder), m_most(most), m_failed(mesh.working().mesh.num_edges(), 0)
  {}

  void run(int passes)
  {
    for (int pass = 0; pass < passes; ++pass) {
      for (const int f : select(m.concurrency(), int(m.working().mesh.num_faces()),
                                [this](int f) { return is_wanted(Face(f)); }))
        for (int k = 0; k < 3 && is_wanted(Face(f)); ++k) reconnect(side(Face(f), k));
      if (m_complete) m_complete->restore();
      m_complete.reset();
    }
  }

private:
  using Parameters = Improvement_parameters::Reconnection;
  using Limits = std::array<double, 3>;

  bool is_wanted(Face f) const
  {
    return !m.working().mesh.is_removed(f) && m_rounder.unroundness(f) > Parameters::round;
  }

  Edge side(Face f, int k) const
  {
    const auto& mesh = m.working().mesh;
    const Halfedge h = mesh.halfedge(f);
    return mesh.edge(k == 0 ? h : k == 1 ? mesh.next(h) : mesh.prev(h));
  }

  void reconnect(Edge e)
  {
    Cancellation::poll();
    if (!m.is_free(e)) return;
    const std::array<Vertex, 4> corners = m.corners(e);
    if (has_hub(corners)) return;
    State state = m_complete.has_value();
    for (const Vertex v : corners) state += m.state_around(v);
    if (state == m_failed[e]) return;
    const double excess = edge_excess(m, e);
    const Halfedge h = m.working().mesh.halfedge(e, 0), o = m.working().mesh.halfedge(e, 1);
    if (excess > Parameters::min_flip_excess && flip(e)) return;
    if (m_complete) {
      if (excess > Parameters::min_split_excess && split(h)) return m_complete.reset();
    } else if (excess < Parameters::max_collapse_excess) {
      for (const Halfedge g : {h, o}) {
        m_complete.emplace(m);
        if (collapse(g)) return;
        m_complete.reset();
      }
    }
    m_failed[e] = state;
  }

  template <class Vertices>
  bool has_hub(const Vertices& vertices) const
  {
    return std::any_of(vertices.begin(), vertices.end(), [this](Vertex v) { return m.is_hub(v); });
  }

  bool flip(Edge e)
  {
    return m.working().is_flippable(e) &&
           is_better(e, 0, m_most, Parameters::hopeless, [&](auto&, auto&) { m.flip(e); });
  }

  bool split(Halfedge h)
  {
    const auto [a, b, c, d] = m.corners(m.working().mesh.edge(h));
    const auto distance = [this](Vertex u, Vertex v) { return length(m.point(u) - m.point(v)); };
    const double mean = (distance(a, c) + distance(c, b) + distance(b, d) + distance(d, a)) / 4;
    if (distance(a, b) < Parameters::min_split_length * mean) return false;
    const auto place = m.projector().nearest(0.5 * (m.point(a) + m.point(b)));
    return is_better(m.working().mesh.edge(h), Parameters::vertex_worth, m_most,
                     Parameters::hopeless_split, [&](auto& corners, auto& around) {
                       const Vertex v = m.split(h, place);
                       for (auto vertices : {&corners, &around}) vertices->push_back(v);
                     });
  }

  // Of its ends, the target of `h` stays. What is bad then may lack the vertex: it is not mended.
  bool collapse(Halfedge h)
  {
    const auto& mesh = m.working().mesh;
    const Vertex v = mesh.source(h), u = mesh.target(h);
    if (!m.is_movable(v) || !m.is_movable(u)) return false;
    for (const Halfedge g : halfedges_around_target(v, mesh))
      if (m.is_locked(mesh.source(g))) return false;
    if (!Euler::does_satisfy_link_condition(mesh.edge(h), mesh)) return false;
    return is_better(mesh.edge(h), -Parameters::vertex_worth, Parameters::bad, Parameters::hopeless,
                     [&](auto& corners, auto& around) {
                       const Vertex gone = m.collapse(h) == u ? v : u;
                       for (auto vertices : {&corners, &around})
                         vertices->erase(std::find(vertices->begin(), vertices->end(), gone));
                     });
  }

  // Makes a change, which tells the corners of the edge and the vertices around what they are
  // after it, and undoes it if it does not lower the sum of unroundness by more than `least_gain`.
  template <class Change>
  bool is_better(Edge e, double least_gain, double most, const Limits& hopeless,
                 const Change& change)
  {
    const std::array<Vertex, 4> ends = m.corners(e);
    std::vector<Vertex> corners(ends.begin(), ends.end()), around = corners;
    m.working().add_neighbors(around);
    if (has_hub(around)) return false;
    const Mesh_rounder::Patch was = m_rounder.patch(around);
    const auto were = m_rounder.triangles(around);
    Star_mesh::Checkpoint before(m);
    change(corners, around);
    const double enough = was.sum - least_gain;
    const auto agrees = [&] {
      const double agreement = m_rounder.agreement(m_rounder.triangles(around));
      return agreement >= Parameters::min_agreement || agreement >= m_rounder.agreement(were);
    };
    Mesh_rounder::Patch now;
    for (int pass = 0; pass <= Parameters::passes; ++pass) {
      m_rounder.move(pass == 0 ? corners : around, Parameters::first_step / std::max(1, pass));
      if (pass > 0) m_rounder.flip_at(corners);
      const double hope = pass < int(hopeless.size()) ? enough + hopeless[pass]
                                                      : std::numeric_limits<double>::infinity();
      now = m_rounder.patch(around, hope);
      if (now.sum > hope) break;
    }
    if (now.sum < clearly_less * enough && now.most <= std::max(most, was.most) && agrees())
      return true;
    before.rewind();
    return false;
  }

  Star_mesh& m;
  Mesh_rounder& m_rounder;
  double m_most;
  std::vector<State> m_failed;                     // by edge: the sum of the corners' states
  std::optional<Star_mesh::Checkpoint> m_complete; // where a vertex is missing: before
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_RECONNECT_MESH_H
