// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The formats of mesh files.
#ifndef POWER_RTF_TOOLS_FORMAT_H
#define POWER_RTF_TOOLS_FORMAT_H

#include <string>

namespace tools {

enum class Format { unknown, off, obj, ply, stl, vtp, vtu, msh, gltf, glb };
enum class Encoding { binary, text };

/// How the names of files end that can be read.
constexpr char read_endings[] = ".off, .obj, .ply, .stl, .vtp, .gltf or .glb";
/// How the names of files end that can be written.
constexpr char written_endings[] = ".off, .obj, .ply, .stl, .vtp, .vtu, .msh, .gltf or .glb";

/// The format that the extension of the file's name stands for, in upper or lower case.
Format format_of(const std::string& file);

/// Whether files of a format can be read: all but VTU and MSH, which are written only.
bool is_read(Format format);

/// Whether a format holds any numbers of vertices and faces: PLY, VTP, VTU and MSH do.
bool holds_numbers(Format format);

/// Whether a format holds texture coordinates of corners: OBJ, glTF and PLY do.
bool holds_texture(Format format);

/// Whether a format holds names of materials: OBJ and glTF do.
bool holds_names(Format format);

/// Whether it is glTF, as text or binary.
bool is_gltf(Format format);

/// Whether a format holds cells and samples with numbers: PLY and VTP do.
bool holds_cells(Format format);

/// Whether a mesh is written with coordinates of single precision: as binary STL or glTF.
bool holds_floats(Format format, Encoding encoding);

} // namespace tools

#endif // POWER_RTF_TOOLS_FORMAT_H
