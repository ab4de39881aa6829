// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One run of the program, from file to file.
#ifndef POWER_RTF_TOOLS_REMESH_FILE_H
#define POWER_RTF_TOOLS_REMESH_FILE_H

#include "options.h"
#include "report_json.h"

#include <string>

namespace tools {

/// Remeshes a file. All files of the run appear at its end, or none. May be called on several
/// threads at once.
///
/// \param threads that the run may use, for its report
/// \throws what `current_failure()` knows
Run remesh_file(const Program_options& options, int threads);

} // namespace tools

#endif // POWER_RTF_TOOLS_REMESH_FILE_H
