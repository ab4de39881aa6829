// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lowers the maximal distance: where the surface's vertices are farthest from the mesh (tips and
// thin parts between the samples), the nearest mesh vertex moves there and is pinned, if that makes
// the farthest distance around it clearly smaller.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_COVER_TIPS_H
#define CGAL_POWER_RTF_IMPROVEMENT_COVER_TIPS_H

#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/tracked_points.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <algorithm>
#include <cmath>
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
    std::size_t covered = 0, tried = 0;
    for (const auto& [d, i] : far) {
      Cancellation::poll();
      if (!(m_tracker[i].distance > least)) continue; // covered with a neighbor
      if (++tried > Parameters::max_places + m.size() / Parameters::vertices_per_place) break;
      while (m_tracker[i].distance > least && cover(i)) ++covered;
    }
    return covered;
  }

private:
  using Parameters = Improvement_parameters::Tips;

  bool cover(int i)
  {
    const auto& mesh = m.working().mesh;
    const Vec3d x = m_tracker.point(i);
    struct {
      double distance;
      Vertex v;
      Surface_projector::Place place;
    } best{Parameters::worthwhile_share, Vertex(), {}};
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
            m_tracker.farthest_around(v, place.point, best.distance * before) / before;
        if (ratio < best.distance) best = {ratio, v, place};
      }
    }
    if (!best.v.is_valid()) return false;
    m.move(best.v, best.place);
    m.pin(best.v);
    m_tracker.update_around(best.v);
    return true;
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
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_COVER_TIPS_H
