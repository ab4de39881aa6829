// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "input_fields.h"

#include "Tokenizer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace tools {
namespace {

using CGAL::PowerRTF::Invalid_input_error;
using CGAL::PowerRTF::Refinement;
using CGAL::PowerRTF::Surface_fields;

std::vector<double> numbers_of_file(const std::string& file, std::size_t count)
{
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Invalid_input_error(file + " cannot be read");
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::vector<double> values;
  Tokenizer tokens(text);
  try {
    while (tokens.next()) {
      values.push_back(tokens.number());
      if (tokens.next_in_line()) tokens.reject("is more than the one number of a line");
      tokens.skip_line();
    }
  } catch (const Invalid_input_error& e) {
    throw Invalid_input_error(file + ": " + e.what());
  }
  if (values.size() != count)
    throw Invalid_input_error(file + " has " + std::to_string(values.size()) +
                              " numbers, but the input has " + std::to_string(count) + " vertices");
  return values;
}

} // namespace

std::vector<double> vertex_values(const Polygon_mesh& mesh, const std::string& name)
{
  const std::vector<Mesh_property>& properties = mesh.properties.vertices;
  const auto checked = [&](std::vector<double> values, const std::string& where) {
    for (const int v : mesh.soup.corners)
      if (!(values[v] > 0) || !std::isfinite(values[v]))
        throw Invalid_input_error(where + ": the value of vertex " + std::to_string(v) +
                                  " (numbered from 0) is not a positive, finite number");
    return values;
  };
  if (const Mesh_property* const found = find_property(properties, name))
    return checked(found->values, "its property " + printable(name));
  if (std::filesystem::is_regular_file(name))
    return checked(numbers_of_file(name, mesh.soup.points.size()), name);
  std::string known;
  for (const Mesh_property& p : properties)
    known += (known.empty() ? "" : ", ") + printable(p.name);
  throw Invalid_input_error("its vertices have no property " + printable(name) +
                            ", and there is no such file; " +
                            (known.empty() ? "they have none" : "they have " + known));
}

Surface_fields fields_of(const Program_options& options, const Polygon_mesh& mesh)
{
  Surface_fields fields;
  if (!options.size_field.empty()) fields.sizes = vertex_values(mesh, options.size_field);
  if (!options.density_field.empty()) fields.densities = vertex_values(mesh, options.density_field);
  fields.refinements = options.refinements;
  return fields;
}

Refinement parse_refinement(const std::string& text)
{
  const std::size_t colon = text.find(':');
  const std::string shape = text.substr(0, colon);
  std::vector<double> x;
  const char* const end = text.data() + text.size();
  const char* at = text.data() + std::min(colon, text.size() - 1) + 1;
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
