// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An upper bound of the largest distance of one surface from another one, facet by facet. The
// distance from a facet is convex, so over a convex polygon its largest value is at a corner: a
// facet is cut up into polygons, each above one facet of the other surface, and where there is none
// above which it lies, into pieces until these are small enough. (Tang, Lee and Kim, "Interactive
// Hausdorff distance computation for general polygonal models", 2009, bound by the same convexity.)
#ifndef CGAL_POWER_RTF_QUALITY_DISTANCE_BOUND_H
#define CGAL_POWER_RTF_QUALITY_DISTANCE_BOUND_H

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Corners in order.
using Convex_polygon = std::vector<Vec3d>;

/// The parts of a polygon on the side of a plane to which its normal points, and on the other.
inline std::array<Convex_polygon, 2> parted(const Convex_polygon& polygon, const Vec3d& on_plane,
                                            const Vec3d& normal)
{
  std::array<Convex_polygon, 2> parts;
  const std::size_t size = polygon.size();
  for (std::size_t k = 0; k < size; ++k) {
    const Vec3d &a = polygon[k], &b = polygon[k + 1 < size ? k + 1 : 0];
    const double above_a = dot(a - on_plane, normal), above_b = dot(b - on_plane, normal);
    if (above_a >= 0) parts[0].push_back(a);
    if (above_a <= 0) parts[1].push_back(a);
    if ((above_a < 0 && above_b > 0) || (above_a > 0 && above_b < 0))
      for (Convex_polygon& part : parts)
        part.push_back(a + (above_a / (above_a - above_b)) * (b - a));
  }
  for (Convex_polygon& part : parts)
    if (part.size() < 3) part.clear();
  return parts;
}

/// Bounds distances from the surface of a tree.
class Distance_bound {
public:
  /// Bounds are found that are at most `factor` times the largest distance, or `enough`; larger
  /// ones for a facet that would have to be cut into more than about `most_pieces`.
  Distance_bound(const Facet_tree& tree, double enough, double factor, int most_pieces)
      : m_tree(tree), m_enough(enough), m_factor(factor), m_most_pieces(most_pieces)
  {}

  /// Of the points of a facet.
  double operator()(const Facet_corners<double>& facet) const
  {
    int work = m_most_pieces;
    return over({facet.a, facet.b, facet.c}, facet.normal, work);
  }

private:
  static constexpr std::size_t many = 48;     // facets near a polygon
  static constexpr double least_cosine = 0.1; // of normals: a facet is seen from above
  using Corners = Facet_corners<double>;

  // Of a polygon, or of its halves where it is large and has many facets near it.
  double over(const Convex_polygon& polygon, const Vec3d& normal, int& work) const
  {
    const Surface_view<double> view = m_tree.view();
    Box3<double> box{polygon[0], polygon[0]};
    for (const Vec3d& p : polygon) box.add(p);
    const bool is_large = length(box.hi - box.lo) > m_enough;
    const float reach = bound_of(m_enough * m_enough);
    const auto are_many = [&](const std::vector<int>& near) { return near.size() > many; };
    std::vector<int> near;
    visit_near(
        view.facet_tree, view.facet_nodes, Box_query(box),
        [&] { return is_large && are_many(near) ? -1.f : reach; },
        [&](int place) { near.push_back(place); });
    double largest = 0;
    if (is_large && are_many(near)) {
      for (const Convex_polygon& half : halves(polygon))
        if (!half.empty()) largest = std::max(largest, over(half, normal, work));
      return largest;
    }
    std::vector<Convex_polygon> rest{polygon};
    for (auto it = near.begin(); it != near.end() && !rest.empty(); ++it)
      cover(normal, view.facets[*it], rest, largest);
    for (const Convex_polygon& other : rest)
      largest = std::max(largest, refined(other, std::max(m_enough, largest), work));
    return largest;
  }

  // Takes away from the polygons what is near to `other`, and above or below it.
  void cover(const Vec3d& normal, const Corners& other, std::vector<Convex_polygon>& polygons,
             double& largest) const
  {
    const bool is_edge_on = !(std::fabs(dot(normal, other.normal)) > least_cosine);
    const std::array<Vec3d, 3> corners{other.a, other.b, other.c};
    std::vector<Convex_polygon> rest;
    for (Convex_polygon& polygon : polygons) {
      if (const double all = bound(polygon, other); all <= m_enough) {
        largest = std::max(largest, all);
        continue;
      }
      std::vector<Convex_polygon> outside;
      Convex_polygon inside = is_edge_on ? Convex_polygon() : polygon;
      for (int k = 0; k < 3 && !inside.empty(); ++k) {
        const Vec3d &p = corners[k], &q = corners[(k + 1) % 3], &r = corners[(k + 2) % 3];
        const Vec3d across = cross(normal, q - p);
        auto parts = parted(inside, p, dot(r - p, across) < 0 ? across * -1 : across);
        inside = std::move(parts[0]);
        if (!parts[1].empty()) outside.push_back(std::move(parts[1]));
      }
      const double covered = bound(inside, other);
      if (inside.empty() || covered > m_enough) {
        rest.push_back(std::move(polygon));
        continue;
      }
      largest = std::max(largest, covered);
      std::move(outside.begin(), outside.end(), std::back_inserter(rest));
    }
    polygons = std::move(rest);
  }

  // By its nearest facet, or by its parts': halves the piece with the largest bound until all are
  // `enough`, or near a distance that there is, or the work is used up.
  double refined(const Convex_polygon& polygon, double enough, int& work) const
  {
    struct Piece {
      double bound;
      Convex_polygon polygon;
      bool operator<(const Piece& other) const { return bound < other.bound; }
    };
    std::vector<Piece> pieces; // a heap
    const auto add = [&](Convex_polygon part) {
      const auto nearest = m_tree.nearest_anywhere(center_of(part));
      enough = std::max(enough, m_factor * std::sqrt(nearest.squared_distance));
      const Corners& facet = m_tree.view().facets[m_tree.place(nearest.facet)];
      pieces.push_back({bound(part, facet), std::move(part)});
      std::push_heap(pieces.begin(), pieces.end());
      --work;
    };
    add(polygon);
    while (pieces.front().bound > enough && work > 0) {
      std::array<Convex_polygon, 2> parts = halves(pieces.front().polygon);
      if (parts[0].empty() || parts[1].empty()) break; // as small as rounding lets them be
      std::pop_heap(pieces.begin(), pieces.end());
      pieces.pop_back();
      for (Convex_polygon& part : parts) add(std::move(part));
    }
    return pieces.front().bound;
  }

  static Vec3d center_of(const Convex_polygon& polygon)
  {
    Vec3d center{0, 0, 0};
    for (const Vec3d& p : polygon) center = center + p * (1. / double(polygon.size()));
    return center;
  }

  static std::array<Convex_polygon, 2> halves(const Convex_polygon& polygon)
  {
    return parted(polygon, center_of(polygon), longest_edge(polygon));
  }

  static Vec3d longest_edge(const Convex_polygon& polygon)
  {
    Vec3d longest = polygon[0] - polygon.back();
    for (std::size_t k = 1; k < polygon.size(); ++k)
      if (const Vec3d edge = polygon[k] - polygon[k - 1];
          squared_length(edge) > squared_length(longest))
        longest = edge;
    return longest;
  }

  // By one facet.
  static double bound(const Convex_polygon& polygon, const Corners& facet)
  {
    double squared = 0;
    for (const Vec3d& p : polygon)
      squared = std::max(
          squared, squared_length(p - nearest_point_on_triangle(p, facet.a, facet.b, facet.c)));
    return std::sqrt(squared);
  }

  const Facet_tree& m_tree;
  double m_enough, m_factor;
  int m_most_pieces;
};

/// An upper bound of the distances of all points of the surface of `from` from that of `to`, at
/// most `factor` times the largest, but for rounding and where a facet would take too much work.
/// `known`: the distance of some point.
inline double distance_bound(const Facet_tree& from, const Facet_tree& to, double known,
                             Concurrency concurrency, double factor = 1.01)
{
  constexpr double rounding = 1e-12; // in the unit box
  constexpr int all_pieces = 4'000'000, least_pieces = 100;
  const Surface_view<double> view = from.view();
  const int facets = (std::max)(1, view.facet_tree.items);
  const Distance_bound bound(to, std::max(factor * known, rounding), factor,
                             (std::max)(least_pieces, all_pieces / facets));
  return rounding +
         reduce(
             concurrency, view.facet_tree.items, 0.,
             [&](double& most, int place) { most = std::max(most, bound(view.facets[place])); },
             [](double& most, double part) { most = std::max(most, part); });
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_QUALITY_DISTANCE_BOUND_H
