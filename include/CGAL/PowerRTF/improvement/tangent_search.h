// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A search for a better place of a vertex in its tangent plane.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_TANGENT_SEARCH_H
#define CGAL_POWER_RTF_IMPROVEMENT_TANGENT_SEARCH_H

#include <CGAL/PowerRTF/geometry/Tangent_frame.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>

#include <cmath>

namespace CGAL::PowerRTF::internal {

/// The mean of the star's edges at its center, `p`.
inline double mean_edge(const Star& star, const Vec3d& p)
{
  double sum = 0;
  for (const Star::Corner& c : star.corners) sum += length(c.a - p);
  return sum / double(star.corners.size());
}

/// Looks for a place of less energy in six directions in the plane upright on `normal`, with
/// shorter and shorter steps.
/// \tparam Parameters has `max_halvings` of the step, and `max_steps`
/// \param step the first one
/// \param least the energy at `p`; becomes that of the result
/// \param energy `energy(q, limit)`, or what is no less than `limit`
template <class Parameters, class Energy>
Vec3d search_tangent_plane(const Vec3d& p, const Vec3d& normal, double step, double& least,
                           const Energy& energy)
{
  constexpr double d = 0.8660254037844386;
  constexpr double directions[6][2] = {{1, 0}, {.5, d}, {-.5, d}, {-1, 0}, {-.5, -d}, {.5, -d}};
  const auto [u, w] = PowerRTF::Tangent_frame<double>(normal);
  double su = 0, sw = 0;
  for (int i = 0, halved = 0; i < Parameters::max_steps && halved < Parameters::max_halvings; ++i) {
    int best = -1;
    for (int k = 0; k < 6; ++k) {
      const double limit = clearly_less * least, e = energy(p + (su + step * directions[k][0]) * u +
                                                                (sw + step * directions[k][1]) * w,
                                                            limit);
      if (e < limit) least = e, best = k;
    }
    if (best >= 0) {
      su += step * directions[best][0];
      sw += step * directions[best][1];
    } else {
      step /= 2;
      ++halved;
    }
  }
  return p + su * u + sw * w;
}

/// The same in three directions, of which the first that is better is taken. They turn from step to
/// step, by the golden angle: where the energy has ridges, few lead downwards.
/// \param turn of the first directions, in radians
template <class Parameters, class Energy>
Vec3d search_tangent_plane(const Vec3d& p, const Vec3d& normal, double step, double turn,
                           double& least, const Energy& energy)
{
  constexpr double golden_angle = 2.3999632297286533, d = 0.8660254037844386;
  const auto [x, y] = PowerRTF::Tangent_frame<double>(normal);
  Vec3d best = p;
  for (int i = 0, halved = 0; i < Parameters::max_steps && halved < Parameters::max_halvings; ++i) {
    const double cosine = std::cos(turn), sine = std::sin(turn);
    const Vec3d u = cosine * x + sine * y, w = cosine * y - sine * x, from = best;
    for (const Vec3d& direction : {u, d * w - .5 * u, -d * w - .5 * u}) {
      const double limit = clearly_less * least, e = energy(from + step * direction, limit);
      if (!(e < limit)) continue;
      least = e;
      best = from + step * direction;
      break;
    }
    if (best == from) {
      step /= 2;
      ++halved;
    }
    turn += golden_angle;
  }
  return best;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_TANGENT_SEARCH_H
