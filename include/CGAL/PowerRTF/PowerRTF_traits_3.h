// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The default traits: the fast CPU engine.
#ifndef CGAL_POWER_RTF_TRAITS_3_H
#define CGAL_POWER_RTF_TRAITS_3_H

#include <CGAL/PowerRTF/engines/Host_engine.h>

#include <CGAL/tags.h>

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/engines/Host_engine_impl.h>
#include <CGAL/PowerRTF/exact/Exact_construction.h>
#endif

namespace CGAL::PowerRTF {

class Filtered_construction;

#ifdef CGAL_POWER_RTF_COMPILED
extern template struct Make_host_engine<double, Filtered_construction, Sequential_tag>;
#ifdef CGAL_LINKED_WITH_TBB
extern template struct Make_host_engine<double, Filtered_construction, Parallel_tag>;
#endif
#endif

/// \ingroup PkgPowerRTFTraits
/// Cells by a search in a tree, in double precision.
///
/// \cgalModels `PowerRTFEngine`
template <class ConcurrencyTag>
using Cpu_engine = Host_engine<double, Filtered_construction, ConcurrencyTag>;

} // namespace CGAL::PowerRTF

namespace CGAL {

/// \ingroup PkgPowerRTFTraits
/// The default traits: the fast CPU engine, sequential or with TBB.
///
/// \cgalModels `PowerRTFTraits_3`
///
/// \tparam Kernel_ a CGAL kernel; the points of the input and the output are its `Point_3`.
/// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`.
template <class Kernel_, class ConcurrencyTag = Parallel_if_available_tag>
struct PowerRTF_traits_3 {
  using Kernel = Kernel_;
  using Concurrency_tag = ConcurrencyTag;
  using Engine = PowerRTF::Cpu_engine<ConcurrencyTag>;
  /// The traits' name in reports.
  static const char* name() { return "cpu"; }
};

} // namespace CGAL

#endif // CGAL_POWER_RTF_TRAITS_3_H
