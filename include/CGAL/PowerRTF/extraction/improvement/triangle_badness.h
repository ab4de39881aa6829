// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a triangle is from acceptable: 0 as soon as its quality and angles are good, so that only
// bad triangles pull.
#ifndef CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_TRIANGLE_BADNESS_H
#define CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_TRIANGLE_BADNESS_H

#include <CGAL/PowerRTF/cells/vector.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

struct Triangle_badness {
  double badness = 0;            ///< 0 for a triangle that is good enough
  double inverse_mean_ratio = 1; ///< 1: equilateral

  static constexpr double tolerable = 0.0012; ///< Q .753, or 40.5 degrees, or 86.7 degrees

  /// What the search lowers: badness first, then the shape of all.
  double energy() const { return badness + 0.02 * (inverse_mean_ratio - 1); }
};

/// 4 (.77 - Q)+^2 + 4 ((41.5 - theta_min) / 60)+^2 + 8 ((theta_max - 86) / 60)+^2, Q as in
/// triangle_quality.h, angles in degrees.
inline Triangle_badness triangle_badness(const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  constexpr double quality = 0.77, smallest = 41.5, largest = 86, degrees = 57.29577951308232;
  constexpr double surely_good = 1.09; // the least of those with an angle of 41.5 degrees: 1.0901
  constexpr double cos_smallest = 0.7489557207890021, cos_largest = 0.0697564737441253;
  Triangle_badness result;
  const Vec3d ab = b - a, ac = c - a;
  const double twice_area = length(cross(ab, ac));
  double s[3] = {squared_length(ab), squared_length(ac), squared_length(c - b)};
  const double sum = s[0] + s[1] + s[2];
  if (!(twice_area > 0)) {
    result.badness = result.inverse_mean_ratio = std::numeric_limits<double>::infinity();
    return result;
  }
  result.inverse_mean_ratio = sum / (2 * 1.7320508075688772 * twice_area);
  if (result.inverse_mean_ratio < surely_good) return result;
  if (s[0] > s[1]) std::swap(s[0], s[1]);
  if (s[1] > s[2]) std::swap(s[1], s[2]);
  if (s[0] > s[1]) std::swap(s[0], s[1]);
  const double l0 = std::sqrt(s[0]), l1 = std::sqrt(s[1]), l2 = std::sqrt(s[2]);
  // the divisions only for what is bad
  const double q_above = 2 * 1.7320508075688772 * twice_area, q_below = (l0 + l1 + l2) * l2,
               min_above = s[1] + s[2] - s[0], min_below = 2 * l1 * l2,
               max_above = s[0] + s[1] - s[2], max_below = 2 * l0 * l1;
  if (q_above < quality * q_below) {
    const double x = quality - q_above / q_below;
    result.badness += 4 * x * x;
  }
  if (min_above > cos_smallest * min_below) {
    const double x = (smallest - std::acos(std::min(1., min_above / min_below)) * degrees) / 60;
    result.badness += 4 * x * x;
  }
  if (max_above < cos_largest * max_below) {
    const double x = (std::acos(std::max(-1., max_above / max_below)) * degrees - largest) / 60;
    result.badness += 8 * x * x;
  }
  return result;
}

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_TRIANGLE_BADNESS_H
