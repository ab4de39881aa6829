// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A strict reader of PLY. (CGAL's crashes at a property without an element, and makes room for
// lists longer than the file.)
#ifndef POWER_RTF_TOOLS_PLY_MESH_H
#define POWER_RTF_TOOLS_PLY_MESH_H

#include "Polygon_mesh.h"

#include <string_view>

namespace tools {

/// Reads text or binary of either byte order. Points and facets may have any further properties,
/// and other elements may stand between them. The memory used is bounded by the file's size.
/// \throws Invalid_input_error the reason, with the line where it has one
Polygon_mesh parse_ply(std::string_view data);

} // namespace tools

#endif // POWER_RTF_TOOLS_PLY_MESH_H
