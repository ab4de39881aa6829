// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the construction of the cells reads and writes: plain arrays, all in the order of the
// engine.
#ifndef CGAL_POWER_RTF_CELLS_CELL_ARRAYS_H
#define CGAL_POWER_RTF_CELLS_CELL_ARRAYS_H

#include <CGAL/PowerRTF/cells/cell_moments.h>
#include <CGAL/PowerRTF/cells/clip_at_features.h>
#include <CGAL/PowerRTF/cells/construct_cell.h>

#include <cmath>
#include <cstddef>

namespace CGAL::PowerRTF {

/// The sites 0 .. cells - 1 have cells; those from there to `sites` - 1 only clip.
template <class Real>
struct Sites_arrays {
  const Site<Real>* sites = nullptr;   ///< points and weights
  const Vec3<Real>* normals = nullptr; ///< unit
  /// Cube root of the density that weights the centroids.
  const Real* density_root = nullptr;
  /// Only sites of the same patch are compatible; null: all are of one.
  const int* patches = nullptr;
  /// The site after and before each fixed site on its patch's boundary, -1: none; see
  /// `clip_at_features()`. Null: there are none.
  const int *next = nullptr, *previous = nullptr;
  int cells = 0, sites_size = 0;
};

/// The radius R with which the search for neighbors begins: of n sites, spread evenly over `area`,
/// a ball of radius 2 R holds so many.
inline double first_search_radius(int neighbors, double area, int n)
{
  return std::sqrt(neighbors * area / (4 * 3.14159265358979 * n));
}

/// One entry per cell; a null pointer: not wanted.
template <class Real>
struct Cell_outputs {
  Real* area = nullptr;            ///< A(F_i); this and all below: of its part on the patch
  Real* mass = nullptr;            ///< integral of the density that weights the centroids
  Vec3<Real>* offset = nullptr;    ///< c_i - s_i
  unsigned char* status = nullptr; ///< a `Cell_status`
  int* edge_count = nullptr;       ///< edges with a neighbor, at most `edge_capacity`
  int* edge_neighbor = nullptr;    ///< edge k of cell i: [k * cells + i]
  float* edge_ratio = nullptr;     ///< its length over the tangential distance of the neighbor
  int edge_capacity = 0;
};

/// The sites as the shared functors see them, without a tree: enough for what follows a search.
template <class Real>
CGAL_POWER_RTF_HD inline Sites_view<Real> view_without_tree(const Sites_arrays<Real>& in)
{
  Sites_view<Real> view;
  view.sites = in.sites;
  view.normals = in.normals;
  view.patches = in.patches;
  return view;
}

/// Writes what a cell's polygon says where `out` asks for it.
template <class Real, class Polygon>
CGAL_POWER_RTF_HD inline void
write_polygon(const Sites_arrays<Real>& in, const Cell_outputs<Real>& out, int i,
              Cell_status status, const Polygon& polygon, const Tangent_frame<Real>& frame)
{
  const Cell_moments<Real> m = cell_moments(polygon, i, [&](int j) { return in.density_root[j]; });
  if (out.area) out.area[i] = m.area;
  if (out.mass) out.mass[i] = m.mass;
  if (out.offset) out.offset[i] = frame.u * m.x + frame.v * m.y;
  if (out.status) out.status[i] = static_cast<unsigned char>(status);
  if (!out.edge_count) return;
  int count = 0;
  for (int k = 0; k < polygon.size && count < out.edge_capacity; ++k) {
    const int j = polygon.neighbor[k], l = polygon.next(k);
    if (j < 0) continue;
    const Vec3<Real> offset = in.sites[j].point - in.sites[i].point;
    const Real a = dot(offset, frame.u), b = dot(offset, frame.v);
    const Real x = polygon.x[l] - polygon.x[k], y = polygon.y[l] - polygon.y[k];
    out.edge_neighbor[std::size_t(count) * in.cells + i] = j;
    out.edge_ratio[std::size_t(count++) * in.cells + i] =
        float(std::sqrt((x * x + y * y) / (a * a + b * b)));
  }
  out.edge_count[i] = count;
}

/// The same for the part of the polygon that lies on the site's patch.
template <class Real, class Polygon>
CGAL_POWER_RTF_HD inline void write_cell(const Sites_arrays<Real>& in,
                                         const Cell_outputs<Real>& out, int i, Cell_status status,
                                         const Polygon& polygon, const Tangent_frame<Real>& frame)
{
  if (!in.next || polygon.size > Tangent_polygon<Real>::capacity)
    return write_polygon(in, out, i, status, polygon, frame);
  Tangent_polygon<Real> part;
  part.size = polygon.size;
  for (int k = 0; k < polygon.size; ++k) {
    part.x[k] = polygon.x[k];
    part.y[k] = polygon.y[k];
    part.neighbor[k] = polygon.neighbor[k];
  }
  clip_at_features(view_without_tree(in), i, in.next, in.previous, frame, part);
  write_polygon(in, out, i, status, part, frame);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_CELL_ARRAYS_H
