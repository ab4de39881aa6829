// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "obj_mesh.h"

#include "Text.h"
#include "Tokenizer.h"

#include <array>
#include <charconv>
#include <iterator>
#include <map>
#include <utility>

namespace tools {
namespace {

using CGAL::PowerRTF::Invalid_input_error;
using CGAL::PowerRTF::Triangle;
using CGAL::PowerRTF::Vec3d;

/// Statements of OBJ for data other than points and facets.
struct Obj_attribute {
  std::string_view keyword;
  const char* meaning;
  std::size_t meaningless = 0; ///< so many of them carry no information
};
constexpr Obj_attribute obj_attributes[] = {
    {"vt", "texture coordinates"}, {"vn", "normals"}, {"usemtl", "materials"}, {"g", "groups", 1},
    {"o", "objects", 1},           {"l", "lines"},    {"p", "points"},
};

/// Statements of OBJ that name what the facets after them belong to, and the property of the faces
/// that this becomes.
struct Obj_name {
  std::string_view keyword;
  const char* property;
};
constexpr Obj_name obj_names[] = {{"usemtl", "material"}, {"g", "group"}};

/// The words in the rest of a line.
std::string rest_of_line(Tokenizer& tokens)
{
  std::string words;
  while (tokens.next_in_line()) words += (words.empty() ? "" : " ") + std::string(tokens.token());
  return words;
}

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

constexpr const char* color_channels[] = {"red", "green", "blue"};

/// The colors of vertices in OBJ: three numbers from 0 to 1 after the coordinates.
class Obj_colors {
public:
  /// Reads what follows the coordinates of the next vertex, a color or a weight.
  void read(Tokenizer& tokens)
  {
    ++m_vertices;
    std::vector<double> numbers;
    while (tokens.next_in_line()) numbers.push_back(tokens.number());
    if (numbers.size() != m_channels.size()) return;
    for (std::size_t k = 0; k < numbers.size(); ++k) m_channels[k].push_back(255 * numbers[k]);
  }
  /// As the channels of one byte that other formats have.
  void add_to(Polygon_mesh& mesh)
  {
    const std::size_t colored = m_channels[0].size();
    if (colored == m_vertices)
      for (std::size_t k = 0; k < m_channels.size(); ++k)
        mesh.properties.vertices.push_back(
            {color_channels[k], Number_type::uint8, std::move(m_channels[k])});
    else if (colored > 0)
      mesh.attributes.insert("colors of some vertices");
  }

private:
  std::size_t m_vertices = 0;
  std::array<std::vector<double>, std::size(color_channels)> m_channels;
};

/// The index of a vertex in OBJ, from 0; -1: there is none. \param n how many there are so far
int obj_corner(long long v, long long n)
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
    } catch (const Invalid_input_error& e) {
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

/// Reads the rest of a line: pairs of its vertices that follow each other.
void read_obj_line(Tokenizer& tokens, Polygon_mesh& mesh)
{
  const long long n = static_cast<long long>(mesh.soup.points.size());
  for (int last = -2; tokens.next_in_line();) {
    const int v = obj_corner(tokens.whole_number(true), n);
    if (last != -2) mesh.lines.push_back({last, v});
    last = v;
  }
}

} // namespace

Polygon_mesh parse_obj(std::string_view text)
{
  Tokenizer tokens(text);
  Polygon_mesh mesh;
  CGAL::PowerRTF::Polygon_soup& soup = mesh.soup;
  long long largest = 0; // index of a facet's vertex, and where it is
  Tokenizer at_largest = tokens;
  std::size_t facet_of_largest = 0;
  std::array<std::size_t, std::size(obj_attributes)> counts{};
  Obj_colors colors;
  Obj_texture texture;
  std::array<Obj_names, std::size(obj_names)> names;
  while (tokens.next()) {
    if (tokens.token() == "v") {
      Vec3d p{0, 0, 0};
      for (double* x : {&p.x, &p.y, &p.z}) {
        if (!tokens.next_in_line())
          reject(tokens.at() + "a vertex with fewer than three coordinates (a truncated file?)");
        *x = tokens.number();
      }
      soup.points.push_back(p);
      colors.read(tokens);
    } else if (tokens.token() == "f") {
      const std::size_t facet = soup.first.size() - 1, begin = soup.corners.size();
      const long long n = static_cast<long long>(soup.points.size());
      while (tokens.next_in_line()) {
        const long long v = tokens.whole_number(true);
        if (v == 0 || v < -n) reject(out_of_range(tokens, facet, v, soup.points.size()));
        soup.corners.push_back(obj_corner(v, n));
        texture.read_corner(tokens);
        if (v <= largest) continue;
        largest = v;
        at_largest = tokens;
        facet_of_largest = facet;
      }
      if (soup.corners.size() < begin + 3)
        reject(tokens.at() + "a facet with fewer than three vertices (a truncated file?)");
      soup.end_polygon();
      for (Obj_names& n : names) n.end_facet();
    } else if (tokens.token() == "s" && tokens.next_in_line()) {
      if (tokens.token() != "off" && tokens.token() != "0")
        mesh.attributes.insert("smoothing groups");
    } else {
      const std::string_view keyword = tokens.token();
      for (std::size_t k = 0; k < counts.size(); ++k)
        counts[k] += keyword == obj_attributes[k].keyword;
      for (std::size_t k = 0; k < names.size(); ++k)
        if (keyword == obj_names[k].keyword) names[k].read(tokens);
      if (keyword == "vt") texture.read(tokens);
      if (keyword == "l") read_obj_line(tokens, mesh);
      if (keyword == "mtllib") mesh.properties.material_files.push_back(rest_of_line(tokens));
    }
    tokens.skip_line();
  }
  if (soup.points.empty()) reject("it is not an OBJ file: it has no vertices");
  colors.add_to(mesh);
  texture.add_to(mesh);
  for (std::size_t k = 0; k < names.size(); ++k) names[k].add_to(mesh, obj_names[k].property);
  if (largest > static_cast<long long>(soup.points.size()))
    reject(out_of_range(at_largest, facet_of_largest, largest, soup.points.size()));
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (counts[k] > obj_attributes[k].meaningless)
      mesh.attributes.insert(obj_attributes[k].meaning);
  return mesh;
}

void write_obj(std::ostream& out, const std::vector<Vec3d>& points,
               const std::vector<Triangle>& triangles, const Mesh_properties& properties)
{
  std::vector<const Mesh_property*> colors;
  for (const char* const channel : color_channels)
    if (const Mesh_property* const p = find_property(properties.vertices, channel))
      colors.push_back(p);
  if (colors.size() != std::size(color_channels)) colors.clear();
  for (const std::string& file : properties.material_files) out << "mtllib " << file << '\n';
  write_rows(out, points.size(), [&](Text& text, std::size_t i) {
    text << "v " << points[i];
    for (const Mesh_property* const p : colors)
      text << " " << static_cast<float>(p->values[i] / (is_real(p->type) ? 1 : 255));
    text << "\n";
  });
  const Texture& texture = properties.texture;
  write_rows(out, texture.coordinates.size(), [&](Text& text, std::size_t i) {
    text << "vt";
    for (const double x : texture.coordinates[i])
      float(x) == x ? text << " " << float(x) : text << " " << x; // as short as it can be
    text << "\n";
  });
  std::vector<std::pair<std::string, const Mesh_property*>> names;
  for (const Obj_name& n : obj_names)
    if (const Mesh_property* const p = find_property(properties.faces, n.property);
        p && !p->names.empty())
      names.emplace_back(n.keyword, p);
  write_rows(out, triangles.size(), [&](Text& text, std::size_t i) {
    for (const auto& [keyword, p] : names)
      if (i == 0 || p->values[i] != p->values[i - 1])
        text << keyword.c_str() << " " << p->names[std::size_t(p->values[i])].c_str() << "\n";
    text << "f";
    for (std::size_t k = 0; k < 3; ++k) {
      text << " " << triangles[i][k] + 1;
      if (!texture.empty() && texture.corners[3 * i + k] >= 0)
        text << "/" << texture.corners[3 * i + k] + 1;
    }
    text << "\n";
  });
}

} // namespace tools
