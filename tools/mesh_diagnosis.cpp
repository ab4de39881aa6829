// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_diagnosis.h"

#include "Words.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

namespace tools
{
namespace
{

/// What keeps the first word that is not a finite number from being one, or nothing.
std::string number_error(Words& words)
{
  try {
    words.number();
  } catch (const CGAL::PowerRTF::Invalid_input_error& e) {
    return e.what();
  }
  return {};
}

// --- PLY -----------------------------------------------------------------------------------------

struct Ply_header {
  std::string error;
  bool ascii = false;
  std::size_t vertices = 0, facets = 0;

  std::string counts() const
  {
    return "its header announces " + std::to_string(vertices) + " vertices and " +
           std::to_string(facets) + " facets";
  }
};

/// Reads up to end_header.
Ply_header read_ply_header(std::istream& in)
{
  Ply_header header;
  const std::set<std::string> reals{"float", "float32", "double", "float64"},
      indices{"int", "int32", "uint", "uint32"};
  std::set<std::string> coordinates;
  bool has_facets = false, ended = false;
  std::string line, element;
  for (std::size_t number = 1; !ended && std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string keyword, type, name;
    words >> keyword;
    if (number == 1 && keyword != "ply") {
      header.error = "it is not a PLY file: it does not begin with ply";
      return header;
    }
    if (keyword == "format") words >> type, header.ascii = type == "ascii";
    if (keyword == "element") {
      long long count = -1;
      words >> element >> count;
      if (count < 0) header.error = "line " + std::to_string(number) + ": no number of elements";
      if (element == "vertex" || element == "vertices") header.vertices = count;
      if (element == "face" || element == "faces") header.facets = count;
    }
    if (keyword == "property") {
      words >> type;
      const bool is_list = type == "list";
      if (is_list) words >> name >> type; // the type of its length is no matter
      words >> name;
      if (element.substr(0, 4) == "vert" && reals.count(type)) coordinates.insert(name);
      if (element.substr(0, 4) == "face" && is_list && indices.count(type) &&
          (name == "vertex_indices" || name == "vertex_index"))
        has_facets = true;
    }
    ended = keyword == "end_header";
  }
  if (!header.error.empty()) return header;
  if (!ended)
    header.error = "the file is truncated in its header";
  else if (!coordinates.count("x") || !coordinates.count("y") || !coordinates.count("z"))
    header.error = "its vertices have no coordinates x, y, z of type float or double";
  else if (!has_facets || header.facets == 0)
    header.error = "it has no facets (a list vertex_indices of type int)";
  return header;
}

std::string ply_content_error(std::istream& in)
{
  const Ply_header header = read_ply_header(in);
  const std::string rest(std::istreambuf_iterator<char>(in), {});
  if (header.ascii)
    for (Words words(rest); words.next();) {
      const std::string error = number_error(words);
      if (!error.empty()) return error + " (counted from the end of the header)";
    }
  return "the file is truncated or malformed: " + header.counts();
}

// --- STL -----------------------------------------------------------------------------------------

std::string stl_header_error(std::istream& in, std::uintmax_t size)
{
  char head[84] = {};
  in.read(head, sizeof(head));
  std::string text(head, static_cast<std::size_t>(in.gcount()));
  text.erase(0, text.find_first_not_of(" \t\r\n"));
  if (text.substr(0, 5) == "solid") return {};
  if (size < sizeof(head)) return "it is not an STL file, or truncated in its header";
  std::uint32_t facets = 0; // little-endian, as the reader takes it too
  std::memcpy(&facets, head + 80, sizeof(facets));
  const std::uintmax_t present = (size - 84) / 50;
  if (present != facets)
    return "it is not an STL file, or truncated: its header announces " + std::to_string(facets) +
           " facets, the file has room for " + std::to_string(present);
  return {};
}

std::string stl_content_error(std::istream& in)
{
  const std::string text(std::istreambuf_iterator<char>(in), {});
  Words words(text);
  while (words.next())
    if (words.word() == "vertex")
      for (int k = 0; k < 3; ++k) {
        if (!words.next()) return "the file is truncated in a vertex";
        const std::string error = number_error(words);
        if (!error.empty()) return error;
      }
  return "the file is truncated or malformed: it does not end with endsolid";
}

} // namespace

std::string header_error(const std::string& file, Format format)
{
  std::ifstream in(file, std::ios::binary);
  const std::uintmax_t size = std::filesystem::file_size(file);
  if (format == Format::stl) return stl_header_error(in, size);
  const Ply_header header = read_ply_header(in);
  if (!header.error.empty()) return header.error;
  // every vertex and every facet takes a few bytes
  if (header.vertices <= size && header.facets <= size) return {};
  return "the file is truncated: it has only " + std::to_string(size) + " bytes, " +
         header.counts();
}

std::string content_error(const std::string& file, Format format)
{
  std::ifstream in(file, std::ios::binary);
  return format == Format::stl ? stl_content_error(in) : ply_content_error(in);
}

} // namespace tools
