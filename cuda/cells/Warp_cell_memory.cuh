// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a warp has in memory of the cell that it makes, and the weights that its sites are gathered
// for: the current ones, or earlier ones so that the sites can be kept; see `Warp_cell`.
#ifndef CGAL_POWER_RTF_CUDA_WARP_CELL_MEMORY_CUH
#define CGAL_POWER_RTF_CUDA_WARP_CELL_MEMORY_CUH

#include "Kept_lists.h"

#include <CGAL/PowerRTF/cells/Tangent_polygon.h>

namespace CGAL {
namespace PowerRTF {
namespace device {

/// The shared memory of a warp, and what it keeps of a cell's sites between passes.
template <class Real>
struct Warp_cell_memory {
  static constexpr int most_lines = 192, most_groups = 64;
  union {
    Search_stack stack;
    alignas(8) unsigned char result[sizeof(Tangent_polygon<Real>)];
  };
  Real a[most_lines], b[most_lines], c[most_lines];
  int order[most_lines];    ///< increases with the line's distance from the site
  int neighbor[most_lines]; ///< the place, or -1 - place when it is not compatible
  int groups[most_groups];  ///< of sites, that are near
  int sizes[2];             ///< of the last polygons, by compatible lines and by all; 0: not known
  short edges[2][32];

  /// The result as the shared functors read it.
  __device__ Tangent_polygon<Real>& polygon()
  { return *reinterpret_cast<Tangent_polygon<Real>*>(result); }
};

/// What a warp remembers of the sites in its memory.
template <class Real>
struct Kept_sites {
  int place = -1; ///< of the cell that they are for
  int lines = 0, groups = 0; ///< more groups than there is room for: not known
  Real reach = 0;
  bool is_plain = false; ///< see `Warp_cell::construct()`
};

/// Sites are gathered for the current weights.
template <class Real>
struct Current_weights {
  static constexpr bool keeps = false;
  // More than the last radius, and than that of the guard.
  static constexpr Real plain_part = Real(1.15), guard_part = Real(1.02);
  Real own_weight;

  __device__ Real operator()(const Packed_site<Real>& site, int) const { return site.weight; }
  __device__ Real reach_for(Real radius) const { return radius; }
};

/// Sites are gathered, and kept, for the weights that `lists` were made for; so is the tree.
template <class Real>
struct Kept_weights {
  static constexpr bool keeps = true;
  static constexpr Real plain_part = 2, guard_part = Real(1.25); // they serve for a while
  const Kept_lists<Real>& lists;
  Real own_weight, own_growth, all_growth;

  __device__ Kept_weights(const Kept_lists<Real>& l, int place, Real current)
      : lists(l), own_weight(l.weights[place]), own_growth(current - own_weight),
        all_growth(fmax(__ldcg(l.all_growth) - own_growth, Real(0)))
  {}
  __device__ Real operator()(const Packed_site<Real>&, int place) const
  { return lists.weights[place]; }
  /// What makes the lines within `radius` known now.
  __device__ Real reach_for(Real radius) const
  { return (radius + std::sqrt(radius * radius + 2 * all_growth)) / 2; }
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_WARP_CELL_MEMORY_CUH
