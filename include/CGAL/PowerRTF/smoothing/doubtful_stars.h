// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where triangles of a mesh may be bad, or flips of edges lower the sum of the inverse mean ratios:
// at few vertices, that are left to be looked at closely.
#ifndef CGAL_POWER_RTF_SMOOTHING_DOUBTFUL_STARS_H
#define CGAL_POWER_RTF_SMOOTHING_DOUBTFUL_STARS_H

#include <CGAL/PowerRTF/smoothing/Star_view.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

namespace CGAL::PowerRTF::internal {

/// A triangle that may be bad has a doubtful corner; so has one of the two at an edge of which a
/// flip may help. It is the first one that finds it, or does not move: of those nothing is known.
struct Find_doubtful_stars {
  Star_view stars;
  unsigned char* is_doubtful; ///< by vertex

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    is_doubtful[v] = !stars.is_movable(v) || !is_fine(v);
  }

private:
  // The energies of an equilateral triangle, and of one that is surely good. A triangle that is not
  // acute has at least the energy 4: a flip that makes one does not help two good triangles.
  static constexpr double least_energy = 3.4641016151377544,
                          good_energy = least_energy * Triangle_badness::surely_good;
  static_assert(4 + least_energy > 2 * good_energy);

  CGAL_POWER_RTF_HD bool is_fine(int v) const
  {
    const Vec3d p = stars.point(v);
    for (int k = stars.first[v]; k < stars.first[v + 1]; ++k) {
      const int next = stars.next_spoke(v, k), a = stars.neighbors[k], b = stars.neighbors[next],
                c = stars.neighbors[stars.next_spoke(v, next)];
      if (b < v) continue;
      const Vec3d pa = stars.point(a);
      if (v < a && !(shape_energy(p, pa, stars.point(b)) < good_energy)) return false;
      if (dot(pa - p, stars.point(c) - p) > 0) return false;
    }
    return true;
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_DOUBTFUL_STARS_H
