// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where triangles of a mesh may be bad: at few vertices, that are left to be looked at closely.
#ifndef CGAL_POWER_RTF_SMOOTHING_DOUBTFUL_STARS_H
#define CGAL_POWER_RTF_SMOOTHING_DOUBTFUL_STARS_H

#include <CGAL/PowerRTF/smoothing/Star_view.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

namespace CGAL::PowerRTF::internal {

/// A triangle that may be bad has a doubtful corner: the first one, or one that does not move, as
/// of those nothing is known.
struct Find_doubtful_stars {
  Star_view stars;
  unsigned char* is_doubtful; ///< by vertex

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    is_doubtful[v] = !stars.is_movable(v) || !is_fine(v);
  }

private:
  // The energies of an equilateral triangle, and of one that is surely good.
  static constexpr double least_energy = 3.4641016151377544,
                          good_energy = least_energy * Triangle_badness::surely_good;

  CGAL_POWER_RTF_HD bool is_fine(int v) const
  {
    const Vec3d p = stars.point(v);
    for (int k = stars.first[v]; k < stars.first[v + 1]; ++k) {
      const int a = stars.neighbors[k], b = stars.neighbors[stars.next_spoke(v, k)];
      if (v < a && v < b && !(shape_energy(p, stars.point(a), stars.point(b)) < good_energy))
        return false;
    }
    return true;
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_DOUBTFUL_STARS_H
