// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "foreign_file.h"

#include <algorithm>
#include <cctype>

namespace tools {
namespace {

using namespace std::string_view_literals;

struct Kind {
  std::string_view beginning; ///< in lower case
  const char* name;
  Format format = Format::unknown; ///< that it is
};

constexpr Kind kinds[] = {
    {"\x1f\x8b"sv, "a gzip archive: unpack it first"},
    {"pk\3\4"sv, "a zip archive: unpack it first"},
    {"bzh"sv, "a bzip2 archive: unpack it first"},
    {"\3757zxz\0"sv, "an xz archive: unpack it first"},
    {"7z\xbc\xaf\x27\x1c"sv, "a 7z archive: unpack it first"},
    {"rar!\x1a\7"sv, "a RAR archive: unpack it first"},
    {"\x28\xb5\x2f\xfd"sv, "a Zstandard archive: unpack it first"},
    {"\xff\xfe"sv, "text in UTF-16: save it as UTF-8"},
    {"\xfe\xff"sv, "text in UTF-16: save it as UTF-8"},
    {"<!doctype html"sv, "an HTML page (perhaps of a download that failed)"},
    {"<html"sv, "an HTML page (perhaps of a download that failed)"},
    {"version https://git-lfs"sv, "a pointer of Git LFS: git lfs pull fetches the file"},
    {"<?xml"sv, "an XML file", Format::vtp},
    {"<vtkfile"sv, "a VTK file, but its name does not end in .vtp", Format::vtp},
    {"# vtk datafile"sv, "a VTK file"},
    {"gltf"sv, "a glTF file, but its name does not end in .glb", Format::glb},
    {"kaydara fbx"sv, "an FBX file"},
    {"iso-10303-21"sv, "a STEP file: mesh it first"},
    {"$meshformat"sv, "a Gmsh file"},
    {"meshversionformatted"sv, "a Medit file"},
    {"\x89png"sv, "a PNG image"},
    {"\xff\xd8\xff"sv, "a JPEG image"},
    {"%pdf"sv, "a PDF document"},
    {"\177elf"sv, "a program"},
    {"ply\n"sv, "a PLY file, but its name does not end in .ply", Format::ply},
    {"ply\r\n"sv, "a PLY file, but its name does not end in .ply", Format::ply},
    {"off\n"sv, "an OFF file, but its name does not end in .off", Format::off},
    {"off\r\n"sv, "an OFF file, but its name does not end in .off", Format::off},
    {"solid "sv, "an STL file, but its name does not end in .stl", Format::stl},
};

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

} // namespace

std::string foreign_kind(std::string_view beginning, Format format)
{
  std::string text(beginning.substr(0, 256));
  text.erase(text.begin(), std::find_if_not(text.begin(), text.end(), is_space));
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Kind& kind : kinds)
    if (text.compare(0, kind.beginning.size(), kind.beginning) == 0)
      return kind.format == format && format != Format::unknown ? std::string()
                                                                : "it is " + std::string(kind.name);
  return {};
}

} // namespace tools
