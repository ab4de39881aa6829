// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reference traits: the same algorithm over cells with exact combinatorics. Slow, simple,
// right: the oracle that the fast traits are checked against.
#ifndef CGAL_POWER_RTF_EXACT_TRAITS_3_H
#define CGAL_POWER_RTF_EXACT_TRAITS_3_H

#include <CGAL/PowerRTF/engines/Host_engine_impl.h>
#include <CGAL/PowerRTF/exact/Exact_construction.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/tags.h>

namespace CGAL::PowerRTF {

#ifdef CGAL_POWER_RTF_COMPILED
extern template struct Make_host_engine<
    double, Exact_construction<Exact_predicates_inexact_constructions_kernel>, Sequential_tag>;
#ifdef CGAL_LINKED_WITH_TBB
extern template struct Make_host_engine<
    double, Exact_construction<Exact_predicates_inexact_constructions_kernel>, Parallel_tag>;
#endif
#endif

/// \ingroup PkgPowerRTFTraits
/// Cells by exact predicates. Which neighbors bound each cell, and which cells are empty, is exact
/// for the current samples, weights and normals as doubles; areas, centroids and all steps are
/// double arithmetic.
///
/// \cgalModels `PowerRTFEngine`
template <class Kernel, class ConcurrencyTag>
using Exact_engine = Host_engine<double, Exact_construction<Kernel>, ConcurrencyTag>;

} // namespace CGAL::PowerRTF

namespace CGAL {

/// \ingroup PkgPowerRTFTraits
/// The reference traits: the same algorithm over cells with exact combinatorics.
///
/// \cgalModels `PowerRTFTraits_3`
///
/// \tparam Kernel_ a CGAL kernel; the points of the input and the output are its `Point_3`. The
/// samples are doubles whatever the kernel; see `PowerRTF::Tangent_cell_traits_3`.
/// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`.
template <class Kernel_, class ConcurrencyTag = Sequential_tag>
struct PowerRTF_exact_traits_3 {
  using Kernel = Kernel_;
  using Concurrency_tag = ConcurrencyTag;
  using Engine = PowerRTF::Exact_engine<Kernel, ConcurrencyTag>;
  /// The traits' name in reports.
  static const char* name() { return "exact"; }
};

} // namespace CGAL

#endif // CGAL_POWER_RTF_EXACT_TRAITS_3_H
