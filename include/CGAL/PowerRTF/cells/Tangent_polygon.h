// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The convex polygon of a cell F_i in the frame of its tangent plane, with the site at the origin.
// Because (intersection of half-spaces) with a plane = intersection of (half-spaces with the
// plane), the cell is clipped directly in 2D and no 3D power cell is ever built (Section 4.1).
#ifndef CGAL_POWER_RTF_CELLS_TANGENT_POLYGON_H
#define CGAL_POWER_RTF_CELLS_TANGENT_POLYGON_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/Tangent_frame.h>

namespace CGAL::PowerRTF {

/// A convex polygon, counter-clockwise; edge k runs from vertex k to vertex k + 1 and carries the
/// neighbor that made it, or -1 .. -4 for a side of the initial square.
template <class FT>
struct Tangent_polygon {
  using Number = FT;
  static constexpr int capacity = 64;

  int size = 0;
  bool overflow = false; ///< a cut was lost because the polygon was full
  FT x[capacity], y[capacity];
  int neighbor[capacity];

  /// The square [-half, half]^2.
  CGAL_POWER_RTF_HD void set_square(FT half)
  {
    size = 4;
    overflow = false;
    const FT sx[4] = {half, half, -half, -half}, sy[4] = {-half, half, half, -half};
    for (int k = 0; k < 4; ++k) {
      x[k] = sx[k];
      y[k] = sy[k];
      neighbor[k] = -1 - k;
    }
  }

  /// Vertex by vertex; `neighbor` is the caller's.
  CGAL_POWER_RTF_HD void begin_chain() { overflow = false; }
  CGAL_POWER_RTF_HD void set_chain_vertex(int k, FT vertex_x, FT vertex_y)
  {
    x[k] = vertex_x;
    y[k] = vertex_y;
  }
  CGAL_POWER_RTF_HD void end_chain(int vertices) { size = vertices; }
  CGAL_POWER_RTF_HD static FT quotient(FT a, FT b) { return a / b; }
  /// Whether a x + b y <= c for all vertices.
  CGAL_POWER_RTF_HD bool is_chain_inside(FT a, FT b, FT c) const
  {
    FT most = a * x[0] + b * y[0];
    for (int k = 1; k < size; ++k) most = internal::larger(most, a * x[k] + b * y[k]);
    return !(most > c);
  }

  /// Squared distance of the farthest vertex from the site: the squared security radius R^2.
  CGAL_POWER_RTF_HD FT squared_radius() const
  {
    FT r = 0;
    for (int k = 0; k < size; ++k) {
      const FT d = x[k] * x[k] + y[k] * y[k];
      if (d > r) r = d;
    }
    return r;
  }

  CGAL_POWER_RTF_HD bool touches_square() const
  {
    for (int k = 0; k < size; ++k)
      if (neighbor[k] < 0) return true;
    return false;
  }

  CGAL_POWER_RTF_HD int next(int k) const { return k + 1 < size ? k + 1 : 0; }
  CGAL_POWER_RTF_HD int previous(int k) const { return k > 0 ? k - 1 : size - 1; }

  /// Keeps a x + b y <= c; the new edge belongs to neighbor `j`. Returns whether it cut.
  CGAL_POWER_RTF_HD bool clip(FT a, FT b, FT c, int j);

private:
  /// Puts an edge of neighbor `j` in place of the `removed` vertices `begin` to `end`; `s`: the
  /// signed distances of all vertices from its line.
  CGAL_POWER_RTF_HD void replace(int begin, int end, int removed, const FT* s, int j);
};

template <class FT>
CGAL_POWER_RTF_HD inline bool Tangent_polygon<FT>::clip(FT a, FT b, FT c, int j)
{
  FT s[capacity], largest = 0; // > 0: outside
  int worst = -1;
  for (int k = 0; k < size; ++k) {
    s[k] = a * x[k] + b * y[k] - c;
    if (s[k] > largest) {
      largest = s[k];
      worst = k;
    }
  }
  if (worst < 0) return false;

  // The removed vertices form one chain around the worst one (taken so even where rounding says
  // otherwise: the polygon stays a polygon).
  int begin = worst, end = worst, removed = 1;
  while (removed < size && s[previous(begin)] > 0) {
    begin = previous(begin);
    ++removed;
  }
  while (removed < size && s[next(end)] > 0) {
    end = next(end);
    ++removed;
  }
  if (removed == size) {
    size = 0;
    return true;
  }
  if (size - removed + 2 > capacity) {
    overflow = true;
    return false;
  }

  replace(begin, end, removed, s, j);
  return true;
}

template <class FT>
CGAL_POWER_RTF_HD inline void Tangent_polygon<FT>::replace(int begin, int end, int removed,
                                                           const FT* s, int j)
{
  const int in = previous(begin), out = next(end);
  const FT ti = s[in] / (s[in] - s[begin]), to = s[out] / (s[out] - s[end]);
  const FT px = x[in] + ti * (x[begin] - x[in]), py = y[in] + ti * (y[begin] - y[in]);
  const FT qx = x[out] + to * (x[end] - x[out]), qy = y[out] + to * (y[end] - y[out]);
  const int exit_neighbor = neighbor[end];

  const auto move = [&](int to, int from) {
    x[to] = x[from];
    y[to] = y[from];
    neighbor[to] = neighbor[from];
  };
  // New polygon: the kept vertices out .. in, then p (edge j), then q (the edge that q lies on).
  const int kept = size - removed;
  const auto put = [&](int place) {
    x[place] = px;
    y[place] = py;
    neighbor[place] = j;
    x[place + 1] = qx;
    y[place + 1] = qy;
    neighbor[place + 1] = exit_neighbor;
    size = kept + 2;
  };
  if (out <= in) { // the kept chain does not wrap around: move it to the front
    if (out > 0)
      for (int k = 0; k < kept; ++k) move(k, out + k);
    return put(kept);
  }
  // The removed chain lies inside the array: close (or open) the gap to two places.
  const int tail = size - out, to_place = begin + 2;
  if (to_place < out)
    for (int k = 0; k < tail; ++k) move(to_place + k, out + k);
  else if (to_place > out)
    for (int k = tail - 1; k >= 0; --k) move(to_place + k, out + k);
  put(begin);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_TANGENT_POLYGON_H
