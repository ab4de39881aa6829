// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dislocations: where a row of the lattice of triangles ends there is an edge between a vertex with
// five edges and one with seven. A flip of an edge beside it moves it by one edge (it glides),
// until it meets another one: both are gone, or one is left of the two. Such a chain of flips is
// kept if, with the vertices around moved, it lowers the energy of the triangles. (Hirth and Lothe,
// "Theory of Dislocations", 1982, on glide and annihilation; the energy is that of
// smooth_vertex.h.)
#ifndef CGAL_POWER_RTF_IMPROVEMENT_ANNIHILATE_DISLOCATIONS_H
#define CGAL_POWER_RTF_IMPROVEMENT_ANNIHILATE_DISLOCATIONS_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Dislocation_annihilator {
public:
  /// Finds the nearest meetings. Until they are run the mesh's edges have to stay; its vertices may
  /// move meanwhile.
  explicit Dislocation_annihilator(Star_mesh& mesh)
      : m(mesh), m_degrees(mesh.size()),
        m_is_known(filled(mesh.concurrency(), mesh.size(), char(false))),
        m_taken(filled(mesh.concurrency(), mesh.size(), 0u))
  {
    for_each_index(m.concurrency(), int(m.size()), [this](int v) {
      m_degrees[v] = m.working().has_edges(Vertex(v))
                         ? m.working().degree_up_to(Parameters::irregular_degree, Vertex(v))
                         : 0;
    });
    for (const int v :
         select(m.concurrency(), int(m.size()), [&](int v) { return excess(Vertex(v)) == -1; })) {
      m_is_known[v] = true;
      m_left.push_back({Vertex(v)});
    }
    update();
  }

  /// Where surroundings touch, the nearest pairs first, until those that are tried at a time all
  /// stay apart: others are hardly nearer. \returns the number of meetings.
  std::size_t run()
  {
    for (std::size_t meetings = 0;; update()) {
      Cancellation::poll();
      std::vector<Candidate> chosen = take_independent();
      if (chosen.empty()) return meetings;
      for_each_chunk(m.concurrency(), int(chosen.size()), 1,
                     [&](int k, int) { annihilate(chosen[k]); });
      ++m_taking;
      const std::size_t before = meetings;
      for (Candidate& c : chosen) {
        if (c.has_met) {
          ++meetings;
          take(c);
          for (const Vertex v : c.new_fives) m_left.push_back({v});
        } else if (c.length < Parameters::max_glide) {
          m_left.push_back({c.five, c.length + 1});
        }
      }
      if (meetings == before) return meetings;
    }
  }

private:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Edge = Star_mesh::Edge;
  using Face = Working_mesh::Face;
  using Parameters = Improvement_parameters::Dislocations;

  // A vertex with five edges: the meetings of its dislocations, each as the flips that lead there,
  // and all vertices that these may move, or depend on.
  struct Candidate {
    Vertex five;
    int length = 1;          // the least number of flips
    bool is_current = false; // what follows
    std::vector<std::vector<Edge>> meetings{};
    std::vector<Vertex> zone{};
    bool has_met = false;
    std::vector<Vertex> new_fives{}; // then: that have not been candidates
  };

  // Looks for the nearest meetings of the candidates that are left.
  void update()
  {
    for_each_chunk(m.concurrency(), int(m_left.size()), 1, [&](int k, int) { update(m_left[k]); });
  }

  // The same, if something has changed around the candidate.
  void update(Candidate& c) const
  {
    if (c.is_current && is_free(c)) return;
    c.is_current = true;
    c.meetings = find_meetings(c.five, c.length);
    if (c.meetings.empty()) return;
    c.length = int(c.meetings.front().size());
    std::vector<Edge> flips;
    for (const std::vector<Edge>& some : c.meetings)
      flips.insert(flips.end(), some.begin(), some.end());
    c.zone = vertices_near(flips, Parameters::rings + 1);
  }

  void take(const Candidate& c)
  {
    for (const Vertex v : c.zone) m_taken[v] = m_taking;
  }
  // Whether its zone touches none that is taken.
  bool is_free(const Candidate& c) const
  {
    return std::none_of(c.zone.begin(), c.zone.end(),
                        [this](Vertex v) { return m_taken[v] == m_taking; });
  }

  // Takes those out whose zones touch none of those taken before, the nearest pairs first, and all
  // that have no meeting any more.
  std::vector<Candidate> take_independent()
  {
    m_left.erase(std::remove_if(m_left.begin(), m_left.end(),
                                [](const Candidate& c) { return c.meetings.empty(); }),
                 m_left.end());
    std::sort(m_left.begin(), m_left.end(), [](const Candidate& a, const Candidate& b) {
      return std::pair(a.length, a.five) < std::pair(b.length, b.five);
    });
    ++m_taking;
    std::vector<Candidate> chosen, left;
    for (Candidate& c : m_left) {
      if (is_free(c)) {
        take(c);
        chosen.push_back(std::move(c));
      } else {
        left.push_back(std::move(c));
      }
    }
    m_left.swap(left);
    return chosen;
  }

  // Edges above six; 0 where the mesh is not free, as on features and borders.
  int excess(Vertex v) const { return m.is_movable(v) ? m_degrees[v] - 6 : 0; }

  void flip(Edge e)
  {
    const auto corners = m.corners(e);
    m.flip(e);
    for (int k = 0; k < 4; ++k) m_degrees[corners[k]] += change_of_degree(k);
  }
  // Of a corner of an edge that is flipped: the ends lose the edge.
  static int change_of_degree(int corner) { return corner < 2 ? -1 : 1; }

  // Makes one of the meetings happen.
  void annihilate(Candidate& c)
  {
    c.has_met = std::any_of(c.meetings.begin(), c.meetings.end(),
                            [this](const auto& flips) { return flip_if_better(flips); });
    if (!c.has_met) return;
    for (const Vertex v : c.zone)
      if (excess(v) == -1 && !std::exchange(m_is_known[v], true)) c.new_fives.push_back(v);
  }

  // The shortest chains of at least `length` flips after which the dislocations at `five` meet
  // another.
  std::vector<std::vector<Edge>> find_meetings(Vertex five, int length) const
  {
    const auto& mesh = m.working().mesh;
    std::vector<std::vector<Edge>> meetings;
    if (excess(five) != -1) return meetings;
    for (const Halfedge h : halfedges_around_target(five, mesh)) {
      if (excess(mesh.source(h)) != 1) continue;
      for (const bool to_left : {true, false}) {
        std::vector<Edge> flips = find_meeting(mesh.opposite(h), to_left);
        if (int(flips.size()) < length) continue;
        if (!meetings.empty() && flips.size() > meetings.front().size()) continue;
        if (!meetings.empty() && flips.size() < meetings.front().size()) meetings.clear();
        if (std::find(meetings.begin(), meetings.end(), flips) == meetings.end())
          meetings.push_back(std::move(flips));
      }
    }
    return meetings;
  }

  // The degrees after some flips.
  class Flipped_degrees {
  public:
    explicit Flipped_degrees(const Dislocation_annihilator& a) : m_annihilator(a) {}

    int excess(Vertex v) const
    {
      int sum = m_annihilator.excess(v);
      for (const auto& [u, change] : m_changes) sum += u == v ? change : 0;
      return sum;
    }
    bool can_flip(Edge e) const
    {
      const Star_mesh& m = m_annihilator.m;
      if (!m.is_free(e) || !m.working().is_flippable(e)) return false;
      const auto corners = m.corners(e);
      return std::all_of(corners.begin(), corners.end(), [&](Vertex v) {
        return m.is_movable(v) && excess(v) > -2 && excess(v) < Parameters::irregular_degree - 6;
      });
    }
    // Returns the change of the sum of the squares of the excess. \pre all corners may move
    int flip(Edge e)
    {
      int sum = 0;
      const auto corners = m_annihilator.m.corners(e);
      for (int k = 0; k < 4; ++k) {
        const int change = change_of_degree(k);
        sum += 2 * change * excess(corners[k]) + 1;
        m_changes.emplace_back(corners[k], change);
      }
      return sum;
    }

  private:
    const Dislocation_annihilator& m_annihilator;
    boost::container::small_vector<std::pair<Vertex, int>, 24> m_changes;
  };

  // The flips after which the dislocation at `h`, from five to seven, meets another; empty: it does
  // not, or far away. Each flip is of triangles that those before have not touched.
  std::vector<Edge> find_meeting(Halfedge h, bool to_left) const
  {
    const auto& mesh = m.working().mesh;
    std::vector<Edge> flips;
    Flipped_degrees degrees(*this);
    while (int(flips.size()) < Parameters::max_glide) {
      const Halfedge beside = // from seven
          to_left ? mesh.next(h) : mesh.opposite(mesh.prev(mesh.opposite(h)));
      const Edge e = mesh.edge(beside);
      if (!degrees.can_flip(e)) break;
      flips.push_back(e);
      const int change = degrees.flip(e);
      if (change < 0) return flips;
      if (change != 0) break;
      // from the new five to the new seven
      h = to_left ? mesh.opposite(mesh.prev(mesh.opposite(beside))) : mesh.next(beside);
    }
    return {};
  }

  void undo(const std::vector<Edge>& flips)
  {
    for (auto e = flips.rbegin(); e != flips.rend(); ++e)
      for (int k = 0; k < 3; ++k) flip(*e); // four turns are a whole one
  }

  bool flip_if_better(const std::vector<Edge>& flips)
  {
    Cancellation::poll();
    const std::vector<Vertex> near = vertices_near(flips);
    const auto faces = m.working().faces_at(near);
    if (!lie_well(faces)) return false; // nor will they
    std::vector<Surface_projector::Place> places;
    for (const Vertex v : near) places.push_back(m.place(v));
    const double before = energy(faces);
    for (std::size_t k = 0; k < flips.size(); ++k) {
      const Edge e = flips[k];
      if (!m.working().is_flippable(e)) { // not after the others
        undo({flips.begin(), flips.begin() + k});
        restore(near, places);
        return false;
      }
      flip(e);
      const std::vector<Vertex> around = vertices_near({e}, 1);
      for (int round = 0; round < Parameters::rounds_per_flip; ++round) smooth(around);
    }
    if (relax_below(clearly_less * before, near, faces) && lie_well(faces)) return true;
    undo(flips);
    restore(near, places);
    return false;
  }

  void smooth(const std::vector<Vertex>& vertices)
  {
    for (const Vertex v : vertices)
      if (m.is_movable(v)) smooth_vertex(m, v, Parameters::min_step);
  }

  // Moves vertices. False as soon as it is clear that the faces' energy will not fall below
  // `limit`.
  template <class Faces>
  bool relax_below(double limit, const std::vector<Vertex>& vertices, const Faces& faces)
  {
    double now = energy(faces);
    for (int round = 0; round < Parameters::rounds; ++round) {
      smooth(vertices);
      const double gain = now - energy(faces);
      now -= gain;
      if (now - limit > Parameters::gains_to_come * gain) return false;
    }
    return now < limit;
  }

  void restore(const std::vector<Vertex>& vertices,
               const std::vector<Surface_projector::Place>& places)
  {
    for (std::size_t k = 0; k < vertices.size(); ++k) m.move(vertices[k], places[k]);
  }

  // Those that are at most so many edges away from the corners of the edges' triangles; no way
  // leads through a vertex that is far from regular.
  std::vector<Vertex> vertices_near(const std::vector<Edge>& edges,
                                    int rings = Parameters::rings) const
  {
    std::vector<Vertex> near;
    for (const Edge e : edges)
      for (const Vertex v : m.corners(e)) near.push_back(v);
    m.working().add_neighbors(
        near, rings, [this](Vertex v) { return m_degrees[v] < Parameters::irregular_degree; });
    return near;
  }

  template <class Faces>
  double energy(const Faces& faces) const
  {
    double sum = 0;
    for (const Face f : faces) {
      const auto [a, b, c] = m.points(m.working().mesh.halfedge(f));
      sum += shape_energy(a, b, c);
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
  Unset_vector<int> m_degrees;    // by vertex; at most `irregular_degree`, which stays
  Unset_vector<char> m_is_known;  // by vertex: has been a candidate
  Unset_vector<unsigned> m_taken; // by vertex: when it was in a zone
  unsigned m_taking = 1;
  std::vector<Candidate> m_left; // to be tried
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_ANNIHILATE_DISLOCATIONS_H
