// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Format.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace tools {

Format format_of(const std::string& file)
{
  std::string end = std::filesystem::path(file).extension().string();
  std::transform(end.begin(), end.end(), end.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (end == ".off") return Format::off;
  if (end == ".obj") return Format::obj;
  if (end == ".ply") return Format::ply;
  if (end == ".stl") return Format::stl;
  if (end == ".vtp") return Format::vtp;
  if (end == ".vtu") return Format::vtu;
  if (end == ".msh") return Format::msh;
  if (end == ".gltf") return Format::gltf;
  if (end == ".glb") return Format::glb;
  return Format::unknown;
}

bool is_read(Format format)
{
  return format != Format::unknown && format != Format::vtu && format != Format::msh;
}

bool holds_numbers(Format format)
{
  return holds_cells(format) || format == Format::vtu || format == Format::msh;
}

bool holds_texture(Format format) { return holds_names(format) || format == Format::ply; }

bool holds_names(Format format) { return format == Format::obj || is_gltf(format); }

bool is_gltf(Format format) { return format == Format::gltf || format == Format::glb; }

bool holds_cells(Format format) { return format == Format::ply || format == Format::vtp; }

bool holds_floats(Format format, Encoding encoding)
{
  return (format == Format::stl && encoding == Encoding::binary) || is_gltf(format);
}

} // namespace tools
