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
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/round_mesh.h>
#include <CGAL/PowerRTF/improvement/tangent_search.h>
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

class Distance_lowerer {
public:
  using Vertex = Star_mesh::Vertex;
  using Edge = Star_mesh::Edge;
  using Face = Working_mesh::Face;

  /// `flat`: of the surface.
  Distance_lowerer(Star_mesh& mesh, Distance_tracker& tracker, const Flat_patches& flat)
      : m(mesh), m_tracker(tracker), m_flat(flat),
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
      far[i] = {i < edges ? -middle_distance(Edge(i)) : -distance(Face(i - edges)), i};
    });
    const std::size_t most =
        std::min(far.size(), Parameters::max_places + m.size() / Parameters::vertices_per_place);
    std::partial_sort(far.begin(), far.begin() + most, far.end());
    m_goal = std::max(-share * far.front().first, Parameters::min_distance * m_spacing);
    for (std::size_t k = 0; k < most && -far[k].first > m_goal; ++k) {
      const int i = far[k].second;
      for (int round = 0; round < Parameters::rounds; ++round) {
        Cancellation::poll();
        if (!(i < edges ? lower(Edge(i)) : lower(Face(i - edges)))) break;
      }
    }
  }

private:
  using Parameters = Improvement_parameters::Lowering;
  using Fitting = Improvement_parameters::Fitting;
  using Place = Surface_projector::Place;

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double edge_points[] = {1 / 3., 1 / 2., 2 / 3.}; // where edges are measured

  // What a search keeps.
  struct Limits {
    double badness, agreement, farthest;
    bool is_flat; // the vertex stays in the plane of its facet
  };

  // Of a point of the mesh to the surface. `hint`: a facet near it.
  double distance(const Vec3d& p, int hint) const
  {
    return length(m.projector().nearest(p, hint).point - p);
  }

  double middle_distance(Edge e) const
  {
    if (m.working().mesh.is_removed(e)) return 0;
    const auto [a, b, c, d] = m.corners(e);
    return distance(0.5 * (m.point(a) + m.point(b)), m.facet(a));
  }

  double distance(Edge e) const
  {
    const auto [a, b, c, d] = m.corners(e);
    double farthest = 0;
    for (const double t : edge_points)
      farthest =
          std::max(farthest, distance(m.point(a) + t * (m.point(b) - m.point(a)), m.facet(a)));
    return farthest;
  }

  double distance(Face f) const
  {
    if (m.working().mesh.is_removed(f)) return 0;
    const auto [a, b, c] = m.working().corners(f);
    return distance((m.point(a) + m.point(b) + m.point(c)) * (1 / 3.), m.facet(a));
  }

  bool lower(Edge e)
  {
    const auto [a, b, c, d] = m.corners(e);
    return distance(e) > m_goal && search(std::array<Vertex, 2>{a, b});
  }

  bool lower(Face f) { return distance(f) > m_goal && search(m.working().corners(f)); }

  // \returns whether a vertex has moved.
  template <class Vertices>
  bool search(const Vertices& vertices)
  {
    bool has_moved = false;
    for (const Vertex v : vertices) {
      m.release(v);
      if (m.is_movable(v) && !m.is_hub(v)) has_moved |= search(v);
    }
    return has_moved;
  }

  bool search(Vertex v)
  {
    const Star star = m.star(v);
    const Vec3d p = m.point(v);
    const Limits limits{
        std::max(Parameters::max_badness, Parameters::badness_growth * worst_badness(star, p)),
        std::min(Parameters::min_agreement, m.agreement(star, p, m.normal(v))),
        farthest_around(v, star, p, infinity), lies_flat(m.facet(v))};
    const double before = unroundness_around(star, p) + std::max(1., limits.farthest / m_goal);
    double least = before;
    const Vec3d q = search_tangent_plane<Parameters>(
        p, m.normal(v), Parameters::first_step * mean_edge(star, p), least,
        [&](const Vec3d& x, double limit) {
          return energy(v, star, m.project(v, x), limits, limit);
        });
    Place best = least < before ? m.project(v, q) : m.place(v);
    if (!limits.is_flat) lift(v, star, limits, best, least);
    if (!(least < before - Parameters::worthwhile) || !m.move_off(v, best.point)) return false;
    m_tracker.update_around(v);
    return true;
  }

  // Searches along the normal.
  void lift(Vertex v, const Star& star, const Limits& limits, Place& best, double& least) const
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

  // Infinite where the limits are not kept, or where it is no less than `limit`.
  double energy(Vertex v, const Star& star, const Place& place, const Limits& limits,
                double limit) const
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

  static double unroundness_around(const Star& star, const Vec3d& p)
  {
    constexpr Unroundness unroundness{Improvement_parameters::Rounding::last_badness_weight};
    double sum = 0;
    for (const Star::Corner& c : star.corners) sum += unroundness(p, c.a, c.b);
    return Parameters::unroundness_weight * sum / double(star.corners.size());
  }

  // The largest distance of the mesh around `v`, with `v` at `p`, and of the surface there; or any
  // that is no less than `limit`.
  double farthest_around(Vertex v, const Star& star, const Vec3d& p, double limit) const
  {
    double farthest = 0;
    const auto reaches_limit = [&](const Vec3d& q) {
      farthest = std::max(farthest, distance(q, m.facet(v)));
      return farthest >= limit;
    };
    if (reaches_limit(p)) return farthest;
    for (const Star::Corner& c : star.corners) {
      for (const double t : edge_points)
        if (reaches_limit(p + t * (c.a - p))) return farthest;
      if (reaches_limit((p + c.a + c.b) * (1 / 3.))) return farthest;
    }
    return std::max(farthest, m_tracker.farthest_around(v, p, limit));
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
  double m_spacing, m_goal = 0; // the goal: a distance
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_LOWER_DISTANCES_H
