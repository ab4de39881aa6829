// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A strict reader of OFF text. (CGAL's misreads facets that it cannot parse.)
#ifndef POWER_RTF_TOOLS_OFF_MESH_H
#define POWER_RTF_TOOLS_OFF_MESH_H

#include "Polygon_mesh.h"

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <iosfwd>
#include <string_view>
#include <vector>

namespace tools {

/// \throws Invalid_input_error the reason, with the line where it has one
Polygon_mesh parse_off(std::string_view text);

/// The coordinates read back the same.
void write_off(std::ostream& out, const std::vector<CGAL::PowerRTF::Vec3d>& points,
               const std::vector<CGAL::PowerRTF::Triangle>& triangles);

} // namespace tools

#endif // POWER_RTF_TOOLS_OFF_MESH_H
