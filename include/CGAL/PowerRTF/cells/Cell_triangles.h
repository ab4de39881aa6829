// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles that the neighbors of cells make with their samples, and what is asked of them.
#ifndef CGAL_POWER_RTF_CELLS_CELL_TRIANGLES_H
#define CGAL_POWER_RTF_CELLS_CELL_TRIANGLES_H

#include <CGAL/PowerRTF/geometry/Surface_walk.h>
#include <CGAL/PowerRTF/internal/host_device.h>

#include <cstddef>

namespace CGAL::PowerRTF {

/// Two neighbors that follow each other around a cell make a triangle with its sample. Non-owning.
struct Cell_triangles {
  static constexpr double worst_agreement = 0.1, fold = -0.7; ///< cosines; see `Edge_flipper`

  int cells, samples;       ///< those with cells come first
  const std::size_t* first; ///< as of `Neighbor_cycles`
  const int* neighbors;     ///< samples; negative: a side of the guard square
  const Vec3d *points, *normals;
  const int* facets; ///< of the samples

  CGAL_POWER_RTF_HD int size(int i) const { return static_cast<int>(first[i + 1] - first[i]); }
  CGAL_POWER_RTF_HD const int* around(int i) const { return neighbors + first[i]; }
  /// The corners of triangle k of cell i, beside its sample.
  CGAL_POWER_RTF_HD int from(int i, int k) const { return around(i)[k]; }
  CGAL_POWER_RTF_HD int to(int i, int k) const { return around(i)[k + 1 < size(i) ? k + 1 : 0]; }

  /// Whether `a` is followed by `b` around cell i; a sample without a cell agrees.
  CGAL_POWER_RTF_HD bool has(int i, int a, int b) const
  {
    if (i >= cells) return true;
    for (int k = 0; k < size(i); ++k)
      if (from(i, k) == a && to(i, k) == b) return true;
    return false;
  }

  /// Whether the cells at the corners of triangle k of cell i have it, too.
  CGAL_POWER_RTF_HD bool is_agreed(int i, int k) const
  {
    const int a = from(i, k), b = to(i, k);
    return a >= 0 && b >= 0 && a != b && has(a, b, i) && has(b, i, a);
  }

  /// Whether no neighbor comes twice, and there are three or more.
  CGAL_POWER_RTF_HD bool are_distinct(int i) const
  {
    const int* const w = around(i);
    const int n = size(i);
    for (int k = 0; k < n; ++k)
      for (int l = 0; l < k; ++l)
        if (w[k] == w[l]) return false;
    return n >= 3;
  }

  /// Whether a short way along the surface joins two samples with cells.
  CGAL_POWER_RTF_HD bool are_neighbors(const Surface_facets& surface, int v, int w) const
  {
    const Vec3d p = points[v], q = points[w], up = normals[v] + normals[w];
    const double scale = length(q - p);
    const auto joins = [&](const Vec3d& start, int facet, const Vec3d& goal, int end) {
      const internal::Surface_walk walk(surface, start, goal, up);
      return walk.leads_to(facet, [end](int f) { return f == end; }) || // mostly
             walk.leads_to(
                 facet, [&](int f) { return internal::holds_point(surface, f, goal, end, scale); });
    };
    return joins(p, facets[v], q, facets[w]) || joins(q, facets[w], p, facets[v]);
  }

  /// Whether the triangles of cell i agree with the normals at their corners, none is folded onto
  /// the next one, and their edges join neighbors along the surface.
  /// \param for_each_corner `for_each_corner(f)` calls `f(a, b)` for the other corners of each
  /// \param are_neighbors whether `i` and another sample with a larger number are
  template <class For_each_corner, class Are_neighbors>
  CGAL_POWER_RTF_HD bool lies_well(int i, const For_each_corner& for_each_corner,
                                   const Are_neighbors& are_neighbors) const
  {
    Vec3d start{0, 0, 0}, last{0, 0, 0};
    bool good = true;
    const Vec3d p = points[i];
    for_each_corner([&](int a, int b) {
      const Vec3d n = normalized(cross(points[a] - p, points[b] - p));
      const int corners[3] = {i, a, b};
      for (const int w : corners)
        if (w < cells) good = good && dot(n, normals[w]) > worst_agreement;
      good = good && squared_length(n) > 0 && dot(n, last) > fold;
      if (squared_length(last) == 0) start = n;
      last = n;
      if (i < a) good = good && are_neighbors(a);
    });
    return good && dot(start, last) > fold;
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_CELL_TRIANGLES_H
