// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How long an edge of a restricted cell may be and still be lost, or invented, by rounding.
//
// Backward errors: a fast cell is the exact cell of lines that are each displaced a little, line j
// by at most
//   delta_j = 64 eps ((d^2 + |w_i| + |w_j|) / 2t + S d / t)
// within distance S of s_i, d and t being the lengths of v = s_j - s_i and of its tangential part:
// the first term is the rounding of the offset (d^2 + w_i - w_j) / 2t, the second that of the
// direction, of the frame, and of the vertices interpolated by the clips, all of which lie within
// S. Let e be an edge of one of two cells, not of the other, and p and n the other's edges before
// and after it by direction. Cut by p and n alone, e has at least its length l in one arrangement
// of lines and no length in the other; its ends move by at most (delta_p + delta_e) / sin(p, e) and
// (delta_e + delta_n) / sin(e, n). So l is at most the sum of the two. Two lines that do not meet
// within S, however displaced, cannot both have edges, nor can rounding decide which of them has:
// then the bound is 0.
//
// Where one of the cells is empty, its lines leave nothing of the other one. Displaced by at most
// delta, they leave something of a polygon that holds a disc of radius delta, and one of area A and
// perimeter L holds a disc of radius A / L: so A is at most L delta. The lines that count are not
// only the polygon's edges: beside a cell as small as delta any line may pass that takes all of it.
// A line takes none if it is farther from s_i than the polygon's vertices by more than 2 delta_j,
// once for each of its two places.
//
// A site straight above or below s_i has no such line. Where t <= 64 eps d, the computed (a, b) is
// within 64 eps d of the exact one, so that nothing is known of its direction, and neither is
// longer than 128 eps d: within S, a x + b y is at most 128 eps d S, in either arithmetic. So the
// site keeps all within S or nothing, by the sign of c = (d^2 + w_i - w_j) / 2, unless
//   |c| <= 64 eps ((d^2 + |w_i| + |w_j|) / 2 + 2 S d):
// then rounding may decide whether it takes part in the cell at all.
//
// A cell without room (S = 0) is its site or nothing, by the signs of c of all others: rounding may
// decide where |c| <= 64 eps (d^2 + |w_i| + |w_j|) / 2, but not of a copy of s_i, of which c is the
// difference of two weights and has the exact sign.
#ifndef CGAL_POWER_RTF_EXACT_ROUNDING_BOUND_H
#define CGAL_POWER_RTF_EXACT_ROUNDING_BOUND_H

#include <CGAL/PowerRTF/cells/Sites_view.h>
#include <CGAL/PowerRTF/cells/Tangent_polygon.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Rounding_bound {
  const Sites_view<double>& m_view;
  int m_i;
  PowerRTF::Tangent_frame<double> m_frame;
  double m_reach, m_epsilon;

  struct Line {
    double angle, offset, displacement;
  };

public:
  /// Cell `i`, constructed within distance `reach` (S) in arithmetic of precision `epsilon`.
  Rounding_bound(const Sites_view<double>& view, int i, double reach, double epsilon)
      : m_view(view), m_i(i), m_frame(view.normals[i]), m_reach(reach), m_epsilon(epsilon)
  {}

  /// Bound of the length of `edge`, a neighbor or side of the square in one of two cells, by the
  /// edges (not empty) of the other one.
  double length_of(int edge, const std::vector<int>& other) const
  {
    constexpr double turn = 6.283185307179586;
    const Line e = line(edge);
    Line before{0, 0, 0}, after{0, 0, 0};
    double to_before = 2 * turn, to_after = 2 * turn; // angles
    for (int id : other) {
      const Line l = line(id);
      double forth = std::fmod(l.angle - e.angle, turn);
      if (forth < 0) forth += turn;
      const double back = turn - forth;
      if (forth < to_after) {
        to_after = forth;
        after = l;
      }
      if (back < to_before) {
        to_before = back;
        before = l;
      }
    }
    if (stays_off(e, before, to_before) || stays_off(e, after, to_after)) return 0;
    return (before.displacement + e.displacement) / std::fabs(std::sin(to_before)) +
           (after.displacement + e.displacement) / std::fabs(std::sin(to_after));
  }

  /// The largest displacement of the lines of `edges`, and of those of `sites` that may come, once
  /// displaced, within `radius` of the site.
  double displacement(const std::vector<int>& edges, const std::vector<int>& sites,
                      double radius) const
  {
    double largest = 0;
    for (int id : edges) largest = (std::max)(largest, line(id).displacement);
    for (int id : sites) {
      if (is_straight_above(id)) continue;
      const Line l = line(id);
      if (l.offset <= radius + 2 * l.displacement) largest = (std::max)(largest, l.displacement);
    }
    return largest;
  }

  /// Whether rounding may decide if site `j` takes part in the cell.
  bool may_decide_of(int j) const { return is_straight_above(j) && may_be_zero(j, m_reach); }

  /// Whether rounding may decide on which side of the plane between it and site `j` the site lies.
  bool may_decide_of_site(int j) const
  {
    return !(m_view.sites[j].point == m_view.sites[m_i].point) && may_be_zero(j, 0);
  }

  /// The farthest vertex's distance from the site in the cell of `sites` within the square of
  /// half-size `half`, all lines displaced outward or, by `side` -1, inward. 0: it is empty; also
  /// where it has too many edges to say how far it reaches at least.
  double radius(const std::vector<int>& sites, double half, int side) const
  {
    Tangent_polygon<double> polygon;
    polygon.set_square(half);
    for (std::size_t k = 0; k < sites.size() && polygon.size > 0; ++k) {
      const Line l = line(sites[k]);
      polygon.clip(std::cos(l.angle), std::sin(l.angle), l.offset + side * l.displacement,
                   sites[k]);
    }
    return polygon.overflow && side < 0 ? 0 : std::sqrt(polygon.squared_radius());
  }

private:
  /// Whether c of site `j` may be 0 but for rounding, and for that of a x + b y within `reach`.
  bool may_be_zero(int j, double reach) const
  {
    const Site<double>&s = m_view.sites[m_i], &other = m_view.sites[j];
    const double d2 = squared_length(other.point - s.point);
    const double c = (d2 + (s.weight - other.weight)) / 2;
    const double size = d2 + std::fabs(s.weight) + std::fabs(other.weight);
    return std::fabs(c) <= 64 * m_epsilon * (size / 2 + 2 * reach * std::sqrt(d2));
  }

  /// Above or below, up to rounding.
  bool is_straight_above(int j) const
  {
    const Vec3d v = m_view.sites[j].point - m_view.sites[m_i].point;
    const double t = std::hypot(dot(v, m_frame.u), dot(v, m_frame.v));
    return !(t > 64 * m_epsilon * length(v));
  }

  bool stays_off(const Line& e, const Line& other, double angle) const
  {
    return std::fabs(e.offset - other.offset) >
           e.displacement + other.displacement + 2 * m_reach * std::sin(angle / 2);
  }

  Line line(int id) const
  {
    const double unit = 64 * m_epsilon;
    if (id < 0) // the square's size is not known here: never said to stay off
      return {1.5707963267948966 * (-1 - id), std::numeric_limits<double>::quiet_NaN(),
              unit * m_reach};
    const Site<double>&s = m_view.sites[m_i], &other = m_view.sites[id];
    const Vec3d v = other.point - s.point;
    const double a = dot(v, m_frame.u), b = dot(v, m_frame.v), t = std::hypot(a, b);
    const double d2 = squared_length(v);
    const double size = d2 + std::fabs(s.weight) + std::fabs(other.weight);
    return {std::atan2(b, a), (d2 + (s.weight - other.weight)) / (2 * t),
            unit * (size / 2 + m_reach * std::sqrt(d2)) / t};
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXACT_ROUNDING_BOUND_H
