// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Why a PLY or STL file cannot be read: CGAL's readers say only that it cannot.
#ifndef POWER_RTF_TOOLS_MESH_DIAGNOSIS_H
#define POWER_RTF_TOOLS_MESH_DIAGNOSIS_H

#include "mesh_io.h"

#include <string>

namespace tools
{

/// What is wrong with the beginning of the file, or nothing. Finds what a reader should not be
/// given: another kind of file, counts that the file is too small for, unknown types.
std::string header_error(const std::string& file, Format format);

/// What is wrong with a file that could not be read; never nothing.
std::string content_error(const std::string& file, Format format);

} // namespace tools

#endif // POWER_RTF_TOOLS_MESH_DIAGNOSIS_H
