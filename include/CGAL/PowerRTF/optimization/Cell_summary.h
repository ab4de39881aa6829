// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an engine looks at once per iteration: how far the capacities are from equal (the interval
// test of Algorithms 2 and 3), how far the samples are from centroidal, and the cells' states.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_CELL_SUMMARY_H
#define CGAL_POWER_RTF_OPTIMIZATION_CELL_SUMMARY_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/optimization/usable_cells.h>

#include <cmath>
#include <cstddef>

namespace CGAL::PowerRTF {

struct Cell_summary {
  double mass = 0; ///< sum of m_i = rho_i A(F_i)
  Capacity_statistics capacity;
  double residual = 0;     ///< sum of |s_i - c_i|^2 over the usable cells
  double displacement = 0; ///< sum of |s_i - c_i|^2
  double counts[4] = {};   ///< by `Cell_status`
  int passes = 0;          ///< over the weights, of the last call for them
};

/// Sums up the current cells, for a backend's `reduce_twice()`: the first time for the mean of the
/// capacities, the second time for the deviations from it.
template <class Real>
struct Summary_rule {
  using First = Totals<7, 1>;
  using Second = Totals<3, 1>;

  Usable_cells<Real> cells;         ///< mean mass 0: that of these cells
  const Vec3<Real>* offset;         ///< c_i - s_i
  double tolerance;                 ///< gamma
  const unsigned char* is_left_out; ///< of the capacities; null: none is
  int n;
  const int* passes;    ///< null: none were made
  Cell_summary* result; ///< for the next steps
  Cell_summary* shared; ///< for the host

  CGAL_POWER_RTF_HD void add_first(int i, First& t) const
  {
    const double m = cells.capacity(i);
    t.add(0, m);
    t.add(1, squared_offset(i));
    for (int k = 0; k < 3; ++k) t.add(2 + k, cells.status[i] == k);
    if (!is_counted(i)) return;
    t.add(5, 1);
    t.add(6, m);
    t.raise(0, -m);
  }
  CGAL_POWER_RTF_HD Cell_summary middle(const First& t) const
  {
    Cell_summary s;
    s.mass = t.sum(0);
    s.displacement = t.sum(1);
    s.counts[3] = n;
    for (int k = 0; k < 3; ++k) s.counts[3] -= s.counts[k] = t.sum(2 + k);
    const double counted = t.sum(5);
    s.capacity.left_out = static_cast<std::size_t>(n - counted);
    s.capacity.mean = counted > 0 ? t.sum(6) / counted : 0;
    s.capacity.least = counted > 0 ? -t.maximum(0) : 0;
    return s;
  }
  CGAL_POWER_RTF_HD void add_second(int i, const Cell_summary& s, Second& t) const
  {
    Usable_cells<Real> c = cells;
    if (!(c.mean_mass > 0)) c.mean_mass = s.mass / n;
    if (c.is_usable(i)) t.add(2, squared_offset(i));
    if (!is_counted(i) || !(s.capacity.mean > 0)) return;
    const double deviation = std::fabs(cells.capacity(i) / s.capacity.mean - 1);
    t.add(0, deviation <= tolerance);
    t.add(1, deviation * deviation);
    t.raise(0, deviation);
  }
  CGAL_POWER_RTF_HD void finish(Cell_summary& s, const Second& t) const
  {
    s.residual = t.sum(2);
    Capacity_statistics& c = s.capacity;
    if (c.mean > 0) {
      const double counted = n - double(c.left_out);
      c.inside_interval = t.sum(0) / counted;
      c.rms = std::sqrt(t.sum(1) / counted);
      c.largest_deviation = t.maximum(0);
    }
    if (passes) s.passes = *passes;
    *result = *shared = s;
  }

private:
  CGAL_POWER_RTF_HD bool is_counted(int i) const { return !is_left_out || !is_left_out[i]; }
  CGAL_POWER_RTF_HD double squared_offset(int i) const
  {
    const double x = offset[i].x, y = offset[i].y, z = offset[i].z;
    return x * x + y * y + z * z;
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_CELL_SUMMARY_H
