// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// glTF as text and binary: read, with its scene's transformations and its materials, and written.
#include "Base64.h"
#include "gltf_file.h"
#include "mesh_data.h"

#include <doctest/doctest.h>

using namespace mesh_data;
using namespace tools;
using CGAL::PowerRTF::Polygon_soup;
using CGAL::PowerRTF::Triangle;

namespace {

using Values = std::vector<double>;

/// Makes files of one buffer.
class Gltf {
public:
  Json json = {{"asset", {{"version", "2.0"}}}};

  template <class Number>
  std::size_t add(const std::string& type, int component, const std::vector<Number>& numbers,
                  std::size_t rows, std::size_t stride = 0)
  {
    json["bufferViews"].push_back({{"buffer", 0},
                                   {"byteOffset", m_bytes.size()},
                                   {"byteLength", numbers.size() * sizeof(Number)}});
    if (stride > 0) json["bufferViews"].back()["byteStride"] = stride;
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", component},
                                 {"type", type},
                                 {"count", rows}});
    m_bytes.append(reinterpret_cast<const char*>(numbers.data()), // of this machine
                   numbers.size() * sizeof(Number));
    m_bytes.resize((m_bytes.size() + 3) / 4 * 4, '\0');
    return json["accessors"].size() - 1;
  }
  std::string text() const
  {
    Json all = json;
    all["buffers"] = Json::array(
        {{{"byteLength", m_bytes.size()}, {"uri", "data:;base64," + to_base64(m_bytes)}}});
    return all.dump();
  }
  std::string binary() const
  {
    Json all = json;
    all["buffers"] = Json::array({{{"byteLength", m_bytes.size()}}});
    std::string text = all.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto number = [](std::size_t x) {
      std::string bytes;
      for (int i = 0; i < 4; ++i) bytes += static_cast<char>(x >> 8 * i);
      return bytes;
    };
    return "glTF" + number(2) + number(28 + text.size() + m_bytes.size()) + number(text.size()) +
           "JSON" + text + number(m_bytes.size()) + std::string("BIN\0", 4) + m_bytes;
  }

private:
  std::string m_bytes;
};

/// Two triangles of a square, in two meshes; the second one by a node in a node, mirrored, with
/// bytes as colors, and short numbers as coordinates.
Gltf scene()
{
  Gltf gltf;
  const std::vector<float> square = {0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9, 1, 1, 0, 9}; // with a gap
  const auto positions = gltf.add("VEC3", 5126, square, 4, 16);
  const auto uv = gltf.add("VEC2", 5126, std::vector<float>{0, 0, 1, 0, 0, 0.25, 1, 1}, 4);
  const auto shorts =
      gltf.add("VEC2", 5123, std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 65535, 65535, 65535}, 4);
  gltf.json["accessors"].back()["normalized"] = true;
  const auto colors = gltf.add("VEC4", 5121, std::vector<std::uint8_t>(16, 51), 4);
  gltf.json["accessors"].back()["normalized"] = true;
  const auto bytes = gltf.add("SCALAR", 5121, std::vector<std::uint8_t>{0, 1, 2}, 3);
  gltf.json["materials"] = {{{"name", "wood"}}, {{"name", "steel"}}};
  gltf.json["meshes"] = Json::parse(R"([{"primitives": []}, {"primitives": []}])");
  gltf.json["meshes"][0]["primitives"].push_back(
      {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uv}}},
       {"indices", bytes},
       {"material", 1}});
  gltf.json["meshes"][1]["primitives"].push_back(
      {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", shorts}, {"COLOR_0", colors}}},
       {"mode", 5}});
  gltf.json["nodes"] = Json::parse(
      R"([{"mesh": 0, "children": [1]}, {"translation": [0, 0, 2], "children": [2],
          "rotation": [0, 0, 0.70710678118654757, 0.70710678118654757]},
          {"scale": [-1, 1, 3], "mesh": 1}, {"mesh": 0}])");
  gltf.json["scenes"] = Json::parse(R"([{"nodes": [0]}])");
  return gltf;
}

bool near(const Vec3d& p, const Vec3d& q) { return length(p - q) < 1e-12; }

} // namespace

TEST_CASE("a scene becomes one mesh, with all transformations")
{
  const Gltf gltf = scene();
  for (const bool is_binary : {false, true}) {
    const Polygon_mesh mesh = parse_mesh(Format::glb, is_binary ? gltf.binary() : gltf.text());
    REQUIRE(mesh.soup.points.size() == 8);
    CHECK(near(mesh.soup.points[1], {1, 0, 0}));
    CHECK(near(mesh.soup.points[5], {0, -1, 2})); // mirrored to -x, turned to -y, lifted
    CHECK(near(mesh.soup.points[6], {-1, 0, 2}));
    CHECK(polygons_of(mesh) ==
          std::vector<std::vector<std::size_t>>{{0, 1, 2}, {4, 6, 5}, {5, 6, 7}});
    const Texture& texture = mesh.properties.texture;
    CHECK(texture.corners == mesh.soup.corners);
    CHECK(texture.coordinates[2] == std::array{0., 0.75}); // v goes up
    CHECK(texture.coordinates[6] == std::array{0., 0.});
    REQUIRE(mesh.properties.vertices.size() == 4);
    CHECK(mesh.properties.vertices[3].values == Values{255, 255, 255, 255, 51, 51, 51, 51});
    CHECK(mesh.properties.faces.at(0).names ==
          std::vector<std::string>{"wood", "steel", "default"});
    CHECK(mesh.properties.faces[0].values == Values{1, 2, 2});
    CHECK(mesh.attributes == std::set<std::string>{"materials", "texture coordinates"});
  }
  Gltf without = scene();
  without.json.erase("scenes");
  CHECK(parse_mesh(Format::gltf, without.text()).soup.points.size() == 12);
}

TEST_CASE("what is written is read as it was, with its materials and images; seams are doubled")
{
  Mesh_properties properties;
  properties.texture = {{{0, 0}, {0.5, 1}, {1, 0.25}}, {0, 1, 2, 2, 1, 1, 0, 0, 0}};
  for (const char* const name : {"red", "green", "blue", "alpha"})
    properties.vertices.push_back({name, Number_type::uint8, {0, 1, 2, 200, 255}});
  properties.faces.push_back({"material", Number_type::int32, {1, 0, 1}, {"wood", "steel"}});
  properties.gltf_materials = {
      R"({"materials":[{"name":"wood"},{"name":"steel","pbrMetallicRoughness":{"metallicFactor":0.5}}],)"
      R"("images":[{"mimeType":"image/png","bufferView":0}],"textures":[{"source":0}]})",
      {"the bytes of an image"}};
  const std::vector<Triangle> triangles = {{{0, 1, 2}}, {{1, 3, 2}}, {{0, 3, 4}}};
  for (const Format format : {Format::gltf, Format::glb}) {
    std::ostringstream out;
    write_mesh(out, format, Encoding::binary, points, triangles, properties);
    const Polygon_mesh mesh = parse_mesh(format, out.str());
    const Polygon_soup& soup = mesh.soup;
    REQUIRE(soup.corners.size() == 9);
    const std::size_t order[] = {1, 0, 2}; // by material
    for (std::size_t f = 0; f < 3; ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const int c = soup.corners[3 * f + k], v = triangles[order[f]][k];
        CHECK(near(soup.points[c], points[v]));
        CHECK(mesh.properties.texture.coordinates[c] ==
              properties.texture.coordinates[properties.texture.corners[3 * order[f] + k]]);
        CHECK(mesh.properties.vertices.at(1).values[c] ==
              doctest::Approx(properties.vertices[1].values[v]));
      }
    CHECK(mesh.properties.faces.at(0).values == Values{0, 1, 1});
    CHECK(mesh.properties.faces[0].names == properties.faces[0].names);
    CHECK(mesh.properties.gltf_materials.images == properties.gltf_materials.images);
    CHECK(nlohmann::json::parse(mesh.properties.gltf_materials.json) ==
          nlohmann::json::parse(properties.gltf_materials.json));
  }
}

TEST_CASE("normals are of length 1, and one at smooth vertices only")
{
  std::ostringstream out;
  const std::vector<Vec3d> bent = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.1}, {1, -1, 1}};
  write_mesh(out, Format::glb, Encoding::binary, bent, {{{0, 1, 2}}, {{1, 3, 2}}, {{0, 4, 1}}}, {});
  const std::string data = out.str();
  const Gltf_file file(data, "");
  const Json& attributes = file.element("meshes", 0)["primitives"][0]["attributes"];
  const Gltf_array normals = file.accessor(attributes["NORMAL"].get<std::size_t>());
  CHECK(normals.rows == 7); // two vertices are doubled at the sharp edge
  for (std::size_t i = 0; i < normals.rows; ++i)
    CHECK(std::hypot(normals(i, 0), normals(i, 1), normals(i, 2)) ==
          doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("glTF: what is malformed is told")
{
  const auto changed = [](const std::string& pointer, const Json& value) {
    Gltf gltf = scene();
    gltf.json[Json::json_pointer(pointer)] = value;
    return gltf.text();
  };
  const std::string binary = scene().binary();
  struct Case {
    std::string data, reason;
  };
  for (const Case& c : {
           Case{"{", "its JSON is wrong"},
           {"[1, 2]", "it has no asset"},
           {"{}", "it has no asset"},
           {std::string(1000, '['), "nested too deeply"},
           {R"({"asset": {}})", "it has no facets"},
           {binary.substr(0, 10), "truncated in its header"},
           {binary.substr(0, binary.size() - 30), "truncated: it has only"},
           {"glTF" + std::string("\1\0\0\0", 4) + std::string(20, ' '), "version 1"},
           {changed("/accessors/0/count", 5), "an accessor goes beyond its buffer"},
           {changed("/accessors/0/count", -1), "count is not a whole number"},
           {changed("/accessors/0/count", "x"), "count is not a whole number"},
           {changed("/accessors/0/componentType", 7), "unknown type 7"},
           {changed("/accessors/0/type", 7), "its JSON is not that of a mesh"},
           {changed("/accessors/0/sparse", Json::object()), "sparse"},
           {changed("/bufferViews/0/byteLength", 1000000), "a buffer is truncated"},
           {changed("/bufferViews/0/byteStride", 0), "an accessor goes beyond its buffer"},
           {changed("/nodes/2/children", {0}), "one has two parents"},
           {changed("/nodes/2/scale", {1, 2}), "the scale of a node has not 3 numbers"},
           {changed("/nodes/2/mesh", 9), "refers to meshes that do not exist: number 9"},
           {changed("/meshes/0/primitives/0/attributes", Json::object()), "no positions"},
           {changed("/extensionsRequired", {"KHR_draco_mesh_compression"}),
            "KHR_draco_mesh_compression"},
       }) {
    CAPTURE(c.data);
    const std::string is = reason(Format::gltf, c.data);
    CAPTURE(is);
    CHECK(is.find(c.reason) != std::string::npos);
  }
  Gltf beyond = scene();
  const auto wrong = beyond.add("SCALAR", 5125, std::vector<std::uint32_t>{0, 1, 4}, 3);
  beyond.json["meshes"][0]["primitives"][0]["indices"] = wrong;
  CHECK(reason(Format::gltf, beyond.text()).find("facet 1 refers to a vertex") !=
        std::string::npos);
}
