// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Area, mass and center of mass of a cell's polygon.
#ifndef CGAL_POWER_RTF_CELLS_CELL_MOMENTS_H
#define CGAL_POWER_RTF_CELLS_CELL_MOMENTS_H

#include <CGAL/PowerRTF/cells/Tangent_polygon.h>

namespace CGAL::PowerRTF {

template <class FT>
struct Cell_moments {
  FT area = 0;     ///< A(F_i)
  FT mass = 0;     ///< integral of the density
  FT x = 0, y = 0; ///< center of mass in the tangent frame, relative to the site
};

/// Moments of cell `i` for the density that is linear on each triangle of the fan around the site.
/// The density at a polygon vertex is the geometric mean of its three sites' densities;
/// `root(j)` is the cube root of the density of site `j`. `Polygon`: `Tangent_polygon`, or another
/// with its members `Number`, `size`, `x`, `y`, `neighbor` and `next()`.
template <class Polygon, class Root, class FT = typename Polygon::Number>
CGAL_POWER_RTF_HD inline Cell_moments<FT> cell_moments(const Polygon& polygon, int i, Root&& root)
{
  Cell_moments<FT> m;
  const int n = polygon.size;
  if (n < 3) return m;
  const FT own = root(i), at_site = own * own * own;
  const auto side = [&](int k) {
    const int j = polygon.neighbor[k];
    return j < 0 ? own : root(j);
  };
  FT first_side = side(0), last_side = side(n - 1);
  const FT first_density = own * last_side * first_side;
  FT side_k = first_side, density = first_density, x = 0, y = 0;
  for (int k = 0; k < n; ++k) { // the triangle (site, vertex k, vertex k + 1)
    const int l = polygon.next(k);
    const FT side_l = l == 0 ? first_side : side(l);
    const FT density_l = l == 0 ? first_density : own * side_k * side_l;
    const FT xk = polygon.x[k], yk = polygon.y[k], xl = polygon.x[l], yl = polygon.y[l];
    const FT area = (xk * yl - xl * yk) / 2;
    const FT sum = at_site + density + density_l;
    m.area += area;
    m.mass += area * sum / 3;
    // int rho p = area / 12 * sum over corners of (sum + rho_corner) p_corner; the site is at 0.
    x += area * ((sum + density) * xk + (sum + density_l) * xl) / 12;
    y += area * ((sum + density) * yk + (sum + density_l) * yl) / 12;
    side_k = side_l;
    density = density_l;
  }
  if (m.mass > 0) {
    m.x = x / m.mass;
    m.y = y / m.mass;
  }
  return m;
}

/// Moments for the constant density 1.
template <class Polygon, class FT = typename Polygon::Number>
CGAL_POWER_RTF_HD inline Cell_moments<FT> cell_moments(const Polygon& polygon)
{
  return cell_moments(polygon, 0, [](int) { return FT(1); });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_CELL_MOMENTS_H
