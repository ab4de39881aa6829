// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reading and writing mesh files. What is read is finite and consistent; what cannot be read is
// refused with the reason.
#ifndef POWER_RTF_TOOLS_MESH_IO_H
#define POWER_RTF_TOOLS_MESH_IO_H

#include "Format.h"
#include "Polygon_mesh.h"

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

/// Reads OFF, OBJ, PLY, STL, VTP or glTF. The mesh has at least one facet, its coordinates are
/// finite and its indices in range. \throws Invalid_input_error naming file and reason
Polygon_mesh read_mesh(const std::string& file);

/// The same from the content of a file of that format. \param folder where the file lies
/// \throws Invalid_input_error the reason
Polygon_mesh parse_mesh(Format format, std::string_view data, const std::string& folder = {});

/// Writes triangles as any of the formats; `encoding` is that of PLY and STL. The coordinates read
/// back the same, except for binary STL and glTF, which are in single precision. Of the properties
/// those are written that `held_by()` names. \throws Output_error a coordinate is too large for
/// single precision
void write_mesh(std::ostream& out, Format format, Encoding encoding,
                const std::vector<CGAL::PowerRTF::Vec3d>& points,
                const std::vector<CGAL::PowerRTF::Triangle>& triangles,
                const Mesh_properties& properties = {});

} // namespace tools

#endif // POWER_RTF_TOOLS_MESH_IO_H
