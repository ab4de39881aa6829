// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The filter of the fast cells: proves after the fact, in floating point with bounded rounding
// errors, that a polygon's cycle of neighbors is the exact one. A cyclic sequence of half-planes
// bounds their intersection with all others when consecutive ones turn to the left and every vertex
// lies strictly inside all others: such vertices are vertices of the cell, each edge joins two of
// them, and a closed chain of edges of a convex polygon is its whole boundary. Nothing is assumed
// about how the polygon was found. (Error bounds: doc/PowerRTF/exact.txt.)
#ifndef CGAL_POWER_RTF_CELLS_POLYGON_CERTIFICATE_H
#define CGAL_POWER_RTF_CELLS_POLYGON_CERTIFICATE_H

#include <CGAL/PowerRTF/cells/Tangent_polygon.h>

namespace CGAL::PowerRTF {

/// The computed half-plane a x + b y <= c of a neighbor, and how far it may be from the exact one.
template <class FT>
struct Rounded_half_plane {
  FT a, b, c;
  FT distance; ///< d, of the neighbor: a and b are off by at most d times the frame's tilt
  FT error;    ///< c is off by at most this much
};

template <class FT>
class Polygon_certificate {
public:
  using Line = Rounded_half_plane<FT>;

  /// `frame`: of the plane with normal `normal`, as computed; its own errors are measured.
  CGAL_POWER_RTF_HD Polygon_certificate(const Vec3<FT>& normal, const Tangent_frame<FT>& frame)
      : m_tilt((size(dot(normal, frame.u)) + size(dot(normal, frame.v))) / length(normal) +
               8 * internal::epsilon<FT>())
  {}

  /// The line of a neighbor at `offset` with c = (d^2 + w_i - w_j) / 2.
  CGAL_POWER_RTF_HD static Line line(FT a, FT b, FT c, FT d2, FT w_i, FT w_j)
  {
    return {a, b, c, std::sqrt(d2), 4 * internal::epsilon<FT>() * (d2 + size(w_i) + size(w_j))};
  }

  /// Adds the vertex from edge `j` to edge `k`; false when their turn is uncertain.
  CGAL_POWER_RTF_HD bool add_vertex(const Line& j, const Line& k)
  {
    constexpr FT eps = internal::epsilon<FT>();
    const FT dd = j.distance * k.distance, turn = j.a * k.b - j.b * k.a;
    const FT turn_error = dd * (4 * m_tilt + 4 * eps);
    if (!(turn > 2 * turn_error)) return false;
    const FT x = (j.c * k.b - j.b * k.c) / turn, y = (j.a * k.c - j.c * k.a) / turn;
    const FT product_error = k.distance * (j.error + size(j.c) * (m_tilt + 4 * eps)) +
                             j.distance * (k.error + size(k.c) * (m_tilt + 4 * eps));
    const FT norm = size(x) + size(y);
    const FT error = 4 * (product_error + norm * turn_error) / turn;
    m_x[m_size] = x;
    m_y[m_size] = y;
    m_slope[m_size++] = 2 * (m_tilt + 4 * eps) * norm + 2 * error;
    const FT radius = std::sqrt(x * x + y * y) * (1 + 8 * eps) + 2 * error;
    if (!(radius <= m_radius)) m_radius = radius;
    return true;
  }

  /// Whether all vertices but `except` and the one before it are certainly inside `l`.
  CGAL_POWER_RTF_HD bool is_outside_polygon(const Line& l, int except = -1) const
  {
    const FT room = l.c - l.error;
    if (except < 0 && room > l.distance * m_radius * FT(1.000001)) return true;
    const int before = except > 0 ? except - 1 : m_size - 1;
    for (int k = 0; k < m_size; ++k) {
      if (except >= 0 && (k == except || k == before)) continue;
      if (!(room - l.a * m_x[k] - l.b * m_y[k] > l.distance * m_slope[k])) return false;
    }
    return true;
  }

  /// An upper bound of the distance of the exact vertices from the site.
  CGAL_POWER_RTF_HD FT radius() const { return m_radius * FT(1.0000001); }
  /// Whether the bounds hold: they take the frame for nearly exact.
  CGAL_POWER_RTF_HD bool is_frame_usable() const { return m_tilt < FT(1e-8); }

private:
  CGAL_POWER_RTF_HD static FT size(FT x) { return x < 0 ? -x : x; }

  static constexpr int capacity = Tangent_polygon<FT>::capacity;
  FT m_tilt; // relative error of a and b
  FT m_radius = 0;
  int m_size = 0;
  FT m_x[capacity], m_y[capacity];
  FT m_slope[capacity]; // error of a x + b y at the vertex, per unit of the neighbor's distance
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_POLYGON_CERTIFICATE_H
