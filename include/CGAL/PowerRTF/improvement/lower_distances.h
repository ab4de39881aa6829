// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lowers the largest distances of the mesh to the surface, where neither is far enough to spare a
// vertex: over a bent part the middles of edges and faces are farthest away, and the vertices
// around them search for places, in their tangent planes and along their normals, from which the
// largest distance around is smaller. The fit by least squares (fit_to_surface.h) minds the mean
// alone.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_LOWER_DISTANCES_H
#define CGAL_POWER_RTF_IMPROVEMENT_LOWER_DISTANCES_H

#include <CGAL/PowerRTF/features/flat_patches.h>
#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Sampled_distance.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/round_mesh.h>
#include <CGAL/PowerRTF/improvement/tangent_search.h>
#include <CGAL/PowerRTF/improvement/tracked_points.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// What is asked of moves that lower distances.
struct Lowering_terms {
  using Parameters = Improvement_parameters::Lowering;
  double enough = 0; ///< see Sampled_distance.h
  double max_badness = Parameters::max_badness, min_agreement = Parameters::min_agreement,
         unroundness_weight = Parameters::unroundness_weight;
};

class Distance_lowerer {
public:
  using Vertex = Star_mesh::Vertex;
  using Edge = Star_mesh::Edge;
  using Face = Working_mesh::Face;

  /// `flat`: of the surface. `terms`: of the moves.
  Distance_lowerer(Star_mesh& mesh, Distance_tracker& tracker, const Flat_patches& flat,
                   const Lowering_terms& terms = {})
      : m(mesh), m_tracker(tracker), m_flat(flat), m_terms(terms), m_distance(mesh, terms.enough),
        m_spacing(std::sqrt(mesh.projector().surface().area / double(mesh.size())))
  {}

  /// Looks at what is farther away than `share` times the farthest, where that is far enough to be
  /// worth it, and at most at so many places.
  void run(double share)
  {
    const auto& mesh = m.working().mesh;
    const int edges = int(mesh.num_edges());
    std::vector<std::pair<double, int>> far(edges + mesh.num_faces()); // edges, then faces
    for_each_index(m.concurrency(), int(far.size()), [&](int i) {
      far[i] = {i < edges ? -m_distance.middle(Edge(i)) : -m_distance.middle(Face(i - edges)), i};
    });
    const std::size_t most =
        std::min(far.size(), Parameters::max_places + m.size() / Parameters::vertices_per_place);
    std::partial_sort(far.begin(), far.begin() + most, far.end());
    set_goal(std::max(-share * far.front().first, Parameters::min_distance * m_spacing));
    for (std::size_t k = 0; k < most && -far[k].first > m_goal; ++k) {
      Cancellation::poll();
      const int i = far[k].second;
      i < edges ? lower(Edge(i)) : lower(Face(i - edges));
    }
  }

  /// The distance down to which the following lower what is farther away.
  void set_goal(double distance) { m_goal = distance; }
  /// Moves the ends of an edge. \returns whether one has moved
  bool lower(Edge e)
  {
    const auto [a, b, c, d] = m.corners(e);
    return repeat(
        [&, ends = std::array<Vertex, 2>{a, b}] { return m_distance(e) > m_goal && search(ends); });
  }
  /// The same of the corners of a face.
  bool lower(Face f)
  {
    return repeat([&] { return m_distance(f) > m_goal && search(m.working().corners(f)); });
  }
  /// The same of those of the face that is nearest to a tracked point; they also try where it is.
  bool lower_tracked(int i)
  {
    return repeat([&] {
      return m_tracker[i].distance > m_goal && search(m.working().corners(m_tracker[i].face), i);
    });
  }

private:
  using Parameters = Improvement_parameters::Lowering;
  using Fitting = Improvement_parameters::Fitting;
  using Place = Surface_projector::Place;

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  // What a search keeps.
  struct Limits {
    double badness, agreement, farthest;
    bool is_flat; // the vertex stays in the plane of its facet
  };

  // As long as it moves vertices. \returns whether it has.
  template <class Move>
  static bool repeat(const Move& move)
  {
    int round = 0;
    while (round < Parameters::rounds && move()) ++round;
    return round > 0;
  }

  // `tracked`: a point that the vertices try to come to, or -1.
  template <class Vertices>
  bool search(const Vertices& vertices, int tracked = -1)
  {
    bool has_moved = false;
    for (const Vertex v : vertices) {
      m.release(v);
      if (m.is_movable(v) && !m.is_hub(v)) has_moved |= search(v, tracked);
    }
    return has_moved;
  }

  bool search(Vertex v, int tracked)
  {
    m_farthest = {};
    const Star star = m.star(v);
    const Vec3d p = m.point(v);
    const Limits limits{
        std::max(m_terms.max_badness, Parameters::badness_growth * worst_badness(star, p)),
        std::min(m_terms.min_agreement, m.agreement(star, p, m.normal(v))),
        farthest_around(v, star, p, infinity), lies_flat(m.facet(v))};
    if (limits.farthest <= m_terms.enough) return false; // since a neighbor has moved
    const double before = unroundness_around(star, p) + std::max(1., limits.farthest / m_goal);
    double least = before;
    const Vec3d start = tracked < 0 ? p : towards(tracked, v, star, limits, least);
    const Vec3d q = search_tangent_plane<Parameters>(
        start, m.normal(v), Parameters::first_step * mean_edge(star, p), least,
        [&](const Vec3d& x, double limit) {
          return energy(v, star, m.project(v, x), limits, limit);
        });
    Place best = least < before ? m.project(v, q) : m.place(v);
    if (!limits.is_flat) lift(v, star, limits, best, least);
    if (!(least < before - Parameters::worthwhile) || !m.move_off(v, best.point)) return false;
    m_tracker.update_around(v);
    return true;
  }

  // Where the energy is least of: `v`, and where it may go for the tracked point to be nearer.
  Vec3d towards(int tracked, Vertex v, const Star& star, const Limits& limits, double& least)
  {
    const Vec3d p = m.point(v);
    Vec3d best = p;
    for (const Vec3d& q : places_towards(m_tracker.point(tracked), m_tracker[tracked].nearest, p)) {
      const double limit = clearly_less * least,
                   e = energy(v, star, m.project(v, q), limits, limit);
      if (!(e < limit)) continue;
      least = e;
      best = q;
    }
    return best;
  }

  // Searches along the normal.
  void lift(Vertex v, const Star& star, const Limits& limits, Place& best, double& least)
  {
    double step = Parameters::first_lift * limits.farthest;
    for (int halved = 0; halved < Parameters::max_halvings; ++halved, step /= 2)
      for (const double up : {step, -step}) {
        Place place = best;
        place.point += up * best.normal;
        const double limit = clearly_less * least, e = energy(v, star, place, limits, limit);
        if (!(e < limit)) continue;
        least = e;
        best = place;
      }
  }

  bool lies_flat(int facet) const { return m_flat.width(facet) > Fitting::flat_width * m_spacing; }

  // What has been farthest around the vertex that searches: mostly, it is so at its next place.
  struct Farthest {
    int tracked = -1;
    Sampled_distance::Star_point point;
  };

  // Infinite where the limits are not kept, or where it is no less than `limit`.
  double energy(Vertex v, const Star& star, const Place& place, const Limits& limits, double limit)
  {
    if (place.facet < 0 || lies_flat(place.facet) != limits.is_flat) return infinity;
    const auto& normals = m.projector().surface().facet_normals;
    if (limits.is_flat &&
        !(dot(normals[m.facet(v)], normals[place.facet]) > Fitting::coplanar_cosine))
      return infinity;
    if (worst_badness(star, place.point) > limits.badness ||
        m.agreement(star, place.point, place.normal) < limits.agreement)
      return infinity;
    const double uneven = unroundness_around(star, place.point);
    if (!(uneven + 1 < limit)) return infinity;
    const double most = std::min((limit - uneven) * m_goal, limits.farthest),
                 farthest = farthest_around(v, star, place.point, most);
    return farthest < most ? uneven + std::max(1., farthest / m_goal) : infinity;
  }

  double unroundness_around(const Star& star, const Vec3d& p) const
  {
    constexpr Unroundness unroundness{Improvement_parameters::Rounding::last_badness_weight};
    return m_terms.unroundness_weight * star.sum(p, unroundness) / double(star.corners.size());
  }

  // The largest distance of the mesh around `v`, with `v` at `p`, and of the surface there; or any
  // that is no less than `limit`.
  double farthest_around(Vertex v, const Star& star, const Vec3d& p, double limit)
  {
    const double farthest =
        m_tracker.farthest_around(v, p, limit, m_terms.enough, m_farthest.tracked);
    if (farthest >= limit) return farthest;
    return std::max(farthest, m_distance.around(v, star, p, limit, m_farthest.point));
  }

  static double worst_badness(const Star& star, const Vec3d& p)
  {
    double worst = 0;
    for (const Star::Corner& c : star.corners)
      worst = std::max(worst, triangle_badness(p, c.a, c.b).badness);
    return worst;
  }

  Star_mesh& m;
  Distance_tracker& m_tracker;
  const Flat_patches& m_flat;
  Lowering_terms m_terms;
  Sampled_distance m_distance;
  double m_spacing, m_goal = 0; // the goal: a distance
  Farthest m_farthest;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_LOWER_DISTANCES_H
