// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The smallest number of samples whose mesh is as near to its input as is asked for.
#ifndef CGAL_POWER_RTF_SAMPLES_WITHIN_DISTANCE_H
#define CGAL_POWER_RTF_SAMPLES_WITHIN_DISTANCE_H

#include <CGAL/PowerRTF/fields/resolution.h>
#include <CGAL/PowerRTF/geometry/bounding_box.h>
#include <CGAL/PowerRTF_remesher.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace CGAL::PowerRTF {

namespace internal {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// The smallest n up to `most` with `ratio(n) <= 1`, to a tenth, where `ratio` falls about as 1 /
/// n, if it falls; infinite if there is none. The search begins with `first`.
template <class Ratio>
double smallest_of_falling(double first, double most, const Ratio& ratio)
{
  constexpr double near_enough = 1.1, step = 1.04, least = 4, farthest = 4;
  double failed = least - 1, met = infinity;
  for (double n = std::round(std::clamp(first, least, most));;) {
    const double r = ratio(static_cast<std::size_t>(n));
    (r <= 1 ? met : failed) = n;
    if (failed == most) return infinity;
    if (met <= near_enough * failed || met == failed + 1) return met;
    // A little more than it should be, and between what has been tried.
    const double next = std::round(n * step * std::clamp(r, 1 / farthest, farthest));
    const double low = std::max(failed + 1, std::ceil(step * failed)),
                 high = std::min({met - 1, std::floor(met / step), most});
    n = std::clamp(next, std::min(low, high), std::max(high, failed + 1));
  }
}

/// The same where `ratio` scatters about what it should be, by some tenths: below, a few numbers do
/// by luck. Of those from 24 to 2 % below, in steps of 2 %, the smallest that does is taken. Then
/// of those from 24 to 14 % below that, as about the nearer ones have been tried, and so on until
/// none does. Small numbers scatter more, and take a moment: there, from 36 % below on. `most` if
/// none at all does.
template <class Ratio>
std::size_t smallest_number(double first, double most, const Ratio& ratio)
{
  constexpr double step = 0.02, least = 4, small = 2000;
  constexpr int far = 7;
  const auto farthest = [](double n) { return n < small ? 18 : 12; };
  most = std::floor(most);
  double best = smallest_of_falling(first, most, ratio);
  if (best == infinity) return static_cast<std::size_t>(most);
  int nearest = 1;
  for (int k = farthest(best); k >= nearest; --k) {
    const double n = std::round((1 - step * k) * best);
    if (n < least || n == best || ratio(static_cast<std::size_t>(n)) > 1) continue;
    best = n;
    nearest = far;
    k = farthest(best) + 1;
  }
  return static_cast<std::size_t>(best);
}

} // namespace internal

/// The number of samples of which a run gives a mesh no farther from the input than
/// `options.max_distance` or `options.relative_max_distance`, about the smallest such number;
/// where none does, the largest that was tried: ten times the input's vertices, or as many as are
/// needed on a sphere.
///
/// \tparam Traits a model of `PowerRTFTraits_3`
/// \param prepare `prepare(options, report)` returns the surface as `prepare_surface()`
/// \throws internal::Run_cancelled `visitor` stopped it
template <class Traits, class Prepare, class Visitor>
std::size_t samples_within_distance(Remeshing_options options, const Prepare& prepare,
                                    Visitor& visitor)
{
  double first, most;
  {
    Remeshing_report report;
    const Surface surface = prepare(options, report);
    first = samples_of_sphere(surface, report.max_distance);
    most = std::clamp(10 * std::max(first, double(surface.points.size())), 1000., 3e8);
  }
  return internal::smallest_number(first, most, [&](std::size_t n) {
    options.number_of_samples = n;
    Remeshing_report report;
    Surface surface = prepare(options, report);
    try {
      PowerRTF_remesher<Traits> remesher(std::move(surface), options, report);
      if (remesher.optimize(visitor)) remesher.extract(visitor);
      if (remesher.report().cancelled) throw internal::Run_cancelled();
      const Remeshing_report& done = remesher.report();
      return done.absolute(done.distance.bound) / done.max_distance;
    } catch (const Invalid_input_error&) { // the samples are too few
      return internal::infinity;
    }
  });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLES_WITHIN_DISTANCE_H
