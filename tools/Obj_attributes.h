// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What facets and vertices of OBJ files have beside: names, colors, texture coordinates.
#ifndef POWER_RTF_TOOLS_OBJ_ATTRIBUTES_H
#define POWER_RTF_TOOLS_OBJ_ATTRIBUTES_H

#include "Polygon_mesh.h"
#include "Tokenizer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tools {

/// The names of facets in OBJ.
class Obj_names {
public:
  /// Reads the rest of a statement.
  void read(Tokenizer& tokens)
  {
    std::string name = rest_of_line(tokens);
    if (!m_is_used && m_unnamed > 0) m_values.assign(m_unnamed, number_of("default"));
    m_is_used = true;
    m_now = std::move(name);
    m_number = -1;
  }
  void end_facet()
  {
    if (!m_is_used) {
      ++m_unnamed;
      return;
    }
    if (m_number < 0) m_number = number_of(m_now);
    m_values.push_back(m_number);
  }
  /// The numbers of the names as a property of the faces, if there is a statement.
  void add_to(Polygon_mesh& mesh, const char* property)
  {
    if (!m_is_used) return;
    mesh.properties.faces.push_back(
        {property, Number_type::int32, std::move(m_values), std::move(m_names)});
  }

private:
  int number_of(const std::string& name)
  {
    const auto [found, is_new] = m_numbers.emplace(name, static_cast<int>(m_names.size()));
    if (is_new) m_names.push_back(name);
    return found->second;
  }

  bool m_is_used = false;
  std::size_t m_unnamed = 0; // facets before the first statement
  std::string m_now;
  int m_number = -1; // of it; -1: no facet has it yet
  std::map<std::string, int> m_numbers;
  std::vector<std::string> m_names;
  std::vector<double> m_values;
};

/// The colors of vertices in OBJ: three numbers from 0 to 1 after the coordinates.
class Obj_colors {
public:
  static constexpr std::size_t channels = 3;

  /// Reads what follows the coordinates of the next vertex, a color or a weight.
  void read(Tokenizer& tokens)
  {
    ++m_vertices;
    std::vector<double> numbers;
    while (tokens.next_in_line()) numbers.push_back(tokens.number());
    if (numbers.size() != channels) return;
    for (std::size_t k = 0; k < channels; ++k) m_channels[k].push_back(255 * numbers[k]);
  }
  /// As the channels of one byte that other formats have.
  void add_to(Polygon_mesh& mesh)
  {
    const std::size_t colored = m_channels[0].size();
    if (colored == m_vertices)
      for (std::size_t k = 0; k < channels; ++k)
        mesh.properties.vertices.push_back(
            {color_channels[k], Number_type::uint8, std::move(m_channels[k])});
    else if (colored > 0)
      mesh.attributes.insert("colors of some vertices");
  }

private:
  std::size_t m_vertices = 0;
  std::array<std::vector<double>, channels> m_channels;
};

/// The index of a vertex in OBJ, from 0; -1: there is none. \param n how many there are so far
inline int obj_corner(long long v, long long n)
{
  return corner(v > 0 ? v - 1 : v == 0 || v < -n ? -1 : n + v); // negative: from the last
}

/// The texture coordinates in OBJ, which corners of facets refer to.
class Obj_texture {
public:
  /// Reads the rest of a statement: u, v (0) and what else there is.
  void read(Tokenizer& tokens)
  {
    std::array<double, 2> uv{0, 0};
    try {
      for (double& x : uv)
        if (tokens.next_in_line()) x = tokens.number();
    } catch (const CGAL::PowerRTF::Invalid_input_error& e) {
      note(e.what());
    }
    m_texture.coordinates.push_back(uv);
  }
  /// Reads a corner of a facet: "vertex/coordinates".
  void read_corner(const Tokenizer& tokens)
  {
    const std::string_view token = tokens.token();
    const std::size_t slash = token.find('/');
    int c = -1;
    if (slash != std::string_view::npos) {
      const char* const begin = token.data() + slash + 1;
      const char* const end = token.data() + token.size();
      long long index = 0;
      const auto [stop, error] = std::from_chars(begin, end, index);
      if (error == std::errc()) {
        c = obj_corner(index, static_cast<long long>(m_texture.coordinates.size()));
        if (c < 0) note(tokens.at() + no_such(token));
        if (c > m_largest) {
          m_largest = c;
          m_at_largest = tokens.at() + no_such(token);
        }
      } else if (begin != end && *begin != '/') {
        note(tokens.at() + no_such(token));
      }
    }
    m_texture.corners.push_back(c);
  }
  void add_to(Polygon_mesh& mesh)
  {
    if (m_texture.coordinates.empty()) return;
    if (m_largest >= static_cast<int>(m_texture.coordinates.size())) note(m_at_largest);
    mesh.texture_error = std::move(m_error);
    if (mesh.texture_error.empty()) mesh.properties.texture = std::move(m_texture);
  }

private:
  static std::string no_such(std::string_view token)
  {
    return "'" + printable(token) + "' refers to texture coordinates that do not exist";
  }
  void note(const std::string& error)
  {
    if (m_error.empty()) m_error = error;
  }

  Texture m_texture;
  int m_largest = -1;
  std::string m_at_largest, m_error; // the first
};

} // namespace tools

#endif // POWER_RTF_TOOLS_OBJ_ATTRIBUTES_H
