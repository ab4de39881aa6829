// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The report as JSON and as a table.
#ifndef POWER_RTF_TOOLS_REPORT_JSON_H
#define POWER_RTF_TOOLS_REPORT_JSON_H

#include "options.h"

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/exact/Cell_comparison.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace tools {

/// A comparison of the cells with the exact ones.
struct Check {
  std::size_t iterations; ///< done before the comparison
  CGAL::PowerRTF::Cell_comparison result;
};

/// What the program did.
struct Run {
  Program_options options;
  CGAL::PowerRTF::Remeshing_report report;
  std::string gpu_not_used;                  ///< why --traits auto took the CPU
  bool has_gpu_failed = false;               ///< that is why
  std::vector<std::string> not_carried_over; ///< to the output: "normals"
  int threads = 1;                           ///< used
  std::vector<std::string> missed;           ///< guarantees
  std::vector<Check> checks;                 ///< the last one: of the final cells
  std::string error;                         ///< of a batch: why there is no result
};

/// Everything, for programs. Without a mesh (--no-mesh) the fields about it are left out.
void write_json(std::ostream& out, const Run& run);

/// The same in one line; of a run that has failed, its input and its error.
void write_json_line(std::ostream& out, const Run& run);

/// The main results, for people.
void print_table(std::ostream& out, const Run& run);

} // namespace tools

#endif // POWER_RTF_TOOLS_REPORT_JSON_H
