// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cell by the sites that are gathered for it, on the host: what lists of the device are made of
// and compared with.
#ifndef CGAL_POWER_RTF_CUDA_LISTED_CELLS_H
#define CGAL_POWER_RTF_CUDA_LISTED_CELLS_H

#include "../cells/Verlet_lists.h"

namespace CGAL::PowerRTF::device {

/// Lists those of the `count` gathered sites that may cut the cell in the lane's column.
template <class Real>
void list_candidates(Lane_cell<Real>& cell, Warp_memory<Real>& memory, int count,
                     double guard_factor, int lane)
{
  cell.list(memory, count, Real(guard_factor), lane);
}

/// The cell by its list; the former edges first. Returns false when it is not closed.
template <class Real>
inline bool clip_kept(const Group_view<Real>& view, const Verlet_lists<Real>& lists,
                      const Lane_cell<Real>& cell, const Tangent_frame<Real>& frame,
                      Real list_radius, int sizes, Ring_polygon<Real, 32>& polygon)
{
  Chain_result<Real> result;
  return clip_chain<false>(view, lists, cell, frame, sizes, polygon, result) ||
         clip_entries(view, lists, cell, frame, list_radius, sizes, polygon);
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_LISTED_CELLS_H
