// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cells end at the boundary of their patch: where a cell reaches over the chord between two
// consecutive samples on a crease or border, it is cut along that chord.
#ifndef CGAL_POWER_RTF_CELLS_CLIP_AT_FEATURES_H
#define CGAL_POWER_RTF_CELLS_CLIP_AT_FEATURES_H

#include <CGAL/PowerRTF/cells/Sites_view.h>
#include <CGAL/PowerRTF/cells/Tangent_polygon.h>

namespace CGAL::PowerRTF {
namespace internal {

/// Whether the segment from (ax, ay) to (bx, by) passes through the inside of the polygon.
template <class FT>
CGAL_POWER_RTF_HD inline bool crosses_polygon(const Tangent_polygon<FT>& polygon, FT ax, FT ay,
                                              FT bx, FT by)
{
  FT begin = 0, end = 1; // what the sides of the polygon leave of the segment
  for (int k = 0; k < polygon.size; ++k) {
    const int l = polygon.next(k);
    const FT ex = polygon.x[l] - polygon.x[k], ey = polygon.y[l] - polygon.y[k];
    const FT a = ex * (ay - polygon.y[k]) - ey * (ax - polygon.x[k]); // > 0: inside this side
    const FT b = ex * (by - polygon.y[k]) - ey * (bx - polygon.x[k]);
    if (a <= 0 && b <= 0) return false;
    const FT t = a / (a - b);
    if (a < 0 && t > begin) begin = t;
    if (b < 0 && t < end) end = t;
  }
  return begin < end;
}

} // namespace internal

/// Clips cell `i` at the chords that start or end at a neighbor of it. `next` and `previous`: for
/// each site the one after and before it on its patch's boundary, the patch to the left; -1: none.
/// Returns whether anything was cut; a cell that would vanish stays as it is.
template <class FT>
CGAL_POWER_RTF_HD inline bool clip_at_features(const Sites_view<FT>& view, int i, const int* next,
                                               const int* previous, const Tangent_frame<FT>& frame,
                                               Tangent_polygon<FT>& polygon)
{
  constexpr FT sagitta = FT(0.2);                // of a chord, over its length
  int chords[2 * Tangent_polygon<FT>::capacity]; // by their first site
  int size = 0;
  for (int k = 0; k < polygon.size; ++k) {
    const int j = polygon.neighbor[k];
    if (j < 0 || next[j] < 0) continue;
    chords[size++] = j;
    chords[size++] = previous[j];
  }
  if (size == 0) return false;
  const Tangent_polygon<FT> whole = polygon;
  bool cut = false;
  for (int c = 0; c < size; ++c) {
    const Vec3<FT> a = view.sites[chords[c]].point - view.sites[i].point;
    const Vec3<FT> b = view.sites[next[chords[c]]].point - view.sites[i].point;
    const FT ax = dot(a, frame.u), ay = dot(a, frame.v), bx = dot(b, frame.u), by = dot(b, frame.v);
    if (!internal::crosses_polygon(whole, ax, ay, bx, by)) continue;
    // Left of a -> b: (bx - ax) (y - ay) - (by - ay) (x - ax) >= 0. A site may be a little outside,
    // between the chord and its curve; if it is farther, the chord is the other side of a slit.
    const FT nx = by - ay, ny = ax - bx, outside = -(nx * ax + ny * ay);
    if (outside > sagitta * (nx * nx + ny * ny)) continue;
    if (polygon.clip(nx, ny, nx * ax + ny * ay, -1)) cut = true;
    if (polygon.size == 0) {
      polygon = whole;
      return false;
    }
  }
  return cut;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_CLIP_AT_FEATURES_H
