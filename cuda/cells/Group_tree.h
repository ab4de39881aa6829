// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sites as warps see them: a packed tree of arity 32 over sites in Hilbert order, so that one
// lane looks at one child. Every node carries the largest weight below it; a search that skips a
// node has a proof that none of its sites can cut, as with the tree of arity 8 of the CPU.
#ifndef CGAL_POWER_RTF_CUDA_GROUP_TREE_H
#define CGAL_POWER_RTF_CUDA_GROUP_TREE_H

#include "quick_math.h"

#include <CGAL/PowerRTF/cells/Sites_view.h>
#include <CGAL/PowerRTF/geometry/Packed_tree.h>

namespace CGAL::PowerRTF::device {

/// A `Site`, aligned for loads of 16 bytes.
template <class Real>
struct alignas(16) Packed_site {
  Vec3<Real> point;
  Real weight;
};

/// The unit normal of a site and its patch.
template <class Real>
struct alignas(16) Packed_normal {
  Vec3<Real> normal;
  int patch;
};

/// Box and largest weight of a node.
template <class Real>
struct alignas(16) Group_node {
  Vec3<Real> lo;
  Real max_weight;
  Vec3<Real> hi;
  Real padding;
};

/// How the nodes lie in one array.
using Group_layout = Basic_tree_layout<32, 7>;

/// The stack of a warp's depth-first search. `at_once` nodes are popped together as long as there
/// are few, then one at a time.
struct Search_stack {
  static constexpr int at_once = 2, crowded = 128;
  int nodes[crowded + at_once * Group_layout::arity +
            (Group_layout::arity - 1) * Group_layout::max_levels];
};

/// Non-owning view of the sites in Hilbert order; `place` is the index there.
template <class Real>
struct Group_view {
  const Packed_site<Real>* sites = nullptr;
  const Packed_normal<Real>* normals = nullptr;
  const Real* density_root = nullptr;
  const int* caller = nullptr; ///< the site's index in the caller's arrays
  const Group_node<Real>* nodes = nullptr;
  Group_layout tree;
  int cells = 0;             ///< sites whose index in the caller's arrays is below this have a cell
  bool has_features = false; ///< cells next to the other sites are cut at chords
  Real cos_angle = -2, guard_factor = 3;
};

/// The sites that may cut one of a set of cells: those of radius at most `radius` and weight at
/// least `min_weight` in a box.
template <class Real>
struct Group_query {
  Vec3<Real> lo, hi;
  Real radius, min_weight;

  /// Relative rounding of coordinates' differences, squares and roots, with room to spare.
  CGAL_POWER_RTF_HD static constexpr Real margin() { return 1 + 64 * internal::epsilon<Real>(); }

  /// Whether a site in the box [`box_lo`, `box_hi`] of weight at most `weight` may cut. (See
  /// `for_each_possible_neighbor()`; also all sites nearer than `radius` are reported.)
  CGAL_POWER_RTF_HD bool reaches(const Vec3<Real>& box_lo, const Vec3<Real>& box_hi,
                                 Real weight) const
  {
    const Real dx = greatest(box_lo.x - hi.x, lo.x - box_hi.x, Real(0));
    const Real dy = greatest(box_lo.y - hi.y, lo.y - box_hi.y, Real(0));
    const Real dz = greatest(box_lo.z - hi.z, lo.z - box_hi.z, Real(0));
    const Real rounding =
        4 * internal::epsilon<Real>() * (std::fabs(weight) + std::fabs(min_weight));
    const Real square = radius * radius + (weight - min_weight) + rounding;
    const Real reach = (radius + quick_sqrt(std::fmax(square, Real(0)))) * margin();
    return dx * dx + dy * dy + dz * dz <= reach * reach;
  }
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_GROUP_TREE_H
