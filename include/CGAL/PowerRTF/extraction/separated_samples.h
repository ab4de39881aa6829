// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples at one point, as they come to lie in tips that are too thin for them, taken apart.
#ifndef CGAL_POWER_RTF_EXTRACTION_SEPARATED_SAMPLES_H
#define CGAL_POWER_RTF_EXTRACTION_SEPARATED_SAMPLES_H

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <set>

namespace CGAL::PowerRTF::internal {

/// The samples, as few as can be at one point of the output's grid: the first of several stays, or
/// one of the last `fixed`, and the others move into their facets. Those of a facet that is as
/// small as the grid stay, too, and what is left after some tries.
inline Samples separated_samples(const Surface& surface, Samples samples, std::size_t fixed)
{
  constexpr int max_tries = 64;
  std::set<std::array<double, 3>> taken;
  const auto take = [&](const Vec3d& p) {
    const Vec3d q = surface.normalization.snapped(p);
    return taken.insert({q.x, q.y, q.z}).second;
  };
  const std::size_t free = samples.size() - fixed;
  for (std::size_t s = free; s < samples.size(); ++s) take(samples.points[s]);
  for (std::size_t s = 0; s < free; ++s) {
    const Vec3d p = samples.points[s];
    if (take(p)) continue;
    const auto [a, b, c] = surface.triangles[samples.facets[s]];
    const Vec3d corners[] = {surface.points[a], surface.points[b], surface.points[c]};
    const Vec3d far = *std::max_element(std::begin(corners), std::end(corners),
                                        [&](const Vec3d& q, const Vec3d& r) {
                                          return squared_length(q - p) < squared_length(r - p);
                                        });
    const Vec3d center = (1. / 3) * (corners[0] + corners[1] + corners[2]);
    const Vec3d inside = 0.5 * (center + far); // also where `p` is the center
    for (int k = 2; k < max_tries; ++k) {
      samples.points[s] = p + (1. / k) * (inside - p);
      if (take(samples.points[s])) break;
    }
  }
  return samples;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_SEPARATED_SAMPLES_H
