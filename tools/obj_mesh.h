// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A strict reader of OBJ text. (CGAL's stops at statements that it does not know.)
#ifndef POWER_RTF_TOOLS_OBJ_MESH_H
#define POWER_RTF_TOOLS_OBJ_MESH_H

#include "Polygon_mesh.h"

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <iosfwd>
#include <string_view>
#include <vector>

namespace tools {

/// What is wrong with texture coordinates only is told in `texture_error`.
/// \throws Invalid_input_error the reason, with the line where it has one
Polygon_mesh parse_obj(std::string_view text);

/// The coordinates read back the same. `properties`: the colors of the points, the materials and
/// groups of the triangles, and their texture are written.
void write_obj(std::ostream& out, const std::vector<CGAL::PowerRTF::Vec3d>& points,
               const std::vector<CGAL::PowerRTF::Triangle>& triangles,
               const Mesh_properties& properties = {});

} // namespace tools

#endif // POWER_RTF_TOOLS_OBJ_MESH_H
