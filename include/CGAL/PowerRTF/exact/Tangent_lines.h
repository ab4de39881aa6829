// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The half-planes that bound a restricted cell, in any number type.
//
// In the tangent plane { s_i + x : n_i.x = 0 } the equal-power plane with sample j keeps
//   2 v.x <= |v|^2 + w_i - w_j,  v = s_j - s_i            (paper: eq. 6)
// and a side of a clipping square keeps t.x <= B. Dropping the coordinate in which |n_i| is largest
// maps the plane to R^2 by an affine map with coefficients in the ring of the inputs: no division
// and no square root, so that a line's coefficients are exact in an exact ring and enclosed in an
// interval type. The map keeps the orientation seen from n_i.
#ifndef CGAL_POWER_RTF_EXACT_TANGENT_LINES_H
#define CGAL_POWER_RTF_EXACT_TANGENT_LINES_H

#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/compat.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <CGAL/number_utils.h>

#include <cmath>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// The projection of a tangent plane along a coordinate axis. `normal` is n_i or -n_i, so that
/// its coordinate along `axis` is positive; (p, q) are the kept axes, in the order that makes a
/// turn from p to q counter-clockwise seen from n_i.
struct Tangent_frame {
  int axis, p, q;
  double n_axis, n_p, n_q;

  /// \throw Invalid_input_error when `n` is zero or not finite.
  explicit Tangent_frame(const Vec3d& n);
};

inline double coordinate(const Vec3d& v, int k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

inline bool is_finite(const Vec3d& v)
{
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline Tangent_frame::Tangent_frame(const Vec3d& n)
{
  if (!is_finite(n) || n == Vec3d{0, 0, 0})
    throw Invalid_input_error("a sample's normal is zero or not finite");
  axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::fabs(coordinate(n, k)) > std::fabs(coordinate(n, axis))) axis = k;
  p = (axis + 1) % 3;
  q = (axis + 2) % 3;
  double s = 1;
  if (coordinate(n, axis) < 0) {
    s = -1;
    std::swap(p, q);
  }
  n_axis = s * coordinate(n, axis);
  n_p = s * coordinate(n, p);
  n_q = s * coordinate(n, q);
}

/// The half-plane a x + b y <= c, or, when `at_infinity`, a x + b y <= c + Omega, where Omega is
/// larger than every number.
template <class NT>
struct Tangent_line {
  NT a, b, c;
  bool at_infinity;
};

/// The half-plane that sample i keeps against sample j.
template <class NT>
Tangent_line<NT> sample_line(const Tangent_frame& f, const Vec3d& s_i, double w_i, const Vec3d& s_j,
                             double w_j)
{
  const NT v_axis = NT(coordinate(s_j, f.axis)) - NT(coordinate(s_i, f.axis));
  const NT v_p = NT(coordinate(s_j, f.p)) - NT(coordinate(s_i, f.p));
  const NT v_q = NT(coordinate(s_j, f.q)) - NT(coordinate(s_i, f.q));
  const NT n_axis(f.n_axis), twice(2);
  const NT a = n_axis * v_p - NT(f.n_p) * v_axis;
  const NT b = n_axis * v_q - NT(f.n_q) * v_axis;
  const NT d2 = CGAL::square(v_axis) + CGAL::square(v_p) + CGAL::square(v_q);
  const NT c = n_axis * (d2 + (NT(w_i) - NT(w_j)));
  return {twice * a, twice * b, c, false};
}

/// The half-plane t.x <= offset; t.x <= Omega when `at_infinity`.
template <class NT>
Tangent_line<NT> side_line(const Tangent_frame& f, const Vec3d& t, double offset, bool at_infinity)
{
  const NT n_axis(f.n_axis), t_axis(coordinate(t, f.axis));
  const NT a = n_axis * NT(coordinate(t, f.p)) - NT(f.n_p) * t_axis;
  const NT b = n_axis * NT(coordinate(t, f.q)) - NT(f.n_q) * t_axis;
  const NT c = at_infinity ? NT(0) : NT(n_axis * NT(offset));
  return {a, b, c, at_infinity};
}

/// Positive when the turn from j's to k's outward direction is counter-clockwise: then their
/// crossing is a vertex of a polygon that has edge j before edge k.
template <class NT>
NT turn(const Tangent_line<NT>& j, const Tangent_line<NT>& k)
{
  return j.a * k.b - j.b * k.a;
}

/// The crossing of two lines, (x + ox Omega, y + oy Omega) / w; (ox, oy) count when `at_infinity`.
template <class NT>
struct Tangent_vertex {
  NT x, y, w, ox, oy;
  bool at_infinity;
};

template <class NT>
Tangent_vertex<NT> crossing(const Tangent_line<NT>& j, const Tangent_line<NT>& k)
{
  Tangent_vertex<NT> v{
      j.c * k.b - j.b * k.c,         j.a * k.c - j.c * k.a, turn(j, k), NT(0), NT(0),
      j.at_infinity || k.at_infinity};
  if (j.at_infinity) {
    v.ox = k.b;
    v.oy = -k.a;
  }
  if (k.at_infinity) {
    v.ox = v.ox - j.b;
    v.oy = v.oy + j.a;
  }
  return v;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXACT_TANGENT_LINES_H
