// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Tokenizer.h"
#include "gltf_file.h"
#include "gltf_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tools {
namespace {

using CGAL::PowerRTF::Vec3d;

constexpr std::size_t none = 0xffffffff;

/// An affine map: the images of the axes, and of the origin.
struct Placement {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};

  Vec3d vector(const Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d operator()(const Vec3d& p) const { return vector(p) + origin; }
  Placement operator*(const Placement& inner) const
  {
    return {vector(inner.x), vector(inner.y), vector(inner.z), (*this)(inner.origin)};
  }
  bool is_mirror() const { return dot(cross(x, y), z) < 0; }
};

template <std::size_t n>
std::array<double, n> numbers(const Json& node, const char* name, std::array<double, n> usual)
{
  const auto found = node.find(name);
  if (found == node.end()) return usual;
  if (!found->is_array() || found->size() != n)
    reject(std::string("the ") + name + " of a node has not " + std::to_string(n) + " numbers");
  for (std::size_t i = 0; i < n; ++i) usual[i] = (*found)[i].get<double>();
  return usual;
}

Placement placement_of(const Json& node)
{
  if (node.contains("matrix")) {
    const auto m = numbers<16>(node, "matrix", {});
    const auto column = [&](int k) { return Vec3d{m[4 * k], m[4 * k + 1], m[4 * k + 2]}; };
    return {column(0), column(1), column(2), column(3)};
  }
  const auto t = numbers<3>(node, "translation", {0, 0, 0});
  const auto s = numbers<3>(node, "scale", {1, 1, 1});
  const auto [x, y, z, w] = numbers<4>(node, "rotation", {0, 0, 0, 1});
  return {Vec3d{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)} * s[0],
          Vec3d{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)} * s[1],
          Vec3d{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)} * s[2],
          {t[0], t[1], t[2]}};
}

class Gltf_reader {
public:
  Gltf_reader(std::string_view data, const std::string& folder) : m_file(data, folder) {}

  Polygon_mesh read()
  {
    const std::size_t count = m_file.json().value("nodes", Json::array()).size();
    std::vector<char> is_seen(count, 0);
    std::vector<std::pair<std::size_t, Placement>> nodes;
    for (const std::size_t root : roots(count)) nodes.emplace_back(root, Placement());
    while (!nodes.empty()) {
      const auto [i, place] = nodes.back();
      nodes.pop_back();
      const Json& node = m_file.element("nodes", i);
      if (std::exchange(is_seen[i], 1)) reject("its nodes are no trees: one has two parents");
      const Placement here = place * placement_of(node);
      for (const Json& child : node.value("children", Json::array()))
        nodes.emplace_back(child.get<std::size_t>(), here);
      const std::size_t mesh = gltf_number(node, "mesh", none);
      if (mesh != none)
        for (const Json& primitive : m_file.element("meshes", mesh).at("primitives"))
          read_primitive(primitive, here);
    }
    add_properties();
    return std::move(m_mesh);
  }

private:
  /// The nodes of the scene; without scenes, those that are no children.
  std::vector<std::size_t> roots(std::size_t count) const
  {
    if (m_file.json().contains("scenes")) {
      const Json& scene = m_file.element("scenes", gltf_number(m_file.json(), "scene", 0));
      return scene.value("nodes", std::vector<std::size_t>());
    }
    std::vector<char> is_child(count, 0);
    for (std::size_t i = 0; i < count; ++i)
      for (const std::size_t child :
           m_file.element("nodes", i).value("children", std::vector<std::size_t>()))
        if (child < count) is_child[child] = 1;
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < count; ++i)
      if (!is_child[i]) result.push_back(i);
    return result;
  }

  void read_primitive(const Json& primitive, const Placement& place)
  {
    constexpr std::size_t triangles = 4, strip = 5, fan = 6;
    const std::size_t mode = gltf_number(primitive, "mode", triangles);
    if (mode < triangles || mode > fan) {
      m_mesh.attributes.insert(mode == 0 ? "points" : "lines");
      return;
    }
    const Json& attributes = primitive.at("attributes");
    const Gltf_array positions = array(attributes, "POSITION");
    if (positions.components != 3) reject("a mesh has no positions of three coordinates");
    std::vector<Vec3d>& points = m_mesh.soup.points;
    const std::size_t first = points.size(), count = positions.rows;
    for (std::size_t i = 0; i < count; ++i)
      points.push_back(place({positions(i, 0), positions(i, 1), positions(i, 2)}));

    Texture& texture = m_mesh.properties.texture;
    const Gltf_array uv = array(attributes, "TEXCOORD_0"), colors = array(attributes, "COLOR_0");
    const bool has_uv = uv.components == 2 && uv.rows == count;
    texture.coordinates.resize(points.size(), {0, 0});
    for (std::size_t i = 0; has_uv && i < count; ++i) {
      texture.coordinates[first + i] = {uv(i, 0), 1 - uv(i, 1)}; // v goes down in glTF
      if (!std::isfinite(uv(i, 0)) || !std::isfinite(uv(i, 1)))
        m_mesh.texture_error = "they are not finite";
    }
    m_has_uv = m_has_uv || has_uv;
    if (colors.components >= 3 && colors.rows == count) {
      m_channels = std::max(m_channels, colors.components);
      m_colors.resize(first, {1, 1, 1, 1});
      for (std::size_t i = 0; i < count; ++i)
        m_colors.push_back(
            {colors(i, 0), colors(i, 1), colors(i, 2), colors.components > 3 ? colors(i, 3) : 1});
    }

    std::vector<std::size_t> indices;
    if (primitive.contains("indices"))
      for (const double x : m_file.accessor(gltf_number(primitive, "indices", none)).values)
        indices.push_back(x >= 0 && x < double(count) ? first + std::size_t(x) : none);
    else
      for (std::size_t i = 0; i < count; ++i) indices.push_back(first + i);
    const std::size_t step = mode == triangles ? 3 : 1;
    for (std::size_t i = 0; i + 2 < indices.size(); i += step) {
      const bool is_turned = place.is_mirror() != (mode == strip && i % 2 == 1);
      const std::size_t a = mode == fan ? 0 : i;
      for (const std::size_t k : {a, i + 1 + is_turned, i + 2 - is_turned}) {
        m_mesh.soup.corners.push_back(corner(static_cast<long long>(indices[k])));
        texture.corners.push_back(has_uv ? m_mesh.soup.corners.back() : -1);
      }
      m_mesh.soup.end_polygon();
      m_materials.push_back(double(gltf_number(primitive, "material", none)));
    }
  }

  /// An attribute of vertices; nothing, if there is none.
  Gltf_array array(const Json& attributes, const char* name) const
  {
    const std::size_t accessor = gltf_number(attributes, name, none);
    return accessor == none ? Gltf_array() : m_file.accessor(accessor);
  }

  void add_properties()
  {
    Mesh_properties& properties = m_mesh.properties;
    if (m_has_uv)
      m_mesh.attributes.insert("texture coordinates");
    else
      properties.texture = {};
    m_colors.resize(m_mesh.soup.points.size(), {1, 1, 1, 1});
    for (std::size_t k = 0; k < std::min(m_channels, color_channels.size()); ++k) {
      Mesh_property channel{color_channels[k], Number_type::uint8, {}};
      for (const auto& color : m_colors) channel.values.push_back(255 * color[k]);
      properties.vertices.push_back(std::move(channel));
    }
    add_materials();
  }

  /// The materials as a property of the faces, and what they look like.
  void add_materials()
  {
    const Json materials = m_file.json().value("materials", Json::array());
    if (materials.empty()) return;
    Mesh_property property{"material", Number_type::int32, {}};
    for (std::size_t i = 0; i < materials.size(); ++i)
      property.names.push_back(m_file.element("materials", i).value("name", std::to_string(i)));
    const double count = double(materials.size());
    if (std::any_of(m_materials.begin(), m_materials.end(), [&](double m) { return m >= count; }))
      property.names.emplace_back("default");
    for (const double m : m_materials) property.values.push_back(std::min(m, count));
    m_mesh.properties.faces.push_back(std::move(property));
    m_mesh.attributes.insert("materials");

    Gltf_materials& look = m_mesh.properties.gltf_materials;
    Json kept = Json::object();
    for (const char* name : {"materials", "textures", "samplers", "images"})
      if (m_file.json().contains(name)) kept[name] = m_file.json()[name];
    if (kept.contains("images"))
      for (Json& image : kept["images"]) {
        const std::size_t view = gltf_number(image, "bufferView", none);
        if (view == none) continue; // a file
        std::string bytes(m_file.view(view));
        image["bufferView"] = look.images.size();
        look.images.push_back(std::move(bytes));
      }
    look.json = kept.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

  Gltf_file m_file;
  Polygon_mesh m_mesh;
  bool m_has_uv = false;
  std::size_t m_channels = 0;
  std::vector<std::array<double, 4>> m_colors; // of the first points
  std::vector<double> m_materials;             // of the triangles; `none`
};

} // namespace

Polygon_mesh parse_gltf(std::string_view data, const std::string& folder)
{
  try {
    return Gltf_reader(data, folder).read();
  } catch (const Json::exception& e) {
    reject(std::string("its JSON is not that of a mesh: ") + e.what());
  }
}

} // namespace tools
