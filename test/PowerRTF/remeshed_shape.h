// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes before and after a run, and what every run has to meet. A file that includes this, and not
// the remesher, compiles fast.
#ifndef CGAL_POWER_RTF_TEST_REMESHED_SHAPE_H
#define CGAL_POWER_RTF_TEST_REMESHED_SHAPE_H

#include "shapes.h"

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/Remeshing_report.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace remeshed_shape {

using namespace CGAL::PowerRTF;
using shapes::Soup;

inline bool are_equal(const Soup& a, const Soup& b)
{
  return a.points == b.points && a.triangles == b.triangles;
}

inline double largest_distance(const Soup& a, const Soup& b)
{
  REQUIRE(a.points.size() == b.points.size());
  double largest = 0;
  for (std::size_t v = 0; v < a.points.size(); ++v)
    largest = std::max(largest, length(a.points[v] - b.points[v]));
  return largest;
}

inline double diagonal(const Soup& s)
{
  Vec3d lo = s.points[0], hi = lo;
  for (const Vec3d& p : s.points) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  return length(hi - lo);
}

inline Remeshing_options uniform()
{
  Remeshing_options options;
  options.density = Density::uniform;
  return options;
}

inline const Soup& torus()
{
  static const Soup soup = shapes::torus(60, 30, 1, 0.4);
  return soup;
}

inline const Soup& ellipsoid()
{
  static const Soup soup = shapes::ellipsoid(1, 0.7, 0.4, 3);
  return soup;
}

/// All that is promised is met; the message of a failure names what is not.
inline void check_guarantees(const Remeshing_report& report)
{
  std::string missed;
  for (const std::string& guarantee : report.missed_guarantees()) missed += guarantee + "; ";
  CHECK(missed == "");
}

struct Result {
  Soup soup;
  Remeshing_report report;
};

/// `power_rtf_remeshing()` from `Surface_mesh` to `Surface_mesh`; the output is valid.
Result remesh(const Soup& soup, std::size_t n, const Remeshing_options& options = {});

} // namespace remeshed_shape

#endif // CGAL_POWER_RTF_TEST_REMESHED_SHAPE_H
