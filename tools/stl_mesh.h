// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A strict reader of STL. (CGAL's says only that it failed.)
#ifndef POWER_RTF_TOOLS_STL_MESH_H
#define POWER_RTF_TOOLS_STL_MESH_H

#include "Polygon_mesh.h"

#include <cstdint>
#include <string_view>

namespace tools {

/// Whether the beginning of a file of `size` bytes announces as many facets as a binary STL file of
/// this size has. Then it is one, whatever its first 80 bytes are: they are free.
bool is_binary_stl(std::string_view beginning, std::uintmax_t size);

/// Reads text or binary; corners at the same place become one point.
/// \throws Invalid_input_error the reason, with the line where it has one
Polygon_mesh parse_stl(std::string_view data);

} // namespace tools

#endif // POWER_RTF_TOOLS_STL_MESH_H
