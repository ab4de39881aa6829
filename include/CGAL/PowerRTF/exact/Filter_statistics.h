// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_EXACT_FILTER_STATISTICS_H
#define CGAL_POWER_RTF_EXACT_FILTER_STATISTICS_H

#include <cstddef>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFExact
/// How the predicates were decided. Add with `+=`.
struct Filter_statistics {
  std::size_t filtered = 0; ///< decided by interval arithmetic
  std::size_t exact = 0;    ///< decided by exact arithmetic, ties included
  std::size_t ties = 0;     ///< exactly zero, decided by the symbolic perturbation

  Filter_statistics& operator+=(const Filter_statistics& o)
  {
    filtered += o.filtered;
    exact += o.exact;
    ties += o.ties;
    return *this;
  }
  /// Share of the predicates that the filter decided, in [0, 1]; 1 when there were none.
  double filtered_share() const
  {
    return filtered + exact == 0 ? 1 : double(filtered) / double(filtered + exact);
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXACT_FILTER_STATISTICS_H
