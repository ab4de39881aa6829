// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shared memory of a warp that constructs a cell, and the weights that its sites are gathered
// for: the current ones, or earlier ones so that the sites can be kept; see `Warp_cell`.
#ifndef CGAL_POWER_RTF_CUDA_WARP_CELL_MEMORY_CUH
#define CGAL_POWER_RTF_CUDA_WARP_CELL_MEMORY_CUH

#include "Group_tree.h"

#include <CGAL/PowerRTF/cells/Tangent_polygon.h>

namespace CGAL::PowerRTF::device {

/// The shared memory of a warp; its sites are kept between passes.
template <class Real>
struct Warp_cell_memory {
  static constexpr int max_lines = 192, max_groups = 64;
  union {
    Search_stack stack;
    alignas(8) unsigned char result[sizeof(Tangent_polygon<Real>)];
  };
  Real a[max_lines], b[max_lines], c[max_lines]; ///< a x + b y <= c
  Real d2[max_lines];                            ///< squared distances of the sites
  int neighbor[max_lines]; ///< the place, or -1 - place when it is not compatible
  int groups[max_groups];  ///< of sites, that are near
  int sizes[2];            ///< of the last polygons, by compatible lines and by all; 0: not known
  short edges[2][32];
  int corner[2]; ///< the edges at the farthest vertex of a compatible polygon that is guarded

  /// The result as the shared functors read it.
  __device__ Tangent_polygon<Real>& polygon()
  {
    return *reinterpret_cast<Tangent_polygon<Real>*>(result);
  }
};

/// Describes the sites in a warp's memory.
template <class Real>
struct Kept_sites {
  int place = -1;            ///< of the cell that they are for
  int lines = 0, groups = 0; ///< more groups than there is room for: not known
  Real reach = 0;
  bool is_plain = false; ///< see `Warp_cell::construct()`
};

/// Sites are gathered for the current weights.
template <class Real>
struct Current_weights {
  static constexpr bool keeps = false;
  // More than the last radius, and than those of the guard and of its square.
  static constexpr Real plain_part = Real(1.15), guard_part = Real(1.02), whole_part = Real(1.0001);
  Real own_weight, own_now;

  __device__ explicit Current_weights(Real own) : own_weight(own), own_now(own) {}
  __device__ Real listed(const Packed_site<Real>& site, int) const { return site.weight; }
  __device__ Real current(const Packed_site<Real>& site, int) const { return site.weight; }
  __device__ Real reach_for(Real radius) const { return radius; }
};

/// The reach within which sites are gathered so that all lines within `radius` are known when
/// weights have grown by up to `growth`.
template <class Real>
__device__ inline Real reach_after_growth(Real radius, Real growth)
{
  return (radius + std::sqrt(radius * radius + 2 * growth)) / 2;
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WARP_CELL_MEMORY_CUH
