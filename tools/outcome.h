// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How runs end: exit codes, and what the user is told.
#ifndef POWER_RTF_TOOLS_OUTCOME_H
#define POWER_RTF_TOOLS_OUTCOME_H

#include "report_json.h"

#include <string>

namespace tools {

enum Exit_code {
  done = 0,
  unusable_input = 1,
  wrong_usage = 2,
  missed_guarantee = 3,
  wrong_cell = 4,
  unwritable_output = 5,
  cancelled = 128 // and the number of the signal
};

/// Why a run has come to no end.
struct Failure {
  Exit_code code = done;
  std::string message;
};

/// The exception that is being handled, thrown by a run of `input`, in words.
Failure current_failure(const std::string& input);

/// The exit code of a run that has come to its end.
Exit_code exit_code(const Run& run);

/// Tells the user what is wrong with the result.
void print_faults(const Run& run);

/// Tells the user why the CPU stands in for a GPU.
void tell_of_gpu(const Run& run);

/// Lets a thread that cannot start another one, as TBB's do, or finds no memory where nothing can
/// be caught end the program with a message.
void end_where_threads_fail();

/// Tells the user that something failed. \returns the code
Exit_code fail(const Failure& failure);

} // namespace tools

#endif // POWER_RTF_TOOLS_OUTCOME_H
