// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_TOTALS_H
#define CGAL_POWER_RTF_INTERNAL_TOTALS_H

#include <CGAL/PowerRTF/internal/host_device.h>

namespace CGAL::PowerRTF {

/// What a reduction gathers, in double precision.
template <int Sums, int Maxima>
struct Totals {
  static constexpr int sums = Sums, size = Sums + Maxima;
  double values[size]; ///< the sums, then the maxima

  CGAL_POWER_RTF_HD void clear()
  {
    for (int k = 0; k < size; ++k) values[k] = k < Sums ? 0 : -1e300;
  }
  CGAL_POWER_RTF_HD void add(int k, double x) { values[k] += x; }
  /// Maximum number k.
  CGAL_POWER_RTF_HD void raise(int k, double x)
  {
    if (x > values[Sums + k]) values[Sums + k] = x;
  }
  CGAL_POWER_RTF_HD double sum(int k) const { return values[k]; }
  CGAL_POWER_RTF_HD double maximum(int k) const { return values[Sums + k]; }

  CGAL_POWER_RTF_HD static double joined(int k, double a, double b)
  {
    return k < Sums ? a + b : a > b ? a : b;
  }
};

/// Where a reduction ends: writes the totals, the sums first.
struct Keep_totals {
  double* values;

  template <int Sums, int Maxima>
  CGAL_POWER_RTF_HD void operator()(const Totals<Sums, Maxima>& totals) const
  {
    for (int k = 0; k < totals.size; ++k) values[k] = totals.values[k];
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INTERNAL_TOTALS_H
