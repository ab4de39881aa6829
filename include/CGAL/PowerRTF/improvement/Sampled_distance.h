// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distances of edges, faces and stars of the mesh from the surface, at points of them: at some,
// or at so many that the largest distance is about known. From one point to the next it changes by
// no more than they are apart.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_SAMPLED_DISTANCE_H
#define CGAL_POWER_RTF_IMPROVEMENT_SAMPLED_DISTANCE_H

#include <CGAL/PowerRTF/improvement/Star_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CGAL::PowerRTF::internal {

class Sampled_distance {
public:
  using Vertex = Star_mesh::Vertex;
  using Edge = Star_mesh::Edge;
  using Face = Working_mesh::Face;

  /// `enough`: a distance up to which nothing has to be known; what is larger is known but for some
  /// per cent of it, or as parts of a 32nd of a face's edges tell. 0: edges are looked at in
  /// three places, faces in their middle.
  Sampled_distance(const Star_mesh& mesh, double enough) : m(mesh), m_enough(enough) {}

  /// At the middle alone; 0 of what has been removed, here and below.
  double middle(Edge e) const
  {
    if (m.working().mesh.is_removed(e)) return 0;
    const auto [a, b, c, d] = m.corners(e);
    return of_point(0.5 * (m.point(a) + m.point(b)), m.facet(a));
  }
  double middle(Face f) const
  {
    if (m.working().mesh.is_removed(f)) return 0;
    const auto [a, b, c] = m.working().corners(f);
    return of_point((m.point(a) + m.point(b) + m.point(c)) * (1 / 3.), m.facet(a));
  }

  /// The largest one.
  double operator()(Edge e) const
  {
    if (m.working().mesh.is_removed(e)) return 0;
    const auto [a, b, c, d] = m.corners(e);
    double farthest = 0;
    any_on_edge(m.point(a), m.point(b), No_less{*this, farthest, infinity, m.facet(a)});
    return farthest;
  }
  double operator()(Face f) const
  {
    if (m.working().mesh.is_removed(f)) return 0;
    const auto [a, b, c] = m.working().corners(f);
    double farthest = 0;
    any_in_face(m.point(a), m.point(b), m.point(c), No_less{*this, farthest, infinity, m.facet(a)});
    return farthest;
  }

  /// Where it is; of a face that has a distance larger than `enough`.
  Vec3d farthest_point(Face f) const
  {
    const auto [a, b, c] = m.working().corners(f);
    double farthest = 0;
    Vec3d point = m.point(a);
    any_in_face(m.point(a), m.point(b), m.point(c),
                No_less{*this, farthest, infinity, m.facet(a), &point});
    return point;
  }

  /// A point of a star: in the face at a corner, its weights for the corners `a` and `b` of that.
  struct Star_point {
    int corner = -1; ///< none
    double a = 0, b = 0;
  };

  /// The same of the star of `v`, with `v` at `p`; or any that is no less than `limit`. `at`: where
  /// it has been farthest is looked at first.
  double around(Vertex v, const Star& star, const Vec3d& p, double limit, Star_point& at) const
  {
    double farthest = 0;
    Vec3d point = p;
    const No_less reaches_limit{*this, farthest, limit, m.facet(v), &point};
    if (at.corner >= 0 && m_enough > 0) {
      const Star::Corner& c = star.corners[at.corner];
      if (reaches_limit(p + at.a * (c.a - p) + at.b * (c.b - p))) return farthest;
    }
    if (reaches_limit(p)) return farthest;
    for (int k = 0; k < int(star.corners.size()); ++k) {
      const Star::Corner& c = star.corners[k];
      const double before = farthest;
      const bool ends =
          any_on_edge(p, c.a, reaches_limit) || any_in_face(p, c.a, c.b, reaches_limit);
      if (farthest > before) {
        at.corner = k;
        barycentric_coordinates(point, p, c.a, c.b, at.a, at.b);
      }
      if (ends) break;
    }
    return farthest;
  }

private:
  static constexpr int max_depth = 5; // of the parts of faces
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  // `hint`: a facet near it.
  double of_point(const Vec3d& p, int hint) const
  {
    return length(m.projector().nearest(p, hint).point - p);
  }

  double squared_distance(const Vec3d& p, int facet) const
  {
    Triangle_part part;
    return m.projector().descent().onto(facet, p, part).squared_distance;
  }

  // Tells whether the largest distance of all points that it has got is no less than `limit`.
  struct No_less {
    const Sampled_distance& distance;
    double& farthest;
    double limit;
    int hint;
    Vec3d* farthest_point = nullptr;

    bool operator()(const Vec3d& p) const { return takes(p, distance.of_point(p, hint)); }
    bool takes(const Vec3d& p, double d) const
    {
      if (farthest_point && d > farthest) *farthest_point = p;
      farthest = std::max(farthest, d);
      return farthest >= limit;
    }
  };

  // Whether `is_it()` holds of any of the points on an edge.
  bool any_on_edge(const Vec3d& p, const Vec3d& q, const No_less& is_it) const
  {
    if (m_enough > 0) return false; // those of the faces tell
    for (const double t : {1 / 3., 1 / 2., 2 / 3.})
      if (is_it(p + t * (q - p))) return true;
    return false;
  }

  bool any_in_face(const Vec3d& p, const Vec3d& q, const Vec3d& r, const No_less& is_it) const
  {
    return m_enough > 0 ? any_in_parts(p, q, r, is_it.hint, max_depth, is_it)
                        : is_it((p + q + r) * (1 / 3.));
  }

  // Of the middle of a triangle and, where there may be more, of its quarters.
  bool any_in_parts(const Vec3d& p, const Vec3d& q, const Vec3d& r, int hint, int depth,
                    const No_less& is_it) const
  {
    constexpr double tolerance = 0.04;
    const auto known = [&] { return std::max(m_enough, is_it.farthest); };
    // The distance from one facet is convex.
    const auto is_near = [&](int facet) {
      const double most = (1 + tolerance) * known();
      return squared_distance(p, facet) <= most * most &&
             squared_distance(q, facet) <= most * most && squared_distance(r, facet) <= most * most;
    };
    if (is_near(hint)) return false;
    const Vec3d middle = (p + q + r) * (1 / 3.);
    const double radius = std::sqrt(std::max(
        {squared_length(p - middle), squared_length(q - middle), squared_length(r - middle)}));
    const double rest = known() - radius;
    const Surface_point<double> nearest = m.projector().near_enough(middle, rest, hint);
    const double d = std::sqrt(nearest.squared_distance);
    if (d <= rest) return false;
    if (is_it.takes(middle, d)) return true;
    if (depth == 0 || d + radius <= (1 + tolerance) * known() || is_near(nearest.facet))
      return false;
    const Vec3d a = 0.5 * (q + r), b = 0.5 * (r + p), c = 0.5 * (p + q);
    const int f = nearest.facet;
    return any_in_parts(a, b, c, f, depth - 1, is_it) ||
           any_in_parts(p, c, b, f, depth - 1, is_it) ||
           any_in_parts(c, q, a, f, depth - 1, is_it) || any_in_parts(b, a, r, f, depth - 1, is_it);
  }

  const Star_mesh& m;
  double m_enough;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_SAMPLED_DISTANCE_H
