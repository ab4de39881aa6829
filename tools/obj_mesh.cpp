// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "obj_mesh.h"

#include "Obj_attributes.h"
#include "Text.h"
#include "Tokenizer.h"

#include <array>
#include <iterator>
#include <utility>

namespace tools {
namespace {

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

Vec3d read_obj_point(Tokenizer& tokens)
{
  Vec3d p{0, 0, 0};
  for (double* x : {&p.x, &p.y, &p.z}) {
    if (!tokens.next_in_line())
      reject(tokens.at() + "a vertex with fewer than three coordinates (a truncated file?)");
    *x = tokens.number();
  }
  return p;
}

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

/// Reads the rest of a line: vertices.
void read_obj_dots(Tokenizer& tokens, Polygon_mesh& mesh)
{
  const long long n = static_cast<long long>(mesh.soup.points.size());
  while (tokens.next_in_line()) mesh.dots.push_back(obj_corner(tokens.whole_number(true), n));
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
      soup.points.push_back(read_obj_point(tokens));
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
      if (keyword == "p") read_obj_dots(tokens, mesh);
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
  for (std::size_t k = 0; k < Obj_colors::channels; ++k)
    if (const Mesh_property* const p = find_property(properties.vertices, color_channels[k]))
      colors.push_back(p);
  if (colors.size() != Obj_colors::channels) colors.clear();
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
