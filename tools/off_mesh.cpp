// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "off_mesh.h"

#include "Text.h"
#include "Tokenizer.h"

#include <utility>

namespace tools {
namespace {

using CGAL::PowerRTF::Triangle;
using CGAL::PowerRTF::Vec3d;

struct Off_header {
  std::string_view prefixes; // for more values per vertex: ST (texture), C (color), N (normal)
  std::size_t vertices, facets;
  std::string announced; // these numbers, for messages
};

Off_header parse_off_header(Tokenizer& tokens, std::size_t bytes)
{
  const bool is_off = tokens.next() && tokens.token().size() <= 7 && tokens.token().size() >= 3 &&
                      tokens.token().substr(tokens.token().size() - 3) == "OFF";
  if (!is_off) reject("it is not an OFF file: it does not begin with OFF");
  const std::string_view prefixes = tokens.token().substr(0, tokens.token().size() - 3);
  if (prefixes.find_first_not_of("STCN") != std::string_view::npos)
    tokens.reject("is a kind of OFF that is not read");

  std::size_t counts[2]; // vertices, facets
  for (std::size_t& count : counts) {
    if (!tokens.next()) reject("the file is truncated in its header");
    if (tokens.token() == "BINARY") tokens.reject("is a kind of OFF that is not read");
    const long long value = tokens.whole_number();
    if (value < 0) tokens.reject("is not a number of vertices or facets");
    count = static_cast<std::size_t>(value);
  }
  tokens.skip_line(); // the number of edges
  std::string announced = ", its header announces " + std::to_string(counts[0]) + " vertices and " +
                          std::to_string(counts[1]) + " facets";
  // every vertex and every facet takes a few bytes
  if (counts[0] > bytes || counts[1] > bytes)
    reject("the file is truncated: it has only " + std::to_string(bytes) + " bytes" + announced);
  return {prefixes, counts[0], counts[1], std::move(announced)};
}

} // namespace

Polygon_mesh parse_off(std::string_view text)
{
  Tokenizer tokens(text);
  const Off_header header = parse_off_header(tokens, text.size());
  Polygon_mesh mesh;
  for (const auto& [letter, meaning] :
       {std::pair{'S', "texture coordinates"}, {'C', "colors"}, {'N', "normals"}})
    if (header.prefixes.find(letter) != std::string_view::npos) mesh.attributes.insert(meaning);

  mesh.soup.points.resize(header.vertices);
  mesh.soup.reserve_polygons(header.facets);
  for (std::size_t i = 0; i < header.vertices; ++i) {
    Vec3d& p = mesh.soup.points[i];
    for (double* x : {&p.x, &p.y, &p.z}) {
      if (!tokens.next())
        reject("the file is truncated: it ends in vertex " + std::to_string(i + 1) +
               header.announced);
      *x = tokens.number();
    }
    if (!header.prefixes.empty()) tokens.skip_line();
  }
  bool has_colors = false;
  for (std::size_t i = 0; i < header.facets; ++i) {
    const auto next = [&] {
      if (!tokens.next())
        reject("the file is truncated: it ends in facet " + std::to_string(i + 1) +
               header.announced);
      return tokens.whole_number();
    };
    const long long size = next();
    if (size < 0) tokens.reject("is not a number of vertices");
    for (long long k = 0; k < size; ++k) {
      const long long v = next();
      if (v < 0 || v >= static_cast<long long>(header.vertices))
        reject(out_of_range(tokens, i, v, header.vertices));
      mesh.soup.corners.push_back(corner(v));
    }
    mesh.soup.end_polygon();
    has_colors = has_colors || tokens.next_in_line();
    tokens.skip_line();
  }
  if (has_colors) mesh.attributes.insert("colors");
  return mesh;
}

void write_off(std::ostream& out, const std::vector<Vec3d>& points,
               const std::vector<Triangle>& triangles)
{
  out << "OFF\n" << points.size() << ' ' << triangles.size() << " 0\n";
  write_rows(out, points.size(), [&](Text& text, std::size_t i) { text << points[i] << "\n"; });
  write_rows(out, triangles.size(), [&](Text& text, std::size_t i) {
    const Triangle& t = triangles[i];
    text << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  });
}

} // namespace tools
