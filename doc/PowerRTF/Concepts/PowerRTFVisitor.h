// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgPowerRTFConcepts
\cgalConcept

What is told about the progress of a run, and may stop it: the named parameter `visitor` of
`CGAL::power_rtf_remeshing()`, and the argument of the members of `CGAL::PowerRTF_remesher`. The
calls come from the thread that started the run.

\cgalHasModelsBegin
\cgalHasModels{`CGAL::PowerRTF::Remeshing_default_visitor`}
\cgalHasModelsEnd
*/
class PowerRTFVisitor {
public:
  /// A stage begins: "surface", "sampling", "optimization", "extraction", "improvement", "quality",
  /// "transfer" (where sources are asked for) or "write".
  void on_stage(const char* name);

  /// So much of the stage is done: `done` is 0 at its beginning and 1 at its end, unless the stage
  /// is left early, and never falls in between. It is a share of the stage's steps, which need not
  /// take equally long. Called at the beginning and the end and, within the stage, before each
  /// call of `go_further()` that comes every 50 ms or so. Optional: a visitor may do without it.
  void on_progress(double done);

  /// An outer iteration (Algorithm 3) has ended. `progress` in [0, 1] is the share of the
  /// optimization done.
  void on_iteration(const CGAL::PowerRTF::Iteration_report& iteration, double progress);

  /// Asked after each iteration and, in all stages but "write", every 50 ms or so; `false` stops
  /// the run: no mesh is made, the output stays as it was.
  bool go_further();
};
