// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brings the mesh within a distance of the surface that is asked for, both ways, where few places
// are farther away: a single one would else ask for more samples everywhere. Edges there are
// flipped, and the vertices around them move, also to where the surface is too far, as long as
// triangles do not become bad. Where that does not do, a vertex is put, from where the mesh stays
// near enough without it; all places together must come nearer with each step.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_KEEP_DISTANCE_H
#define CGAL_POWER_RTF_IMPROVEMENT_KEEP_DISTANCE_H

#include <CGAL/PowerRTF/improvement/Changed_vertices.h>
#include <CGAL/PowerRTF/improvement/Far_places.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/Vertex_mover.h>
#include <CGAL/PowerRTF/improvement/lower_distances.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Distance_keeper {
public:
  /// `flat`: of the surface. `distance`: that is asked for.
  Distance_keeper(Star_mesh& mesh, Bad_triangle_optimizer& optimizer, const Flat_patches& flat,
                  double distance)
      : m(mesh), m_far(mesh, distance),
        m_lowerer(mesh, m_far.tracker(), flat,
                  {m_far.goal(), Parameters::max_badness, Parameters::min_agreement,
                   Parameters::unroundness_weight}),
        m_mover(mesh, optimizer, Parameters::spare_agreement)
  {
    m_lowerer.set_goal(m_far.goal());
    m_mover.tolerate(Parameters::max_badness);
  }

  void run()
  {
    m_far.update();
    lower();
    double before = std::numeric_limits<double>::infinity();
    while (m_far.excess() < Parameters::less * before) {
      before = m_far.excess();
      if (!move_vertices()) break;
      lower();
    }
  }

private:
  using Edge = Star_mesh::Edge;
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Face = Working_mesh::Face;
  using Place = Far_places::Place;
  using Parameters = Improvement_parameters::Distance_keeping;

  // As long as the places clearly become fewer.
  void lower()
  {
    double most = std::numeric_limits<double>::infinity();
    std::vector<Place> all = m_far.find(), far = all;
    for (int pass = 0; pass < Parameters::passes && !far.empty(); ++pass) {
      if (are_hopeless(all, Parameters::max_places, Parameters::vertices_per_place) ||
          double(all.size()) > most)
        break;
      most = Parameters::fewer * double(all.size());
      far = lower(far);
      all = m_far.find();
    }
  }

  // What is around these vertices, as long as all places together are too far.
  void lower_around(const std::vector<int>& vertices, double most)
  {
    std::vector<Place> far = m_far.find(faces_around(m, vertices));
    for (int pass = 0; pass < Parameters::passes_around && m_far.excess() > most; ++pass)
      far = lower(far);
  }

  // Whether the places are too many or too far to be helped.
  bool are_hopeless(const std::vector<Place>& far, int max_places, int vertices_per_place) const
  {
    const std::size_t small = m.size() / Parameters::min_vertices_per_place,
                      large = m.size() / vertices_per_place,
                      most = std::min<std::size_t>(max_places, small) + large;
    return !far.empty() &&
           (far.size() > most || far.front().distance > Parameters::hopeless * m_far.goal());
  }

  // \returns those that are far at the vertices that have changed: elsewhere, all is as before.
  std::vector<Place> lower(const std::vector<Place>& far)
  {
    for (const Place& place : far) {
      Cancellation::poll();
      lower(place);
    }
    return m_far.find(faces_around(m, m_far.update()));
  }
  void lower(const Place& place)
  {
    const auto& mesh = m.working().mesh;
    if (place.tracked >= 0) {
      m_lowerer.lower_tracked(place.tracked);
    } else if (m_far.sampled()(place.face) > m_far.goal()) {
      for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(place.face)))
        if (flip(mesh.edge(h))) return;
      m_lowerer.lower(place.face);
    }
  }

  // Puts vertices into far places, the farthest first. \returns whether it has put any.
  bool move_vertices()
  {
    const std::vector<Place> far = m_far.find();
    if (far.empty() || are_hopeless(far, Parameters::max_moves, Parameters::vertices_per_move))
      return false;
    const std::vector<Vertex> spare = m_mover.find_spare();
    int moved = 0, failed = 0, not_taken = 0;
    const auto are_many = [&moved](int failures) {
      return failures > Parameters::max_failures + Parameters::failures_per_move * moved;
    };
    std::size_t next = 0;
    const auto take_next = [&] {
      for (; next < spare.size() && !are_many(not_taken); ++not_taken)
        if (take(spare[next++])) return true;
      return false;
    };
    std::optional<Star_mesh::Checkpoint> before; // a vertex was taken
    for (const Place& place : far) {
      if (are_many(failed)) break;
      if (!m_far.is_far(place.face)) continue;
      if (!before) {
        before.emplace(m);
        if (!take_next()) break;
        if (!m_far.is_far(place.face)) continue; // it was at the vertex
      }
      if (!put(place.face)) {
        ++failed;
        continue;
      }
      ++moved;
      before.reset();
    }
    if (before) undo(*before);
    return moved > 0;
  }

  // If the rest is as near without it.
  bool take(Vertex v)
  {
    Cancellation::poll();
    const Vec3d p = m.point(v);
    const double most = m_far.excess();
    Star_mesh::Checkpoint before(m);
    if (m_mover.remove(v) && !m_mover.intersects_near(p)) {
      lower_around(m_far.update(), most);
      if (m_far.excess() <= most && !m_mover.intersects_near(p)) return true;
    }
    undo(before);
    return false;
  }

  // At once or, where no split does, with the vertices around the best one searching for places.
  bool put(Face f)
  {
    Cancellation::poll();
    const Missing_vertex place = m_far.missing_at(f);
    const double most = m_far.excess() - Parameters::worthwhile_part * m_far.excess(f);
    double least = std::numeric_limits<double>::infinity();
    int tries = 0, best = -1;
    Star_mesh::Checkpoint before(m);
    const auto is_near = [&] {
      if (m_mover.intersects_near(place.point)) return false;
      m_far.update();
      const double excess = m_far.excess();
      if (excess < least) least = excess, best = tries;
      ++tries;
      return excess <= most;
    };
    if (m_mover.insert(place, is_near)) return true;
    undo(before);
    if (best < 0) return false;
    tries = 0;
    const auto is_best = [&] { return !m_mover.intersects_near(place.point) && tries++ == best; };
    if (m_mover.insert(place, is_best)) {
      lower_around(m_far.update(), most);
      if (m_far.excess() <= most && !m_mover.intersects_near(place.point)) return true;
    }
    undo(before);
    return false;
  }

  void undo(Star_mesh::Checkpoint& before)
  {
    before.restore();
    m_far.update();
  }

  // Where the other edge is nearer to the surface.
  bool flip(Edge e)
  {
    constexpr int least_degree = 4; // that is left
    const auto& mesh = m.working().mesh;
    if (!m.is_free(e) || !m.working().is_flippable(e)) return false;
    const auto [a, b, c, d] = m.corners(e);
    if (mesh.degree(a) <= least_degree || mesh.degree(b) <= least_degree) return false;
    const Cost before = cost(e);
    Star_mesh::Checkpoint now(m);
    m.flip(e);
    const Cost after = cost(e);
    if (after.badness > std::max(Parameters::max_badness, before.badness) ||
        after.agreement < std::min(Parameters::min_agreement, before.agreement) ||
        !(after.distance < Parameters::worthwhile_share * before.distance)) {
      now.restore();
      return false;
    }
    m_far.tracker().update();
    return true;
  }

  struct Cost {
    double badness, agreement, distance;
  };

  // Of an edge and its two faces.
  Cost cost(Edge e) const
  {
    const auto& mesh = m.working().mesh;
    Cost cost{0, 1, 0};
    for (const int side : {0, 1}) {
      const Face f = mesh.face(mesh.halfedge(e, side));
      const auto [a, b, c] = m.working().corners(f);
      cost.badness =
          std::max(cost.badness, triangle_badness(m.point(a), m.point(b), m.point(c)).badness);
      cost.agreement = std::min(cost.agreement, m.agreement(a, b, c));
      cost.distance = std::max(cost.distance, m_far.sampled()(f));
    }
    return cost;
  }

  Star_mesh& m;
  Far_places m_far;
  Distance_lowerer m_lowerer;
  Vertex_mover m_mover;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_KEEP_DISTANCE_H
