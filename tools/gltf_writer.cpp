// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Base64.h"
#include "Bytes.h"
#include "gltf_file.h"
#include "gltf_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <ostream>
#include <tuple>
#include <utility>

namespace tools {
namespace {

using CGAL::PowerRTF::Triangle;
using CGAL::PowerRTF::Vec3d;

using Float3 = std::array<float, 3>;

Float3 floats(const Vec3d& p)
{
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

void append(std::string& bytes, std::uint64_t bits, int count)
{
  for (int i = 0; i < count; ++i) bytes += static_cast<char>(bits >> 8 * i);
}

void append(std::string& bytes, float x) { append(bytes, bit_cast<std::uint32_t>(x), 4); }

/// The normal at each corner, the mean of those of the facets around its vertex that make less than
/// 40 degrees with its own.
std::vector<Float3> corner_normals(const std::vector<Vec3d>& points,
                                   const std::vector<Triangle>& triangles)
{
  constexpr double cos_bent = 0.766; // of 40 degrees
  std::vector<Vec3d> normals;        // twice as long as the area
  for (const Triangle& t : triangles)
    normals.push_back(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
  std::vector<std::vector<int>> around(points.size());
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (const int v : triangles[f]) around[v].push_back(static_cast<int>(f));
  std::vector<Float3> result;
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (const int v : triangles[f]) {
      Vec3d sum{0, 0, 0};
      for (const int g : around[v])
        if (dot(normals[f], normals[g]) >= cos_bent * length(normals[f]) * length(normals[g]))
          sum += normals[g];
      const double size = length(sum);
      result.push_back(floats(size > 0 ? sum * (1 / size) : Vec3d{0, 0, 1}));
    }
  return result;
}

/// The parts of a file.
class Gltf_output {
public:
  Gltf_output() { m_json["asset"] = {{"version", "2.0"}, {"generator", "PowerRTF"}}; }

  Json& json() { return m_json; }
  /// Adds bytes to the buffer. \returns the number of their view
  std::size_t add_view(const std::string& bytes)
  {
    m_json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", m_bytes.size()}, {"byteLength", bytes.size()}});
    m_bytes += bytes;
    m_bytes.resize((m_bytes.size() + 3) / 4 * 4, '\0');
    return m_json["bufferViews"].size() - 1;
  }
  /// Adds an array of that many rows. \returns its number
  std::size_t add_array(const std::string& bytes, const char* type, int component, std::size_t rows)
  {
    const std::size_t view = add_view(bytes);
    m_json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", rows}, {"type", type}});
    return m_json["accessors"].size() - 1;
  }
  void write(std::ostream& out, bool is_binary)
  {
    Json& buffer = m_json["buffers"].emplace_back(Json::object({{"byteLength", m_bytes.size()}}));
    if (!is_binary) {
      buffer["uri"] = "data:application/octet-stream;base64," + to_base64(m_bytes);
      out << m_json.dump(1) << '\n';
      return;
    }
    std::string text = m_json.dump(), header;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    header = "glTF";
    append(header, 2, 4);
    append(header, 12 + 8 + text.size() + 8 + m_bytes.size(), 4);
    append(header, text.size(), 4);
    out << header << "JSON" << text;
    header.clear();
    append(header, m_bytes.size(), 4);
    out << header << std::string_view("BIN\0", 4) << m_bytes;
  }

private:
  Json m_json;
  std::string m_bytes;
};

constexpr int is_float = 5126, is_index = 5125, is_byte = 5121;

/// The vertices of a file, and of each corner its vertex.
struct Vertices {
  std::vector<int> points, coordinates; ///< -1: none
  std::vector<Float3> normals;
  std::vector<int> of_corners;

  Vertices(const std::vector<Vec3d>& all, const std::vector<Triangle>& triangles,
           const Texture& texture)
  {
    const std::vector<Float3> corner_normal = corner_normals(all, triangles);
    std::map<std::tuple<int, int, Float3>, int> numbers;
    for (std::size_t c = 0; c < corner_normal.size(); ++c) {
      const int v = triangles[c / 3][c % 3], uv = texture.empty() ? -1 : texture.corners[c];
      const auto [found, is_new] =
          numbers.emplace(std::tuple(v, uv, corner_normal[c]), static_cast<int>(points.size()));
      of_corners.push_back(found->second);
      if (!is_new) continue;
      points.push_back(v);
      coordinates.push_back(uv);
      normals.push_back(corner_normal[c]);
    }
  }
};

/// The attributes of the vertices, as the primitives refer to them.
Json attributes(Gltf_output& output, const Vertices& vertices, const std::vector<Vec3d>& points,
                const Mesh_properties& properties)
{
  std::string positions, normals, coordinates, colors;
  Float3 least{HUGE_VALF, HUGE_VALF, HUGE_VALF}, largest{-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
  std::vector<const Mesh_property*> channels;
  for (const char* const name : color_channels)
    if (const Mesh_property* const p = find_property(properties.vertices, name))
      channels.push_back(p);
  for (std::size_t i = 0; i < vertices.points.size(); ++i) {
    const int v = vertices.points[i], uv = vertices.coordinates[i];
    const Float3 p = floats(points[v]);
    for (int k = 0; k < 3; ++k) {
      least[k] = std::min(least[k], p[k]);
      largest[k] = std::max(largest[k], p[k]);
      append(positions, p[k]);
    }
    for (const float x : vertices.normals[i]) append(normals, x);
    if (!properties.texture.empty()) {
      const auto [s, t] = uv < 0 ? std::array{0., 0.} : properties.texture.coordinates[uv];
      append(coordinates, static_cast<float>(s));
      append(coordinates, static_cast<float>(1 - t)); // v goes down in glTF
    }
    for (const Mesh_property* const p : channels) {
      const double x = p->values[v] * (is_real(p->type) ? 255 : 1);
      append(colors, std::uint64_t(std::clamp(std::round(x), 0., 255.)), 1);
    }
    if (channels.size() == 3) colors += '\0'; // rows begin at multiples of four
  }
  const std::size_t count = vertices.points.size();
  Json result;
  result["POSITION"] = output.add_array(positions, "VEC3", is_float, count);
  output.json()["accessors"].back()["min"] = least;
  output.json()["accessors"].back()["max"] = largest;
  result["NORMAL"] = output.add_array(normals, "VEC3", is_float, count);
  if (!coordinates.empty())
    result["TEXCOORD_0"] = output.add_array(coordinates, "VEC2", is_float, count);
  if (channels.size() >= 3) {
    result["COLOR_0"] =
        output.add_array(colors, channels.size() == 3 ? "VEC3" : "VEC4", is_byte, count);
    output.json()["accessors"].back()["normalized"] = true;
    output.json()["bufferViews"].back()["byteStride"] = 4;
  }
  return result;
}

/// Adds what the materials look like; of those that have names only, just these.
void add_materials(Gltf_output& output, const Mesh_property& materials, const Gltf_materials& look)
{
  if (look.json.empty()) {
    for (const std::string& name : materials.names)
      output.json()["materials"].push_back({{"name", name}});
    return;
  }
  const Json kept = Json::parse(look.json);
  for (const auto& [name, value] : kept.items()) output.json()[name] = value;
  if (!kept.contains("images")) return;
  for (Json& image : output.json()["images"])
    if (image.contains("bufferView"))
      image["bufferView"] = output.add_view(look.images[image["bufferView"].get<std::size_t>()]);
}

} // namespace

void write_gltf(std::ostream& out, bool is_binary, const std::vector<Vec3d>& points,
                const std::vector<Triangle>& triangles, const Mesh_properties& properties)
{
  Gltf_output output;
  Json& json = output.json();
  json["scene"] = 0;
  json["scenes"] = Json::array({Json::object({{"nodes", Json::array({0})}})});
  json["nodes"] = Json::array({Json::object({{"mesh", 0}})});
  const Vertices vertices(points, triangles, properties.texture);
  const Json values = attributes(output, vertices, points, properties);
  const Mesh_property* materials = find_property(properties.faces, "material");
  if (materials && materials->names.empty()) materials = nullptr;
  if (materials) add_materials(output, *materials, properties.gltf_materials);
  std::map<double, std::string> indices; // by material
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      append(indices[materials ? materials->values[f] : 0],
             static_cast<std::uint64_t>(vertices.of_corners[3 * f + k]), 4);
  Json primitives = Json::array();
  for (const auto& [material, bytes] : indices) {
    Json primitive = {{"attributes", values},
                      {"indices", output.add_array(bytes, "SCALAR", is_index, bytes.size() / 4)}};
    if (materials && material < double(json["materials"].size()))
      primitive["material"] = static_cast<int>(material);
    primitives.push_back(primitive);
  }
  json["meshes"] = Json::array({Json::object({{"primitives", primitives}})});
  output.write(out, is_binary);
}

} // namespace tools
