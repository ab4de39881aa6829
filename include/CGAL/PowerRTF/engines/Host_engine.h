// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engines of the CPU, sequential or with TBB.
#ifndef CGAL_POWER_RTF_ENGINES_HOST_ENGINE_H
#define CGAL_POWER_RTF_ENGINES_HOST_ENGINE_H

#include <CGAL/PowerRTF/engines/Surface_engine.h>

#include <memory>

namespace CGAL::PowerRTF {

/// `make()` is defined in Host_engine_impl.h: only who instantiates it needs that.
template <class Real, class Construction, class ConcurrencyTag>
struct Make_host_engine {
  using Concurrency_tag = ConcurrencyTag;
  static void check(const Run_sizes&, const Remeshing_options&) {}
  static Surface_work surface_work(const Remeshing_options&) { return {}; }
  static std::unique_ptr<Engine_base> make(const Surface_in_tree& surface,
                                           const Remeshing_options& options);
};

/// \tparam Construction of the cells; see `Tree_cells`
template <class Real, class Construction, class ConcurrencyTag>
using Host_engine = Surface_engine<Make_host_engine<Real, Construction, ConcurrencyTag>>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_HOST_ENGINE_H
