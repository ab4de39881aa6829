// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgPowerRTFConcepts
\cgalConcept

What `CGAL::PowerRTF_remesher` and `CGAL::power_rtf_remeshing()` are instantiated with: the kernel
of the points, the threading, and the engine that constructs and optimizes the cells.

\cgalHasModelsBegin
\cgalHasModels{`CGAL::PowerRTF_traits_3<Kernel, ConcurrencyTag>`}
\cgalHasModels{`CGAL::PowerRTF_exact_traits_3<Kernel, ConcurrencyTag>`}
\cgalHasModels{`CGAL::PowerRTF_cuda_traits_3<Kernel, Real>`}
\cgalHasModelsEnd
*/
class PowerRTFTraits_3 {
public:
  /// A \cgal kernel; the points of the input and the output are its `Point_3`.
  typedef unspecified_type Kernel;

  /// `CGAL::Sequential_tag`, `CGAL::Parallel_tag` or `CGAL::Parallel_if_available_tag`; also what
  /// the assessment of the result runs with.
  typedef unspecified_type Concurrency_tag;

  /// A model of `PowerRTFEngine`.
  typedef unspecified_type Engine;

  /// The traits' name in reports: "cpu", "exact".
  static const char* name();
};
