// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lowers the maximal distance: where the surface's vertices are farthest from the mesh (tips and
// thin parts between the samples), the nearest mesh vertex moves there and is pinned, if that makes
// the farthest distance around it clearly smaller. All moves are looked for at once, then made one
// by one; what is near to one that has been made is looked at anew.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_COVER_TIPS_H
#define CGAL_POWER_RTF_IMPROVEMENT_COVER_TIPS_H

#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/tracked_points.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_set>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Tip_coverer {
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;

  /// `limit`: the badness that a move may bring upon a triangle that was better.
  Tip_coverer(Star_mesh& mesh, Distance_tracker& tracker, double limit)
      : m(mesh), m_tracker(tracker), m_limit(limit)
  {}

  /// Looks at what is farther away than `share` times the farthest, and at most 1 % of the mesh's
  /// vertices. \returns how many vertices have been moved and pinned.
  std::size_t run(double share)
  {
    const double least = share * m_tracker.max_distance();
    std::vector<std::pair<double, int>> far;
    for (const int i : m_tracker.farther_than(least)) far.push_back({-m_tracker[i].distance, i});
    std::sort(far.begin(), far.end());
    const std::size_t most = Parameters::max_places + m.size() / Parameters::vertices_per_place;
    std::vector<Move> moves(std::min(most, far.size()));
    for_each_chunk(m.concurrency(), int(moves.size()), 1,
                   [&](int k, int) { moves[k] = best_move(far[k].second); });
    std::size_t covered = 0, tried = 0;
    for (std::size_t k = 0; k < far.size(); ++k) {
      Cancellation::poll();
      const int i = far[k].second;
      if (!(m_tracker[i].distance > least)) continue; // covered with a neighbor
      if (++tried > most) break;
      Move move = k < moves.size() && is_as_it_was(i) ? moves[k] : best_move(i);
      while (move.v.is_valid()) {
        make(move);
        ++covered;
        move = m_tracker[i].distance > least ? best_move(i) : Move();
      }
    }
    return covered;
  }

private:
  using Parameters = Improvement_parameters::Tips;

  // Of a vertex, and by how much it lowers the largest distance around it; none: no vertex.
  struct Move {
    double ratio = Parameters::worthwhile_share;
    Vertex v{};
    Surface_projector::Place place{};
  };

  // That of a corner of the face nearest to a point. It depends on what is at most two edges away
  // from these.
  Move best_move(int i) const
  {
    const auto& mesh = m.working().mesh;
    const Vec3d x = m_tracker.point(i);
    Move best;
    Halfedge h = m_tracker[i].face;
    for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
      const Vertex v = mesh.target(h);
      if (!m.is_movable(v) || m.is_hub(v)) continue;
      const Star star = m.star(v);
      const Vec3d p = m.point(v);
      const double agreement =
          std::min(Parameters::min_agreement, m.agreement(star, p, m.normal(v)));
      const double before = m_tracker.farthest_around(v, p);
      for (const Vec3d& q : places_towards(x, m_tracker[i].nearest, p)) {
        const auto place = m.project(v, q);
        if (place.facet < 0 || !keeps_shape(star, p, place.point) ||
            m.agreement(star, place.point, place.normal) < agreement)
          continue;
        const double ratio =
            m_tracker.farthest_around(v, place.point, best.ratio * before) / before;
        if (ratio < best.ratio) best = {ratio, v, place};
      }
    }
    return best;
  }

  void make(const Move& move)
  {
    m.move(move.v, move.place);
    m.pin(move.v);
    m_tracker.update_around(move.v);
    std::vector<Vertex> near{move.v};
    m.working().add_neighbors(near, 2);
    m_near_moved.insert(near.begin(), near.end());
  }

  // Whether no move has changed what `best_move(i)` depends on.
  bool is_as_it_was(int i) const
  {
    const auto corners = m.working().corners(m_tracker[i].face);
    return std::none_of(corners.begin(), corners.end(),
                        [this](Vertex v) { return m_near_moved.count(v) > 0; });
  }

  bool keeps_shape(const Star& star, const Vec3d& now, const Vec3d& p) const
  {
    for (const Star::Corner& c : star.corners)
      if (!(triangle_badness(p, c.a, c.b).badness <=
            std::max(m_limit, triangle_badness(now, c.a, c.b).badness)))
        return false;
    return true;
  }

  Star_mesh& m;
  Distance_tracker& m_tracker;
  double m_limit;
  std::unordered_set<Vertex> m_near_moved; // at most two edges away from one that has moved
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_COVER_TIPS_H
