// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Verlet (neighbor) lists: the sites around each cell, reused while the sites stay and only weights
// change. A list is complete for a radius larger than the cell's; it remains complete while the
// growth of the weights is less than the difference of the radii allows. This is decided for each
// cell.
//
// Proof. When the list of cell i is made, every compatible site j that is not listed has
//   d >= outside  and  d^2 - 2 d R_list > w0_j - w0_i                                       (*)
// (its plane passes beyond R_list). For a cell of radius R < R_list,
//   d^2 - 2 d R = (d^2 - 2 d R_list) + 2 d (R_list - R),
// so the plane of j passes beyond R as long as w_j - w_i has grown by no more than
// 2 outside (R_list - R). Growth is bounded over the groups of sites near the cell; for all others
// by that of all sites, with a larger radius.
#ifndef CGAL_POWER_RTF_CUDA_VERLET_LISTS_H
#define CGAL_POWER_RTF_CUDA_VERLET_LISTS_H

#include "Lane_cell.h"

#include <CGAL/PowerRTF/cells/Edge_chain.h>

namespace CGAL::PowerRTF::device {

template <class Real>
struct Verlet_lists {
  static constexpr int capacity = 24, max_groups = 32;
  /// Changes of the weights from which on new lists are made: a list's radius grows too short.
  static constexpr unsigned max_changes = 10;
  static constexpr unsigned short none = 0xffff;

  int* neighbors = nullptr;        ///< entry k of the cell at a place: [k * stride + place]
  unsigned short* sizes = nullptr; ///< entries + 256 * edges of the last cell, which come first
  Real* radius = nullptr;          ///< R_list
  Real* outside = nullptr;
  Real* weights = nullptr;      ///< when the lists were made
  int* groups = nullptr;        ///< near group k of a group: [group * max_groups + k]
  int* group_sizes = nullptr;   ///< -1: too many
  Real* group_radius = nullptr; ///< groups that are not listed are beyond this, see (*)
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

/// Makes the lines of a cell from its list.
template <class Real>
class Line_reader {
public:
  CGAL_POWER_RTF_HD Line_reader(const Group_view<Real>& view, const Verlet_lists<Real>& lists,
                                const Lane_cell<Real>& cell, const Tangent_frame<Real>& frame)
      : m_sites(view.sites), m_column(lists.neighbors + cell.place), m_stride(lists.stride),
        m_cell(cell), m_frame(frame)
  {}

  /// Places of the entries `first`, `first` + 1, ..; from `end` on the cell's own.
  template <int N>
  CGAL_POWER_RTF_HD void places(int first, int end, int (&out)[N]) const
  {
    CGAL_POWER_RTF_UNROLL
    for (int k = 0; k < N; ++k)
      out[k] = first + k < end ? m_column[std::size_t(first + k) * m_stride] : m_cell.place;
  }
  template <int N>
  CGAL_POWER_RTF_HD void sites(const int (&at)[N], Packed_site<Real> (&out)[N]) const
  {
    CGAL_POWER_RTF_UNROLL
    for (int k = 0; k < N; ++k) out[k] = load(m_sites + at[k]);
  }
  CGAL_POWER_RTF_HD Edge_line<Real> line(const Packed_site<Real>& other) const
  {
    const Vec3<Real> offset = other.point - m_cell.site.point;
    const Real d2 = squared_length(offset);
    const auto [a, b] = m_frame.components(offset, d2);
    return {a, b, (d2 + (m_cell.site.weight - other.weight)) / 2};
  }

private:
  const Packed_site<Real>* m_sites;
  const int* m_column;
  int m_stride;
  const Lane_cell<Real>& m_cell;
  const Tangent_frame<Real>& m_frame;
};

/// The cell whose edges are still the former ones, in their order: then their corners are its
/// vertices, and all other lines of the list pass outside. Returns whether that is so.
template <bool WithMoments, class Real>
CGAL_POWER_RTF_HD inline bool
clip_chain(const Group_view<Real>& view, const Verlet_lists<Real>& lists,
           const Lane_cell<Real>& cell, const Tangent_frame<Real>& frame, int sizes,
           Ring_polygon<Real, 32>& polygon, Chain_result<Real>& result)
{
  constexpr int edges_at_once = 8, at_once = 4; // places and sites whose loads wait together
  const int size = sizes & 255, edges = sizes >> 8;
  if (edges < 3) return false;
  const Line_reader<Real> reader(view, lists, cell, frame);
  const auto root = [&](int place) { return WithMoments ? view.density_root[place] : Real(1); };
  int other_places[at_once];
  reader.places(edges, size, other_places);

  Edge_chain<Ring_polygon<Real, 32>, WithMoments> walk(polygon, root(cell.place));
  for (int first = 0; first < edges; first += edges_at_once) {
    int places[edges_at_once];
    reader.places(first, edges, places);
    CGAL_POWER_RTF_UNROLL
    for (int half = 0; half < edges_at_once; half += at_once) {
      Packed_site<Real> sites[at_once];
      Real roots[at_once];
      CGAL_POWER_RTF_UNROLL
      for (int k = 0; k < at_once; ++k) {
        sites[k] = load(view.sites + places[half + k]);
        roots[k] = root(places[half + k]);
      }
      CGAL_POWER_RTF_UNROLL
      for (int k = 0; k < at_once; ++k)
        if (first + half + k < edges) walk.add(first + half + k, reader.line(sites[k]), roots[k]);
    }
  }
  bool is_chain = walk.close(edges);
  result = walk.result();

  for (int first = edges; is_chain && first < size; first += at_once) {
    if (first > edges) reader.places(first, size, other_places);
    Packed_site<Real> sites[at_once];
    reader.sites(other_places, sites);
    CGAL_POWER_RTF_UNROLL
    for (int k = 0; k < at_once; ++k) {
      if (first + k >= size) continue;
      const Edge_line<Real> l = reader.line(sites[k]);
      const Real t2 = l.a * l.a + l.b * l.b;
      const bool is_far = l.c > 0 && l.c * l.c > result.radius2 * t2;
      if (!is_far) is_chain = is_chain && t2 > 0 && polygon.is_chain_inside(l.a, l.b, l.c);
    }
  }
  return is_chain;
}

/// The cell by all lines of its list, whatever their order. Returns whether it is closed.
template <class Real>
CGAL_POWER_RTF_HD inline bool
clip_entries(const Group_view<Real>& view, const Verlet_lists<Real>& lists,
             const Lane_cell<Real>& cell, const Tangent_frame<Real>& frame, Real list_radius,
             int sizes, Ring_polygon<Real, 32>& polygon)
{
  constexpr int at_once = 4; // their loads wait together
  const int size = sizes & 255;
  const Line_reader<Real> reader(view, lists, cell, frame);
  polygon.set_square(list_radius);
  for (int first = 0; first < size; first += at_once) {
    int places[at_once];
    Packed_site<Real> sites[at_once];
    reader.places(first, size, places);
    reader.sites(places, sites);
    CGAL_POWER_RTF_UNROLL
    for (int k = 0; k < at_once; ++k) {
      if (first + k >= size) continue;
      const Edge_line<Real> l = reader.line(sites[k]);
      if (l.a * l.a + l.b * l.b > 0)
        polygon.clip(l.a, l.b, l.c, first + k);
      else if (!(l.c > 0))
        polygon.clear(); // a duplicate, or a parallel plane
    }
  }
  return polygon.size > 0 && !polygon.overflow && !polygon.touches_square();
}

/// Brings the edges of the cell's polygon to the front of its list, in their order.
template <class Real>
CGAL_POWER_RTF_HD inline void reorder_list(const Verlet_lists<Real>& lists, int place,
                                           const Ring_polygon<Real, 32>& polygon)
{
  const int size = lists.sizes[place] & 255;
  int* const out = lists.neighbors + place;
  int entries[Verlet_lists<Real>::capacity];
  for (int k = 0; k < size; ++k) entries[k] = out[k * std::size_t(lists.stride)];
  unsigned edges = 0;
  int at = 0;
  for (int k = 0; k < polygon.size; ++k) {
    edges |= 1u << polygon.edge(k);
    out[at++ * std::size_t(lists.stride)] = entries[polygon.edge(k)];
  }
  for (int k = 0; k < size; ++k)
    if (!(edges >> k & 1)) out[at++ * std::size_t(lists.stride)] = entries[k];
  lists.sizes[place] = static_cast<unsigned short>(size + 256 * polygon.size);
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_VERLET_LISTS_H
