// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs until the edges have the median length that is asked for.
#ifndef CGAL_POWER_RTF_RUN_TO_EDGE_LENGTH_H
#define CGAL_POWER_RTF_RUN_TO_EDGE_LENGTH_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace CGAL::PowerRTF {

namespace internal {

/// The median length of the edges over the one that is asked for; 1 where none is.
inline double median_over_asked(const Remeshing_report& report)
{
  const double asked = report.median_edge_length, is = report.edge_length.median;
  return asked > 0 && is > 0 ? is / asked : 1;
}

} // namespace internal

/// A remesher, and what `make(remesher)` makes of it, as a mesh. Where the edges are off the median
/// length that is asked for, as the area of a coarse mesh is less than that of the surface, another
/// number of samples is tried, \f$n \sim \ell^{-2}\f$, and the best one is taken.
///
/// \tparam Remesher a `PowerRTF_remesher`, whose constructor gets the arguments but `make`
/// \throws Invalid_input_error as that constructor and `make`
template <class Remesher, class Make>
auto run_to_edge_length(Surface surface, const Remeshing_options& options,
                        const Remeshing_report& report, const Make& make)
{
  constexpr double near_enough = 0.01;
  constexpr int max_corrections = 3;
  const Surface prepared = report.median_edge_length > 0 ? surface : Surface();
  auto remesher = std::make_unique<Remesher>(std::move(surface), options, report);
  auto result = make(*remesher);
  for (int k = 0; k < max_corrections; ++k) {
    const double ratio = internal::median_over_asked(remesher->report());
    if (remesher->report().cancelled || std::abs(ratio - 1) <= near_enough) break;
    Remeshing_report again = report;
    const double n = double(remesher->report().samples_asked);
    again.samples_asked = static_cast<std::size_t>(std::lround(n * ratio * ratio));
    try {
      auto next = std::make_unique<Remesher>(prepared, options, again);
      auto next_result = make(*next);
      const double next_ratio = internal::median_over_asked(next->report());
      const bool is_nearer = std::abs(next_ratio - 1) < std::abs(ratio - 1);
      if (!is_nearer && !next->report().cancelled) break;
      remesher = std::move(next);
      result = std::move(next_result);
    } catch (const Invalid_input_error&) { // the samples are too few
      break;
    }
  }
  return std::make_pair(std::move(remesher), std::move(result));
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_RUN_TO_EDGE_LENGTH_H
