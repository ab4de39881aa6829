// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points of a surface whose facets are in the order of a tree, for host and device: its vertices in
// that order, and samples spread by area.
#ifndef CGAL_POWER_RTF_GEOMETRY_AREA_SAMPLES_H
#define CGAL_POWER_RTF_GEOMETRY_AREA_SAMPLES_H

#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/internal/atomics.h>

#include <cmath>

namespace CGAL::PowerRTF::internal {

/// Writes the areas of n facets, and 0 at the end.
struct Facet_areas {
  const Facet_corners<double>* facets;
  int n;
  double* areas;

  CGAL_POWER_RTF_HD void operator()(int place) const
  {
    areas[place] = place < n ? length(normal(facets[place])) / 2 : 0;
  }

private:
  CGAL_POWER_RTF_HD static Vec3d normal(const Facet_corners<double>& f)
  {
    return cross(f.b - f.a, f.c - f.a);
  }
};

/// Which corners are the first ones of their vertices. `Vertex_of`: functor, corner -> vertex.
template <class Vertex_of>
struct First_corners {
  Vertex_of vertex_of;
  int* first; ///< of each vertex; before, more than all corners

  CGAL_POWER_RTF_HD void operator()(int corner) const
  {
    atomic_min(first + vertex_of(corner), corner);
  }
  CGAL_POWER_RTF_HD bool has(int corner) const { return first[vertex_of(corner)] == corner; }
};

/// `n` points that are spread evenly by area: every facet gets its share of them rounded up or
/// down, and they fill the facets as the R2 sequence fills a square.
struct Area_samples {
  const Facet_corners<double>* facets;
  const double* areas; ///< of the facets before each, and of all
  int number_of_facets, n;

  CGAL_POWER_RTF_HD Vec3d operator()(int i) const
  {
    const Facet_corners<double>& f = facets[place((i + 0.5) / n * areas[number_of_facets])];
    double s = fraction(0.5 + i * 0.7548776662466927), t = fraction(0.5 + i * 0.5698402909980532);
    if (s + t > 1) {
      s = 1 - s;
      t = 1 - t;
    }
    return f.a + s * (f.b - f.a) + t * (f.c - f.a);
  }

private:
  CGAL_POWER_RTF_HD static double fraction(double x) { return x - std::floor(x); }

  /// The last facet with no more area before it.
  CGAL_POWER_RTF_HD int place(double area) const
  {
    int low = 0, high = number_of_facets;
    while (high - low > 1) {
      const int middle = low + (high - low) / 2;
      (areas[middle] <= area ? low : high) = middle;
    }
    return low;
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_AREA_SAMPLES_H
