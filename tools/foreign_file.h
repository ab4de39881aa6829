// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Recognizes files that are not what their names say.
#ifndef POWER_RTF_TOOLS_FOREIGN_FILE_H
#define POWER_RTF_TOOLS_FOREIGN_FILE_H

#include "Format.h"

#include <string>
#include <string_view>

namespace tools {

/// What a file with this beginning is, and what can be done about it, if it is surely no file of
/// `format`; otherwise empty.
std::string foreign_kind(std::string_view beginning, Format format);

} // namespace tools

#endif // POWER_RTF_TOOLS_FOREIGN_FILE_H
