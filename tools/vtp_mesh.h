// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A reader of VTK's PolyData.
#ifndef POWER_RTF_TOOLS_VTP_MESH_H
#define POWER_RTF_TOOLS_VTP_MESH_H

#include "Polygon_mesh.h"

#include <string_view>

namespace tools {

/// Reads polygons and strips, as triangles, of all pieces, with their values: colors of three or
/// four bytes and normals become properties as PLY names them, rows of other numbers one property
/// for each column, `NAME_0`, `NAME_1`, and texture coordinates a texture.
/// \throws Invalid_input_error the reason, with the line where it has one; always where the program
///   was built without pugixml and zlib
Polygon_mesh parse_vtp(std::string_view data);

} // namespace tools

#endif // POWER_RTF_TOOLS_VTP_MESH_H
