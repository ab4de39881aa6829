// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef POWER_RTF_TEST_RELATIVE_DISTANCES_H
#define POWER_RTF_TEST_RELATIVE_DISTANCES_H

#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/Surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

/// Distance of each sample to its nearest one, over the spacing of a hexagonal arrangement.
inline std::vector<double> relative_distances(const CGAL::PowerRTF::Surface& s,
                                              const CGAL::PowerRTF::Samples& samples)
{
  const double C = CGAL::PowerRTF::spacing_constant(s, samples.size());
  std::vector<double> result;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double nearest = 4;
    for (std::size_t j = 0; j < samples.size(); ++j)
      if (j != i)
        nearest = std::min(nearest, squared_length(samples.points[i] - samples.points[j]));
    result.push_back(std::sqrt(nearest * samples.density[i]) / C);
  }
  std::sort(result.begin(), result.end());
  return result;
}

#endif // POWER_RTF_TEST_RELATIVE_DISTANCES_H
