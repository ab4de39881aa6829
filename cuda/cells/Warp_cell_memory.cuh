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
  Real a[most_lines], b[most_lines], c[most_lines]; ///< a x + b y <= c
  Real d2[most_lines];      ///< squared distances of the sites
  int neighbor[most_lines]; ///< the place, or -1 - place when it is not compatible
  int groups[most_groups];  ///< of sites, that are near
  int sizes[2];             ///< of the last polygons, by compatible lines and by all; 0: not known
  short edges[2][32];
  int corner[2]; ///< the edges at the farthest vertex of a compatible polygon that is guarded

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
  // More than the last radius, and than those of the guard and of its square.
  static constexpr Real plain_part = Real(1.15), guard_part = Real(1.02), whole_part = Real(1.0001);
  Real own_weight, own_now;

  __device__ explicit Current_weights(Real own) : own_weight(own), own_now(own) {}
  __device__ Real listed(const Packed_site<Real>& site, int) const { return site.weight; }
  __device__ Real current(const Packed_site<Real>& site, int) const { return site.weight; }
  __device__ Real reach_for(Real radius) const { return radius; }
};

/// What makes the lines within `radius` known when weights have grown by up to `growth`.
template <class Real>
__device__ inline Real reach_after_growth(Real radius, Real growth)
{ return (radius + std::sqrt(radius * radius + 2 * growth)) / 2; }

/// Sites are gathered, and kept, for the weights that `lists` were made for; so is the tree.
template <class Real>
struct Kept_weights {
  static constexpr bool keeps = true;
  // They serve for a while.
  static constexpr Real plain_part = 2, guard_part = Real(1.15), whole_part = Real(1.1);
  const Kept_lists<Real>& lists;
  const Packed_site<Real>* sites; ///< with the current weights
  Real own_weight, own_now, own_growth, all_growth;

  __device__ Kept_weights(const Kept_lists<Real>& l, const Packed_site<Real>* s, int place)
      : lists(l), sites(s), own_weight(l.weights[place]), own_now(s[place].weight),
        own_growth(own_now - own_weight),
        all_growth(fmax(__ldcg(l.all_growth) - own_growth, Real(0)))
  {}
  __device__ Real listed(const Packed_site<Real>&, int place) const { return lists.weights[place]; }
  __device__ Real current(const Packed_site<Real>& site, int) const { return site.weight; }
  using Record = Real;
  __device__ Real record(int place) const { return sites[place].weight; }
  __device__ Real current(Real record) const { return record; }
  __device__ Real growth_of(int group) const { return __ldcg(lists.growth + group); }
  __device__ Real reach_for(Real radius) const { return reach_after_growth(radius, all_growth); }
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_WARP_CELL_MEMORY_CUH
