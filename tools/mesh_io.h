// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Mesh files: what can be read is finite and consistent, what cannot is told why.
#ifndef POWER_RTF_TOOLS_MESH_IO_H
#define POWER_RTF_TOOLS_MESH_IO_H

#include "dataset.h"

#include <CGAL/PowerRTF/surface/Surface.h>

#include <iosfwd>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tools
{

enum class Format { unknown, off, obj, ply, stl, vtp };

/// By the end of the file's name, in upper or lower case.
Format format_of(const std::string& file);

struct Polygon_mesh {
  std::vector<CGAL::PowerRTF::Vec3d> points;
  std::vector<std::vector<std::size_t>> polygons; ///< indices into `points`
  std::set<std::string> attributes;               ///< what else the file had, in words: "normals"
};

/// Reads OFF, OBJ, PLY or STL. All coordinates are finite, all indices in range, there is a facet.
/// \throws Invalid_input_error naming file and reason
Polygon_mesh read_mesh(const std::string& file);

/// The same, from the content of a file of the `format`, which is one of these.
/// \throws Invalid_input_error the reason
Polygon_mesh parse_mesh(Format format, std::string_view data);

/// Whether a mesh is written with coordinates of single precision: as binary STL.
bool holds_floats(Format format, Encoding encoding);

/// Writes triangles as any of the formats; `encoding` is that of PLY and STL. The coordinates read
/// back the same, but for binary STL, which is in single precision.
/// \throws Output_error a coordinate is too large for that
void write_mesh(std::ostream& out, Format format, Encoding encoding,
                const std::vector<CGAL::PowerRTF::Vec3d>& points,
                const std::vector<CGAL::PowerRTF::Triangle>& triangles);

} // namespace tools

#endif // POWER_RTF_TOOLS_MESH_IO_H
