// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Smoothing of a star: its center moves where that lowers the sum of the inverse mean ratios
// L^2 / (4 sqrt(3) A) of the triangles (1: equilateral). It makes an over-relaxed Newton step in
// its tangent plane and goes back to the surface. (Freitag and Knupp, "Tetrahedral mesh improvement
// via optimization of the element condition number", 2002, for triangles.)
#ifndef CGAL_POWER_RTF_SMOOTHING_SMOOTH_VERTEX_H
#define CGAL_POWER_RTF_SMOOTHING_SMOOTH_VERTEX_H

#include <CGAL/PowerRTF/geometry/Surface_descent.h>
#include <CGAL/PowerRTF/geometry/Tangent_frame.h>
#include <CGAL/PowerRTF/smoothing/Smoothing_parameters.h>

#include <cmath>

namespace CGAL::PowerRTF::internal {

/// Of a triangle: the inverse mean ratio, up to the factor 1 / (2 sqrt(3)).
CGAL_POWER_RTF_HD inline double shape_energy(const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  const Vec3d e = b - a, f = c - a;
  const double twice_area = length(cross(e, f));
  if (!(twice_area > 0)) return INFINITY;
  return (squared_length(e) + squared_length(f) + squared_length(f - e)) / twice_area;
}
inline constexpr double least_shape_energy = 3.4641; ///< a little less than 2 sqrt(3)

/// The smallest cosine between the normals of the star's triangles, with its center at `p`, and the
/// surface's normals at their corners, of which `normal` is that at the center.
/// \tparam Stars a mesh with `normal(v)` and `is_on_feature(v)`: features have no normal
/// \tparam Star calls `f` for its triangles, as `Star_view::Star`
template <class Stars, class Star>
CGAL_POWER_RTF_HD double star_agreement(const Stars& m, const Star& star, const Vec3d& p,
                                        const Vec3d& normal)
{
  double least = 1;
  star.for_each([&](const auto& c) {
    const Vec3d n = cross(c.a - p, c.b - p);
    const double l = length(n);
    const auto note = [&](double d) { least = d < least ? d : least; };
    note(l > 0 ? dot(n, normal) / l : -1);
    if (!(l > 0)) return;
    if (!m.is_on_feature(c.vertex_a)) note(dot(n, m.normal(c.vertex_a)) / l);
    if (!m.is_on_feature(c.vertex_b)) note(dot(n, m.normal(c.vertex_b)) / l);
  });
  return least;
}

/// One step of the vertex `v`, which may move, if it is at least `min_step` long, in the shortest
/// edge of the star. \tparam Stars as `Star_view`
template <class Stars>
CGAL_POWER_RTF_HD void smooth_vertex(Stars& m, typename Stars::Vertex v,
                                     double min_step = Smoothing_parameters::min_step)
{
  using Parameters = Smoothing_parameters;
  const auto star = m.star(v);
  const Vec3d p = m.point(v), n = m.normal(v);
  const auto energy = [&star](const Vec3d& q) {
    double sum = 0;
    star.for_each([&](const auto& c) { sum += shape_energy(q, c.a, c.b); });
    return sum;
  };

  // gradient and Hessian in the plane (u, w); areas are linear there but for the curvature
  const PowerRTF::Tangent_frame<double> frame(n);
  const Vec3d u = frame.u, w = frame.v;
  double now = 0, gu = 0, gw = 0, huu = 0, huw = 0, hww = 0, shortest = INFINITY;
  star.for_each([&](const auto& c) {
    const Vec3d e = c.a - p, f = c.b - p, area = cross(e, f);
    const double a = length(area), ee = squared_length(e),
                 l = ee + squared_length(f) + squared_length(f - e);
    shortest = !(a > 0) ? -1 : ee < shortest ? ee : shortest;
    const double i = 1 / a, i2 = i * i, i3 = 2 * l * i2 * i;
    const Vec3d dl = -2 * (e + f), da = i * cross(e - f, area);
    const double lu = dot(dl, u), lw = dot(dl, w), au = dot(da, u), aw = dot(da, w);
    now += l * i;
    gu += lu * i - l * au * i2;
    gw += lw * i - l * aw * i2;
    huu += 4 * i - 2 * lu * au * i2 + i3 * au * au;
    huw += -(lu * aw + lw * au) * i2 + i3 * au * aw;
    hww += 4 * i - 2 * lw * aw * i2 + i3 * aw * aw;
  });
  const double determinant = huu * hww - huw * huw;
  if (!(shortest > 0) || !(determinant > 0) || !(huu > 0)) return;
  const double scale = -Parameters::relaxation / determinant;
  double su = scale * (hww * gu - huw * gw), sw = scale * (huu * gw - huw * gu);
  const double size = std::sqrt(su * su + sw * sw), unit = std::sqrt(shortest),
               limit = Parameters::max_step * unit;
  if (!(size > min_step * unit)) return;
  if (size > limit) su *= limit / size, sw *= limit / size;

  for (int halving = 0; halving < 3; ++halving, su /= 2, sw /= 2) {
    const Surface_place place = m.project(v, p + su * u + sw * w);
    if (place.facet < 0 || !(energy(place.point) < now)) continue;
    const double agreement = star_agreement(m, star, place.point, place.normal);
    if (agreement < Parameters::min_agreement && agreement < star_agreement(m, star, p, n))
      continue;
    m.move(v, place);
    return;
  }
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_SMOOTH_VERTEX_H
