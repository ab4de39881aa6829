// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef POWER_RTF_TOOLS_PROGRAM_H
#define POWER_RTF_TOOLS_PROGRAM_H

namespace tools {

/// The program power_rtf_remesh, with the arguments of a `main()`. Returns its exit code.
int run_program(int argc, const char* const* argv);

} // namespace tools

#endif // POWER_RTF_TOOLS_PROGRAM_H
