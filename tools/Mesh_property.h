// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Named values of the vertices and faces of a mesh file, as colors, normals, labels.
#ifndef POWER_RTF_TOOLS_MESH_PROPERTY_H
#define POWER_RTF_TOOLS_MESH_PROPERTY_H

#include "Format.h"
#include "Texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

namespace tools {

enum class Number_type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline bool is_real(Number_type type)
{
  return type == Number_type::float32 || type == Number_type::float64;
}

/// Calls `visit` with the number of that type that is nearest to `x`.
template <class Visit>
void visit_as(Number_type type, double x, const Visit& visit)
{
  const auto as = [&](auto number) {
    using Number = decltype(number);
    using Limits = std::numeric_limits<Number>;
    if constexpr (std::is_integral<Number>::value)
      visit(x >= double(Limits::lowest()) // not of NaN
                ? static_cast<Number>(std::min(std::round(x), double(Limits::max())))
                : Limits::lowest());
    else
      visit(static_cast<Number>(x));
  };
  switch (type) {
  case Number_type::int8:
    return as(std::int8_t());
  case Number_type::uint8:
    return as(std::uint8_t());
  case Number_type::int16:
    return as(std::int16_t());
  case Number_type::uint16:
    return as(std::uint16_t());
  case Number_type::int32:
    return as(std::int32_t());
  case Number_type::uint32:
    return as(std::uint32_t());
  case Number_type::float32:
    return as(float());
  case Number_type::float64:
    return as(double());
  }
}

/// A number for each vertex or each face.
struct Mesh_property {
  std::string name;
  Number_type type = Number_type::float64; ///< in files; the values need not be rounded to it
  std::vector<double> values;
  std::vector<std::string> names{}; ///< what the values 0, 1, ... stand for; empty: numbers
};

/// glTF: what the materials look like.
struct Gltf_materials {
  std::string json{}; ///< materials, textures, samplers and images; empty: not known
  /// The bytes of the images that have a "bufferView", by its number.
  std::vector<std::string> images{};
};

/// A file that is written with a mesh.
struct Side_file {
  std::string name, bytes;
};

struct Mesh_properties {
  std::vector<Mesh_property> vertices, faces;
  Texture texture{};
  // What the materials look like, in one of three ways:
  std::vector<std::string> material_files{}; ///< OBJ: the files that say it, as the file names them
  Gltf_materials gltf_materials{};
  std::vector<std::string> texture_files{}; ///< PLY: images, by the number `texnumber`
  std::vector<Side_file> side_files{};      ///< of an output

  bool empty() const { return vertices.empty() && faces.empty() && texture.empty(); }
};

/// The property of that name, or null.
const Mesh_property* find_property(const std::vector<Mesh_property>& properties,
                                   const std::string& name);

inline constexpr std::array<const char*, 4> color_channels = {"red", "green", "blue", "alpha"};

/// Whether that is the name of a channel of a color.
bool is_color(const std::string& name);

/// What a property means, in words: "normals".
std::string in_words(const std::string& name, bool of_vertices);

/// Those that files of a format hold: PLY, VTP, VTU and MSH all numbers, OBJ and glTF the colors of
/// vertices and names of faces (glTF: of materials only); OBJ, glTF and PLY textures.
Mesh_properties held_by(Format format, const Mesh_properties& properties);

/// The others, in words.
std::set<std::string> not_held_by(Format format, const Mesh_properties& properties);

} // namespace tools

#endif // POWER_RTF_TOOLS_MESH_PROPERTY_H
