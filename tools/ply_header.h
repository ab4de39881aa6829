// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The header of a PLY file.
#ifndef POWER_RTF_TOOLS_PLY_HEADER_H
#define POWER_RTF_TOOLS_PLY_HEADER_H

#include "Mesh_property.h"
#include "Tokenizer.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tools::ply {

enum class Body { text, little_endian, big_endian };
using Type = Number_type;
/// What a property is read as.
enum class Role { none, value, corners, texture, begin, end, x, y, z };

struct Property {
  std::string name;
  Type type = Type::int8;
  std::optional<Type> length; ///< of a list: the type of the number of its entries
  Role role = Role::none;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  bool is_vertex() const { return name == "vertex" || name == "vertices"; }
  bool is_face() const { return name == "face" || name == "faces"; }
  bool is_edge() const { return has(Role::begin) && has(Role::end); }
  bool has(Role role) const
  {
    for (const Property& p : properties)
      if (p.role == role) return true;
    return false;
  }
};

struct Header {
  std::optional<Body> body;
  std::vector<std::string> texture_files; ///< of comments
  std::vector<Element> elements;
};

/// Reads the header; the body follows after the line of the last token. All vertices have
/// coordinates, all facets have corners, and there are some.
/// \throws Invalid_input_error the reason, with the line where it has one
Header read_header(Tokenizer& tokens);

/// What the file holds that is not read, in words: "texture coordinates".
std::set<std::string> attributes(const Header& header);

} // namespace tools::ply

#endif // POWER_RTF_TOOLS_PLY_HEADER_H
