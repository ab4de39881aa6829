// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stl_mesh.h"

#include "Tokenizer.h"

#include <boost/functional/hash.hpp>

#include <array>
#include <cstdint>
#include <cstring>
#include <unordered_map>

namespace tools {
namespace {

using CGAL::PowerRTF::Invalid_input_error;

constexpr std::size_t header_size = 84, facet_size = 50; // bytes, of a binary file

/// Collects triangles one by one into a mesh.
class Triangle_collector {
public:
  using Corner = std::array<double, 3>;

  void add(const std::array<Corner, 3>& corners)
  {
    CGAL::PowerRTF::Polygon_soup& soup = m_mesh.soup;
    for (const Corner& c : corners) {
      const auto [place, is_new] = m_indices.try_emplace(c, soup.points.size());
      if (is_new) soup.points.push_back({c[0], c[1], c[2]});
      soup.corners.push_back(corner(static_cast<long long>(place->second)));
    }
    soup.end_polygon();
  }
  Polygon_mesh& mesh() { return m_mesh; }

private:
  Polygon_mesh m_mesh;
  std::unordered_map<Corner, std::size_t, boost::hash<Corner>> m_indices;
};

/// A number of the file, which is little-endian.
std::uint32_t load_bits(const char* bytes)
{
  std::uint32_t bits = 0;
  for (int i = 3; i >= 0; --i) bits = bits << 8 | static_cast<unsigned char>(bytes[i]);
  return bits;
}

float load_float(const char* bytes)
{
  const std::uint32_t bits = load_bits(bytes);
  float x;
  std::memcpy(&x, &bits, sizeof(x));
  return x;
}

Polygon_mesh parse_binary(std::string_view data)
{
  if (data.size() < header_size)
    throw Invalid_input_error("it is not an STL file, or truncated in its header");
  if (!is_binary_stl(data, data.size()))
    throw Invalid_input_error("it is not an STL file, or truncated: its header announces " +
                              std::to_string(load_bits(data.data() + 80)) +
                              " facets, the file has room for " +
                              std::to_string((data.size() - header_size) / facet_size));
  Triangle_collector triangles;
  bool same_attributes = true; // the last two bytes of all facets, often a color
  const std::string_view facets = data.substr(header_size);
  for (std::size_t f = 0; f < facets.size() / facet_size; ++f) {
    if (f % 1024 == 0) CGAL::PowerRTF::internal::Cancellation::poll(f * facet_size, facets.size());
    const char* const facet = facets.data() + f * facet_size; // a normal, three corners, two bytes
    std::array<Triangle_collector::Corner, 3> corners;
    for (std::size_t k = 0; k < 9; ++k) corners[k / 3][k % 3] = load_float(facet + 12 + 4 * k);
    triangles.add(corners);
    same_attributes = same_attributes && std::memcmp(facet + 48, facets.data() + 48, 2) == 0;
  }
  if (!same_attributes) triangles.mesh().attributes.insert("facet attributes");
  return std::move(triangles.mesh());
}

/// Reads what follows the token "facet" up to "endfacet".
std::array<Triangle_collector::Corner, 3> read_facet(Tokenizer& tokens)
{
  std::array<Triangle_collector::Corner, 3> corners{};
  std::size_t count = 0;
  const auto next = [&tokens] {
    if (!tokens.next()) throw Invalid_input_error("the file is truncated: it ends in a facet");
    return tokens.token();
  };
  while (next() != "endfacet") { // other tokens carry no information
    if (tokens.token() != "vertex") continue;
    if (count == 3)
      throw Invalid_input_error(tokens.at() + "a facet with more than three vertices");
    for (double& x : corners[count]) {
      next();
      x = tokens.number();
    }
    ++count;
  }
  if (count < 3) throw Invalid_input_error(tokens.at() + "a facet with fewer than three vertices");
  return corners;
}

/// Skips the name of a solid: all tokens but those that begin or end its parts.
void skip_name(Tokenizer& tokens)
{
  for (Tokenizer ahead = tokens;
       ahead.next_in_line() && ahead.token() != "facet" && ahead.token() != "endsolid";)
    tokens = ahead;
}

Polygon_mesh parse_text(std::string_view data)
{
  Triangle_collector triangles;
  Tokenizer tokens(data, '\n');
  std::size_t solids = 0;
  bool ended = false;
  while (tokens.next()) {
    if (tokens.token() == "facet")
      triangles.add(read_facet(tokens));
    else if (tokens.token() == "vertex" || tokens.token() == "endfacet")
      tokens.reject("stands outside of a facet");
    else if (tokens.token() == "solid" || tokens.token() == "endsolid") {
      ended = tokens.token() == "endsolid";
      solids += !ended;
      skip_name(tokens);
    }
  }
  if (!ended) throw Invalid_input_error("the file is truncated: it does not end with endsolid");
  if (solids > 1) triangles.mesh().attributes.insert("groups");
  return std::move(triangles.mesh());
}

} // namespace

bool is_binary_stl(std::string_view beginning, std::uintmax_t size)
{
  return beginning.size() >= header_size &&
         (size - header_size) / facet_size == load_bits(beginning.data() + 80);
}

Polygon_mesh parse_stl(std::string_view data)
{
  if (is_binary_stl(data, data.size())) return parse_binary(data);
  Tokenizer tokens(data);
  const bool is_text = tokens.next() && tokens.token().substr(0, 5) == "solid";
  return is_text ? parse_text(data) : parse_binary(data);
}

} // namespace tools
