// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "input_fields.h"

#include "Tokenizer.h"
#include "materials.h"

#include <CGAL/PowerRTF/input/near_borders.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>

namespace tools {
namespace {

using CGAL::PowerRTF::Edge;
using CGAL::PowerRTF::Invalid_input_error;
using CGAL::PowerRTF::Refinement;
using CGAL::PowerRTF::Surface_fields;

/// Calls `read(tokens)` for the lines of a file, at the first token of each, which reads it and all
/// others there.
template <class Read>
void read_lines(const std::string& file, const Read& read)
{
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Invalid_input_error(file + " cannot be read");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  Tokenizer tokens(text);
  try {
    while (tokens.next()) {
      read(tokens);
      if (tokens.next_in_line()) tokens.reject("is more than belongs into a line");
      tokens.skip_line();
    }
  } catch (const Invalid_input_error& e) {
    throw Invalid_input_error(file + ": " + e.what());
  }
}

std::vector<double> numbers_of_file(const std::string& file, std::size_t count)
{
  std::vector<double> values;
  read_lines(file, [&](const Tokenizer& tokens) { values.push_back(tokens.number()); });
  if (values.size() != count)
    throw Invalid_input_error(file + " has " + std::to_string(values.size()) +
                              " numbers, but the input has " + std::to_string(count) + " vertices");
  return values;
}

std::string names_of(const std::vector<Mesh_property>& properties)
{
  std::string names;
  for (const Mesh_property& p : properties)
    names += (names.empty() ? "" : ", ") + printable(p.name);
  return names.empty() ? "they have none" : "they have " + names;
}

const Mesh_property& face_property(const Polygon_mesh& mesh, const std::string& name)
{
  const std::vector<Mesh_property>& properties = mesh.properties.faces;
  const Mesh_property* const found = find_property(properties, name);
  if (!found)
    throw Invalid_input_error("its facets have no property " + printable(name) + "; " +
                              names_of(properties));
  return *found;
}

std::vector<int> face_labels(const Polygon_mesh& mesh, const std::string& name)
{
  const std::vector<double>& values = face_property(mesh, name).values;
  std::vector<int> labels;
  labels.reserve(values.size());
  for (const double x : values) {
    if (x != std::floor(x) || std::abs(x) > std::numeric_limits<int>::max())
      throw Invalid_input_error("its property " + printable(name) + ": the value of facet " +
                                std::to_string(labels.size()) +
                                " (numbered from 0) is no whole number");
    labels.push_back(static_cast<int>(x));
  }
  return labels;
}

/// The number that stands for the value `text` of a property; none if there is no such value.
std::optional<double> value_of(const Mesh_property& property, const std::string& text)
{
  if (!property.names.empty()) {
    const auto name = std::find(property.names.begin(), property.names.end(), text);
    if (name == property.names.end()) return std::nullopt;
    return static_cast<double>(name - property.names.begin());
  }
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end) return std::nullopt;
  return property.type == Number_type::float32 ? static_cast<float>(number) : number;
}

/// Pairs of vertices.
std::vector<Edge> edges_of_file(const std::string& file)
{
  std::vector<Edge> edges;
  read_lines(file, [&](Tokenizer& tokens) {
    const int first = corner(tokens.whole_number());
    if (!tokens.next_in_line()) throw Invalid_input_error(tokens.at() + "it has one number only");
    edges.push_back({first, corner(tokens.whole_number())});
  });
  return edges;
}

/// \throws Invalid_input_error one of `lines` does not run along an edge of a facet
void check_lines(const Polygon_mesh& mesh, const std::vector<Edge>& lines, const std::string& what)
{
  using CGAL::PowerRTF::sorted_edge;
  const auto& [points, corners, first, merges_vertices] = mesh.soup;
  const std::vector<int> place = CGAL::PowerRTF::first_of_equal_points(points);
  std::vector<Edge> edges;
  for (std::size_t k = 0; k + 1 < first.size(); ++k)
    for (int c = first[k]; c < first[k + 1]; ++c) {
      const int next = corners[c + 1 < first[k + 1] ? c + 1 : first[k]];
      edges.push_back(sorted_edge(place[corners[c]], place[next]));
    }
  CGAL::PowerRTF::sort_uniquely(edges);
  const int count = static_cast<int>(points.size());
  for (const auto& [a, b] : lines) {
    const bool is_known = 0 <= a && a < count && 0 <= b && b < count;
    if (!is_known ||
        !std::binary_search(edges.begin(), edges.end(), sorted_edge(place[a], place[b])))
      throw Invalid_input_error(what + " from vertex " + std::to_string(a) + " to " +
                                std::to_string(b) +
                                " (numbered from 0) runs along no edge of a facet");
  }
}

/// The points that the file lists, which are vertices of facets.
const std::vector<int>& checked_dots(const Polygon_mesh& mesh)
{
  const std::vector<int> place = CGAL::PowerRTF::first_of_equal_points(mesh.soup.points);
  std::vector<char> is_used(place.size(), 0);
  for (const int v : mesh.soup.corners) is_used[place[v]] = 1;
  for (const int v : mesh.dots)
    if (v < 0 || v >= static_cast<int>(place.size()) || !is_used[place[v]])
      throw Invalid_input_error("its point at vertex " + std::to_string(v) +
                                " (numbered from 0) is no vertex of a facet");
  return mesh.dots;
}

/// \throws Invalid_input_error the texture coordinates cannot be used
std::vector<Edge> seams_of(const Polygon_mesh& mesh)
{
  if (!mesh.texture_error.empty())
    throw Invalid_input_error("its texture coordinates cannot be used: " + mesh.texture_error);
  return texture_seams(mesh.soup, mesh.properties.texture,
                       find_property(mesh.properties.faces, "material"));
}

/// A number for each vertex of `mesh`, and where they are from: its property `name`, or else the
/// lines of the file `name`.
std::pair<std::vector<double>, std::string> numbers_of(const Polygon_mesh& mesh,
                                                       const std::string& name)
{
  const std::vector<Mesh_property>& properties = mesh.properties.vertices;
  if (const Mesh_property* const found = find_property(properties, name))
    return {found->values, "its property " + printable(name)};
  if (std::filesystem::is_regular_file(name))
    return {numbers_of_file(name, mesh.soup.points.size()), name};
  throw Invalid_input_error("its vertices have no property " + printable(name) +
                            ", and there is no such file; " + names_of(properties));
}

/// The vertices whose number is not 0; see `numbers_of()`.
std::vector<int> corners_of(const Polygon_mesh& mesh, const std::string& name)
{
  const auto [values, where] = numbers_of(mesh, name);
  std::vector<int> corners;
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (!std::isfinite(values[v]))
      throw Invalid_input_error(where + ": the value of vertex " + std::to_string(v) +
                                " (numbered from 0) is not finite");
    if (values[v] != 0) corners.push_back(static_cast<int>(v));
  }
  return corners;
}

} // namespace

std::vector<double> vertex_values(const Polygon_mesh& mesh, const std::string& name)
{
  auto [values, where] = numbers_of(mesh, name);
  for (const int v : mesh.soup.corners)
    if (!(values[v] > 0) || !std::isfinite(values[v]))
      throw Invalid_input_error(where + ": the value of vertex " + std::to_string(v) +
                                " (numbered from 0) is not a positive, finite number");
  return std::move(values);
}

std::vector<Edge> texture_seams(const CGAL::PowerRTF::Polygon_soup& soup, const Texture& texture,
                                const Mesh_property* material)
{
  if (texture.empty()) return {};
  using Place = std::array<double, 3>; // material, u, v
  const auto place = [&](std::size_t face, int corner) {
    const double name = material ? material->values[face] : 0;
    const int c = texture.corners[corner];
    if (c < 0) return Place{name, HUGE_VAL, HUGE_VAL};
    return Place{name, texture.coordinates[c][0], texture.coordinates[c][1]};
  };
  struct Side {
    Edge edge; // of places
    std::array<Place, 2> texture;
    Edge points;
  };
  const std::vector<int> first = CGAL::PowerRTF::first_of_equal_points(soup.points);
  std::vector<Side> sides;
  for (std::size_t k = 0; k + 1 < soup.first.size(); ++k)
    for (int c = soup.first[k]; c < soup.first[k + 1]; ++c) {
      const int d = c + 1 < soup.first[k + 1] ? c + 1 : soup.first[k];
      const int a = soup.corners[c], b = soup.corners[d];
      Side side{{first[a], first[b]}, {place(k, c), place(k, d)}, {a, b}};
      if (first[b] < first[a]) {
        std::swap(side.edge[0], side.edge[1]);
        std::swap(side.texture[0], side.texture[1]);
      }
      sides.push_back(side);
    }
  std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
    return std::tie(s.edge, s.texture, s.points) < std::tie(t.edge, t.texture, t.points);
  });
  std::vector<Edge> seams;
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i].edge == sides[i - 1].edge && sides[i].texture != sides[i - 1].texture)
      seams.push_back(sides[i].points);
  return seams;
}

Surface_fields fields_of(const Program_options& options, const Polygon_mesh& mesh)
{
  Surface_fields fields;
  if (!options.size_field.empty()) fields.sizes = vertex_values(mesh, options.size_field);
  if (!options.density_field.empty()) fields.densities = vertex_values(mesh, options.density_field);
  for (const std::string& region : options.refine)
    fields.refinements.push_back(parse_refinement(region));
  if (!options.labels.empty()) fields.labels = face_labels(mesh, options.labels);
  const auto add_lines = [&](const std::vector<Edge>& lines, const std::string& what) {
    check_lines(mesh, lines, what);
    fields.lines.insert(fields.lines.end(), lines.begin(), lines.end());
  };
  if (options.keeps_lines) add_lines(mesh.lines, "its line");
  if (!options.creases.empty())
    add_lines(edges_of_file(options.creases), options.creases + ": the edge");
  if (!options.corners.empty()) fields.kept_vertices = corners_of(mesh, options.corners);
  if (options.keeps_points) {
    const std::vector<int>& dots = checked_dots(mesh);
    fields.kept_vertices.insert(fields.kept_vertices.end(), dots.begin(), dots.end());
  }
  if (options.keeps_texture) {
    const std::vector<Edge> seams = seams_of(mesh);
    fields.lines.insert(fields.lines.end(), seams.begin(), seams.end());
  }
  return fields;
}

std::vector<char> region_of(const Program_options& options, const Polygon_mesh& mesh)
{
  const Mesh_property& property = face_property(mesh, options.region_name);
  const std::optional<double> wanted = value_of(property, options.region_value);
  std::vector<char> is_inside;
  is_inside.reserve(property.values.size());
  for (const double x : property.values) is_inside.push_back(wanted && x == *wanted);
  if (std::find(is_inside.begin(), is_inside.end(), 1) == is_inside.end())
    throw Invalid_input_error("its property " + printable(options.region_name) +
                              " is at no facet " + printable(options.region_value));
  return is_inside;
}

void choose_names(const Program_options& options, Polygon_mesh& mesh)
{
  if (options.keeps_lines) mesh.attributes.erase("lines");
  if (options.keeps_points) mesh.attributes.erase("points");
  std::vector<Mesh_property>& faces = mesh.properties.faces;
  if (options.keeps_texture)
    mesh.attributes.erase("texture coordinates");
  else
    mesh.properties.texture = {};
  const auto is_unwanted = [&](const Mesh_property& p) {
    if (p.name == "texnumber") return !options.keeps_texture;
    return !p.names.empty() && p.name != options.labels && p.name != options.region_name &&
           (p.name != "material" || !options.keeps_texture);
  };
  faces.erase(std::remove_if(faces.begin(), faces.end(), is_unwanted), faces.end());
  for (const Mesh_property& p : faces) {
    if (p.names.empty()) continue;
    mesh.attributes.erase(p.name + "s");
    const Format output = format_of(options.output);
    const std::vector<std::string>& files = mesh.properties.texture_files; // of images, as in PLY
    const bool are_files = !files.empty() && p.name == "material";
    if (!(holds_names(output) || are_files) || (is_gltf(output) && p.name != "material"))
      mesh.attributes.insert("names of " + p.name + "s");
  }
  if (!choose_look(options.input, options.output, mesh.properties))
    mesh.attributes.insert("the look of materials");
  const bool has_numbers = find_property(faces, "texnumber") != nullptr;
  faces.erase(std::remove_if(faces.begin(), faces.end(),
                             [&](const Mesh_property& p) { // the same is there as texnumber
                               return has_numbers && p.name == "material" && !p.names.empty() &&
                                      p.name != options.labels;
                             }),
              faces.end());
}

Refinement parse_refinement(const std::string& text)
{
  const std::size_t colon = text.find(':');
  const std::string shape = text.substr(0, colon);
  std::vector<double> x;
  const char* const end = text.data() + text.size();
  const char* at = colon == std::string::npos ? end : text.data() + colon + 1;
  for (bool more = colon != std::string::npos; more;) {
    double number = 0;
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error != std::errc()) {
      x.clear();
      break;
    }
    x.push_back(number);
    more = stop != end && *stop == ',';
    at = stop + more;
  }
  if (at == end && shape == "sphere" && x.size() == 5)
    return Refinement::sphere({x[0], x[1], x[2]}, x[3], x[4]);
  if (at == end && shape == "box" && x.size() == 7)
    return Refinement::box({x[0], x[1], x[2]}, {x[3], x[4], x[5]}, x[6]);
  throw Invalid_input_error("'" + text +
                            "' is neither sphere:x,y,z,r,h nor box:x0,y0,z0,x1,y1,z1,h");
}

} // namespace tools
