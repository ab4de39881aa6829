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
  /// A stage begins: "surface", "sampling", "optimization", "extraction", "improvement" or
  /// "quality".
  void on_stage(const char* name);

  /// An outer iteration (Algorithm 3) has ended. `progress` in [0, 1] is the share of the
  /// optimization done.
  void on_iteration(const CGAL::PowerRTF::Iteration_report& iteration, double progress);

  /// Asked after each iteration and, in all stages, every 50 ms or so; `false` stops the run: no
  /// mesh is made, the output stays as it was.
  bool go_further();
};
