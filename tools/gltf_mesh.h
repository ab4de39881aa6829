// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes in glTF 2.0, as text (.gltf) and binary (.glb).
#ifndef POWER_RTF_TOOLS_GLTF_MESH_H
#define POWER_RTF_TOOLS_GLTF_MESH_H

#include "Polygon_mesh.h"

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

/// Reads the triangles of the scene, all its nodes in one mesh, each with its transformation, with
/// colors (COLOR_0), texture coordinates (TEXCOORD_0) and materials. Normals are not read: writing
/// makes them.
/// \param folder where the files lie that hold buffers
/// \throws Invalid_input_error the reason
Polygon_mesh parse_gltf(std::string_view data, const std::string& folder);

/// Writes one mesh, binary or with its buffer as Base64, in single precision. Vertices are doubled
/// at seams of the texture, and where the surface is bent by more than 40 degrees, for the normals.
void write_gltf(std::ostream& out, bool is_binary, const std::vector<CGAL::PowerRTF::Vec3d>& points,
                const std::vector<CGAL::PowerRTF::Triangle>& triangles,
                const Mesh_properties& properties);

} // namespace tools

#endif // POWER_RTF_TOOLS_GLTF_MESH_H
