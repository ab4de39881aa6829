// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Many files in one run of the program (--batch).
#ifndef POWER_RTF_TOOLS_BATCH_H
#define POWER_RTF_TOOLS_BATCH_H

#include "options.h"
#include "outcome.h"

namespace tools {

/// Remeshes each file that `options.input` lists (a text file with a path a line) or has in it (a
/// folder) into the folder `options.output`, several at a time, and tells how each has ended. The
/// files are those of single runs.
///
/// \returns the worst of the exit codes: a mesh that is not written, one with a wrong cell, one
/// with
///   a guarantee missed
/// \throws Invalid_input_error when there is no such list, Output_error, Usage_error when two
/// inputs
///   would have the same output
Exit_code remesh_files(const Program_options& options, int threads);

} // namespace tools

#endif // POWER_RTF_TOOLS_BATCH_H
