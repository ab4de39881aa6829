// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a triangle is from acceptable: 0 as soon as its quality and angles are good, so that only
// bad triangles pull.
#ifndef CGAL_POWER_RTF_SMOOTHING_TRIANGLE_BADNESS_H
#define CGAL_POWER_RTF_SMOOTHING_TRIANGLE_BADNESS_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/vector.h>

#include <cmath>

namespace CGAL::PowerRTF::internal {

struct Triangle_badness {
  double badness = 0;            ///< 0 for a triangle that is good enough
  double inverse_mean_ratio = 1; ///< 1: equilateral

  static constexpr double tolerable = 0.0012; ///< Q .763, or 42.06 degrees, or 83.93 degrees
  /// An inverse mean ratio: all below it are good. The least of those with an angle of 43.1 degrees
  /// is 1.0730.
  static constexpr double surely_good = 1.072;

  /// What the search lowers: badness first, then the shape of all.
  CGAL_POWER_RTF_HD double energy() const { return badness + 0.02 * (inverse_mean_ratio - 1); }
};

/// 4 (.78 - Q)+^2 + 4 ((43.1 - theta_min) / 60)+^2 + 8 ((theta_max - 83.2) / 60)+^2, Q as in
/// triangle_quality.h, angles in degrees. They come, within some percent and without trigonometric
/// functions, from tan(43.1 - theta_min) and cot 83.2 - cot theta_max: atan(x)^2 is nearly
/// x^2 / (1 + 0.64 x^2) up to tan 43.1; of the largest angle, up to 170, x^2 / (1 + 0.42 x^2)
/// serves.
CGAL_POWER_RTF_HD inline Triangle_badness triangle_badness(const Vec3d& a, const Vec3d& b,
                                                           const Vec3d& c)
{
  constexpr double least_quality = 0.78, quality_weight = 4;
  constexpr double cot_smallest = 1.0686233026146528, smallest_weight = 3.648; // 43.1 degrees
  constexpr double cot_largest = 0.11924278068055229, largest_weight = 7.295;  // 83.2 degrees
  Triangle_badness result;
  const Vec3d ab = b - a, ac = c - a;
  const double squared_double_area = squared_length(cross(ab, ac));
  if (!(squared_double_area > 0)) {
    result.badness = result.inverse_mean_ratio = INFINITY;
    return result;
  }
  const double s0 = squared_length(ab), s1 = squared_length(ac), s2 = squared_length(c - b);
  const double sum = s0 + s1 + s2, quadruple_area = 2 * std::sqrt(squared_double_area);
  result.inverse_mean_ratio = sum / (1.7320508075688772 * quadruple_area);
  if (result.inverse_mean_ratio < Triangle_badness::surely_good) return result;
  // the cotangent of the angle opposite to the edge s: (sum - 2 s) / quadruple_area
  const double shortest = smaller(s0, smaller(s1, s2)), longest = larger(s0, larger(s1, s2));
  const double smallest_excess = sum - 2 * shortest - cot_smallest * quadruple_area;
  if (smallest_excess > 0) {
    const double below =
        (1 + cot_smallest * cot_smallest) * quadruple_area + cot_smallest * smallest_excess;
    const double x2 = smallest_excess * smallest_excess;
    result.badness += smallest_weight * x2 / (below * below + 0.64 * x2);
  }
  const double largest_excess = cot_largest * quadruple_area - (sum - 2 * longest);
  if (largest_excess > 0) {
    const double x2 = largest_excess * largest_excess;
    result.badness += largest_weight * x2 / (4 * squared_double_area + 0.42 * x2);
  }
  // the square of the perimeter is at most 3 sum: most triangles need no more
  if (12 * squared_double_area < 3 * least_quality * least_quality * sum * longest) {
    const double q = 1.7320508075688772 * quadruple_area /
                     ((std::sqrt(s0) + std::sqrt(s1) + std::sqrt(s2)) * std::sqrt(longest));
    if (q < least_quality) {
      const double x = least_quality - q;
      result.badness += quality_weight * x * x;
    }
  }
  return result;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_TRIANGLE_BADNESS_H
