// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that are something else than their name says.
#ifndef POWER_RTF_TOOLS_FOREIGN_FILE_H
#define POWER_RTF_TOOLS_FOREIGN_FILE_H

#include "mesh_io.h"

#include <string>
#include <string_view>

namespace tools
{

/// What a file with this beginning is, and what can be done about it, when it is surely no file of
/// `format`; else nothing.
std::string foreign_kind(std::string_view beginning, Format format);

} // namespace tools

#endif // POWER_RTF_TOOLS_FOREIGN_FILE_H
