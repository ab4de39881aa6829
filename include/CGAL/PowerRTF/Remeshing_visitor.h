// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hooks into a remeshing run.
#ifndef CGAL_POWER_RTF_REMESHING_VISITOR_H
#define CGAL_POWER_RTF_REMESHING_VISITOR_H

#include <CGAL/PowerRTF/Remeshing_report.h>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFRef
/// The default visitor: does nothing and never stops. Derive from it, or give any class with these
/// members; pass it through `std::ref` to keep its state.
struct Remeshing_default_visitor {
  /// A stage begins: "surface", "sampling", "optimization", "extraction", "improvement", "quality"
  /// or "write".
  void on_stage(const char* /*name*/) {}
  /// So much of the stage is done: `done` rises from 0 to 1. Called at the stage's beginning and
  /// end and every 50 ms or so. A visitor need not have this member.
  void on_progress(double /*done*/) {}
  /// An outer iteration ended. `progress` in [0, 1] is the share of the optimization done.
  void on_iteration(const Iteration_report& /*iteration*/, double /*progress*/) {}
  /// Asked after each iteration and, in all stages, every 50 ms or so; `false` stops the run: no
  /// mesh is made.
  bool go_further() { return true; }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_REMESHING_VISITOR_H
