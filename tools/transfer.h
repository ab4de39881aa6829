// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a result has of the input: where its vertices and faces come from, and their values.
#ifndef POWER_RTF_TOOLS_TRANSFER_H
#define POWER_RTF_TOOLS_TRANSFER_H

#include "Polygon_mesh.h"

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/transfer/find_sources.h>

#include <iosfwd>
#include <vector>

namespace tools {

/// The properties of a result, from those of the input. Of vertices, real numbers and colors are
/// interpolated linearly, normals get the length 1 again, and other integers, which may be labels,
/// are those of the nearest corner; faces get what the face at their center has, and corners the
/// texture coordinates of `sources.corners`, interpolated linearly.
Mesh_properties transferred(const Polygon_mesh& input, const CGAL::PowerRTF::Sources& sources);

/// The number among the soup's corners that its polygon `face` has at `vertex`.
int corner_number(const CGAL::PowerRTF::Polygon_soup& soup, int face, int vertex);

/// Adds the property `patch` of the faces, in place of one of that name.
void set_patches(const std::vector<int>& patches, Mesh_properties& properties);

/// Writes a mesh with its sources, as PLY or VTP: each vertex with `source_face`, the corners of a
/// triangle of that face, `source_vertex_0` to `source_vertex_2`, and its barycentric coordinates
/// in it, `weight_0` to `weight_2`; each face with the `source_face` of its center. They are the
/// numbers that faces and vertices have in the input's file, from 0.
void write_sources(std::ostream& out, Format format, Encoding encoding,
                   const std::vector<CGAL::PowerRTF::Vec3d>& points,
                   const std::vector<CGAL::PowerRTF::Triangle>& triangles,
                   const CGAL::PowerRTF::Sources& sources);

} // namespace tools

#endif // POWER_RTF_TOOLS_TRANSFER_H
