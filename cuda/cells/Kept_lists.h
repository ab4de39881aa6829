// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lists of the sites around each cell that outlive changes of the weights, while the sites stay. A
// list is complete for a radius at the time when it is made; it stays so while weights have grown
// by less than the difference of that radius and the cell's own allows. This is decided anew for
// each cell.
//
// Proof. When the list of cell i is made, every compatible site j that is not listed has
//   d >= outside  and  d^2 - 2 d R_list > w0_j - w0_i                                       (*)
// (its plane passes beyond R_list). For a cell of radius R < R_list,
//   d^2 - 2 d R = (d^2 - 2 d R_list) + 2 d (R_list - R),
// so the plane of j passes beyond R as long as w_j - w_i has grown by no more than
// 2 outside (R_list - R). Growth is bounded over the groups of sites near the cell; for all others
// by that of all sites, with a larger radius.
#ifndef CGAL_POWER_RTF_CUDA_KEPT_LISTS_H
#define CGAL_POWER_RTF_CUDA_KEPT_LISTS_H

#include "Lane_cell.h"

namespace CGAL {
namespace PowerRTF {
namespace device {

/// What a construction does with the lists.
enum class List_use { none, make, read };

template <class Real>
struct Kept_lists {
  static constexpr int capacity = 24, most_groups = 32;
  static constexpr unsigned short none = 0xffff;

  int* neighbors = nullptr;         ///< entry k of the cell at a place: [k * stride + place]
  unsigned short* sizes = nullptr;  ///< entries + 256 * those that were edges, which come first
  Real* radius = nullptr;           ///< R_list
  Real* outside = nullptr;
  Real* weights = nullptr;          ///< when the lists were made
  int* groups = nullptr;            ///< near group k of a group: [group * most_groups + k]
  int* group_sizes = nullptr;       ///< -1: too many
  Real* group_radius = nullptr;     ///< groups that are not listed are beyond this, see (*)
  Real* growth = nullptr;     ///< of each group: the most that a weight has grown since, at least 0
  Real* all_growth = nullptr; ///< of all groups
  int stride = 0;
};

/// Whether the cell of radius `r`, made from a list, is proved to be complete. `own_growth`: of the
/// cell's weight; `near_growth`: the most in the groups listed.
template <class Real>
CGAL_POWER_RTF_HD inline bool list_suffices(Real r, Real list_radius, Real outside, Real far_radius,
                                            Real own_growth, Real near_growth, Real all_growth)
{
  const Real rounding = list_radius * (256 * internal::epsilon<Real>());
  const Real room = list_radius - r - rounding, far_room = far_radius - r - rounding;
  return room >= 0 && far_room >= 0 && 2 * outside * room >= near_growth - own_growth &&
         2 * far_radius * far_room >= all_growth - own_growth;
}

/// Keeps the list of a finished cell: its edges, then the other compatible sites.
template <class Real>
CGAL_POWER_RTF_HD inline void keep_list(const Kept_lists<Real>& lists, const Lane_cell<Real>& cell,
                                        const Ring_polygon<Real, 32>& polygon, const int* column)
{
  int* const out = lists.neighbors + cell.place;
  unsigned edges = 0;
  int size = 0;
  for (int k = 0; k < polygon.size; ++k) {
    const int number = polygon.edge(k);
    edges |= 1u << number;
    out[std::size_t(size++) * lists.stride] = column[number * 32];
  }
  for (int k = 0; k < cell.listed; ++k)
    if ((cell.compatible & ~edges) >> k & 1)
      out[std::size_t(size++) * lists.stride] = column[k * 32];
  lists.sizes[cell.place] = static_cast<unsigned short>(size + 256 * polygon.size);
  lists.radius[cell.place] = cell.radius;
  lists.outside[cell.place] = std::fmin(cell.radius, std::sqrt(cell.outside2));
}

/// A neighbour's line a x + b y <= c in the tangent frame.
template <class Real>
struct Tangent_line {
  Real a, b, c;
};

/// Clips the cell by the sites of its list. The former edges come in their order: usually they
/// still bound the cell, then their corners are its vertices. Returns false when it is not closed.
template <class Real>
CGAL_POWER_RTF_HD inline bool clip_kept(const Group_view<Real>& view, const Kept_lists<Real>& lists,
                                        const Lane_cell<Real>& cell,
                                        const Tangent_frame<Real>& frame, Real list_radius,
                                        int sizes, Ring_polygon<Real, 32>& polygon)
{
  const int size = sizes & 255, edges = sizes >> 8;
  const auto line = [&](int k) {
    const int j = lists.neighbors[std::size_t(k) * lists.stride + cell.place];
    const Packed_site<Real> other = load(view.sites + j);
    const Vec3<Real> offset = other.point - cell.site.point;
    const Real power = squared_length(offset) + (cell.site.weight - other.weight);
    return Tangent_line<Real>{dot(offset, frame.u), dot(offset, frame.v), power / 2};
  };

  // Several lines at a time, so that their loads wait together.
  const auto for_each_line = [&](auto&& f) {
    constexpr int at_once = 4;
    for (int first = 0; first < size; first += at_once) {
      Tangent_line<Real> lines[at_once];
#ifdef __CUDA_ARCH__
#pragma unroll
#endif
      for (int k = 0; k < at_once; ++k)
        if (first + k < size) lines[k] = line(first + k);
#ifdef __CUDA_ARCH__
#pragma unroll
#endif
      for (int k = 0; k < at_once; ++k)
        if (first + k < size) f(first + k, lines[k]);
    }
  };

  // A closed chain of left turns that goes round once, each edge in its line's direction, bounds
  // the intersection of its half-planes.
  bool is_chain = edges >= 3;
  if (is_chain) {
    Tangent_line<Real> last = line(edges - 1);
    Real first_x = 0, first_y = 0, last_x = 0, last_y = 0;
    int rounds = 0;
    const auto is_forward = [](const Tangent_line<Real>& l, Real dx, Real dy) {
      return l.a * dy - l.b * dx > 0;
    };
    for_each_line([&](int k, const Tangent_line<Real>& l) {
      if (!is_chain) return;
      if (k >= edges) {
        polygon.clip(l.a, l.b, l.c, k);
        return;
      }
      const Real turn = last.a * l.b - last.b * l.a;
      const Real squares = (last.a * last.a + last.b * last.b) * (l.a * l.a + l.b * l.b);
      is_chain = turn > 0 && turn * turn > Real(0.01) * squares;
      rounds += last.b < 0 && l.b >= 0;
      const Real inverse = quick_quotient(Real(1), turn);
      const Real x = (last.c * l.b - last.b * l.c) * inverse;
      const Real y = (last.a * l.c - last.c * l.a) * inverse;
      if (k == 0) {
        first_x = x;
        first_y = y;
      } else {
        is_chain = is_chain && is_forward(last, x - last_x, y - last_y);
      }
      polygon.set_vertex(k, x, y, k);
      last = l;
      last_x = x;
      last_y = y;
      if (k == edges - 1) {
        is_chain = is_chain && rounds == 1 && is_forward(last, first_x - last_x, first_y - last_y);
        polygon.set_size(edges);
      }
    });
  }
  if (!is_chain) {
    polygon.set_square(list_radius);
    for_each_line([&](int k, const Tangent_line<Real>& l) {
      polygon.clip(l.a, l.b, l.c, k);
    });
  }
  return polygon.size > 0 && !polygon.overflow && !polygon.touches_square();
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_KEPT_LISTS_H
