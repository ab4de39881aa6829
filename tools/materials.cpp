// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials.h"

#include "Base64.h"
#include "Tokenizer.h"
#include "gltf_file.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

namespace tools {
namespace {

namespace fs = std::filesystem;

void read_mtl(const std::string& folder, const std::string& file,
              std::map<std::string, Material>& materials)
{
  const std::string text = bytes_of_file(folder, file);
  Tokenizer tokens(text);
  Material* material = nullptr;
  while (tokens.next()) {
    const std::string_view keyword = tokens.token();
    if (keyword == "newmtl") {
      const std::string name = rest_of_line(tokens);
      material = &materials[name];
      material->name = name;
    } else if (material && keyword == "map_Kd") {
      const std::string name = rest_of_line(tokens);
      if (!name.empty()) material->texture = (fs::path(file).parent_path() / name).generic_string();
    } else if (material && (keyword == "Kd" || keyword == "d")) {
      for (std::size_t k = keyword == "d" ? 3 : 0; k < 4 && tokens.next_in_line(); ++k)
        if (const double x = tokens.number_or_nan(); x >= 0 && x <= 1) material->color[k] = x;
    }
    tokens.skip_line();
  }
}

/// The element that `json` has by that name and number; null: there is none.
const Json* element_of(const Json& json, const char* name, const Json& number)
{
  const auto all = json.find(name);
  if (all == json.end() || !all->is_array() || !number.is_number_unsigned()) return nullptr;
  const auto i = number.get<std::size_t>();
  return i < all->size() && (*all)[i].is_object() ? &(*all)[i] : nullptr;
}

/// The value of a member; null, if there is none.
Json member(const Json& json, const char* name)
{
  const auto found = json.is_object() ? json.find(name) : json.end();
  return found == json.end() ? Json() : *found;
}

/// Gives a material the image of its glTF texture. Paths and data have the same place there.
void set_image(const Json& image, const Gltf_materials& look, Material& material)
{
  const Json view = member(image, "bufferView"), uri = member(image, "uri"),
             type = member(image, "mimeType");
  std::string mime = type.is_string() ? type.get<std::string>() : "image/png";
  if (view.is_number_unsigned() && view.get<std::size_t>() < look.images.size()) {
    material.bytes = look.images[view.get<std::size_t>()];
  } else if (uri.is_string()) {
    const std::string text = uri.get<std::string>();
    if (text.compare(0, 5, "data:") == 0) {
      mime = text.substr(5, text.find_first_of(";,") - 5);
      material.bytes =
          from_base64(std::string_view(text).substr((std::min)(text.find(',') + 1, text.size())),
                      std::numeric_limits<std::size_t>::max());
    } else {
      material.texture = name_of_uri(text);
    }
  }
  const std::string kind = mime.substr((std::min)(mime.find('/') + 1, mime.size()));
  const bool is_word = !kind.empty() && std::all_of(kind.begin(), kind.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
  });
  material.ending = kind == "jpeg" ? ".jpg" : "." + (is_word ? kind : "png");
}

/// The name of a file that `from`, a file, knows as `name`, for `to`, another file.
std::string seen_from(const std::string& to, const std::string& from, const std::string& name)
{
  const auto folder = [](const std::string& file) { return fs::absolute(file).parent_path(); };
  if (fs::path(name).is_absolute() || folder(from) == folder(to)) return name;
  return (folder(from) / name).lexically_relative(folder(to)).generic_string();
}

/// The names of the materials' images as seen from `output`; those that have no file get one.
std::vector<std::string> files_of_images(const std::vector<Material>& materials,
                                         const std::string& input, const std::string& output,
                                         std::vector<Side_file>& side_files)
{
  std::vector<std::string> names;
  std::map<std::string, std::string> known; // by the bytes
  const fs::path stem = fs::path(output).replace_extension();
  for (const Material& m : materials) {
    names.emplace_back();
    if (!m.texture.empty()) names.back() = seen_from(output, input, m.texture);
    if (m.bytes.empty()) continue;
    std::string& name = known[m.bytes];
    if (name.empty()) {
      const std::string file = stem.string() + "_" + std::to_string(known.size() - 1) + m.ending;
      name = fs::path(file).filename().string();
      side_files.push_back({file, m.bytes});
    }
    names.back() = name;
  }
  return names;
}

/// PLY: the files of textures, and which of them each facet has; -1: none.
void set_texture_numbers(const std::vector<std::string>& names, const Mesh_property& material,
                         Mesh_properties& properties)
{
  std::vector<std::string>& files = properties.texture_files;
  files.clear();
  std::vector<int> numbers;
  for (const std::string& name : names) {
    if (name.empty()) {
      numbers.push_back(-1);
      continue;
    }
    const auto found = std::find(files.begin(), files.end(), name);
    numbers.push_back(static_cast<int>(found - files.begin()));
    if (found == files.end()) files.push_back(name);
  }
  Mesh_property result{"texnumber", Number_type::int32, {}};
  for (const double m : material.values) {
    const auto i = static_cast<std::size_t>(m);
    result.values.push_back(i < numbers.size() ? numbers[i] : -1);
  }
  properties.faces.push_back(std::move(result));
}

/// Takes the images that are PNG or JPEG files into the mesh's file.
void embed_files(Gltf_materials& look, const std::string& folder)
{
  Json json = Json::parse(look.json);
  if (!json.contains("images")) return;
  for (Json& image : json["images"]) {
    std::string bytes = image.contains("bufferView") ? "" : image_of_file(folder, image);
    if (bytes.empty()) continue;
    image["bufferView"] = look.images.size();
    look.images.push_back(std::move(bytes));
  }
  look.json = json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::vector<Material> materials_of_mtl(const std::string& folder,
                                       const std::vector<std::string>& files,
                                       const std::vector<std::string>& names)
{
  std::map<std::string, Material> all;
  for (const std::string& file : files) read_mtl(folder, file, all);
  if (std::none_of(names.begin(), names.end(),
                   [&](const std::string& name) { return all.count(name) > 0; }))
    return {};
  std::vector<Material> result;
  for (const std::string& name : names) {
    result.push_back(all[name]);
    result.back().name = name;
  }
  return result;
}

std::vector<Material> materials_of_gltf(const Gltf_materials& look)
{
  const Json json = Json::parse(look.json);
  std::vector<Material> result;
  for (const Json& entry : member(json, "materials")) {
    const Json name = member(entry, "name"), surface = member(entry, "pbrMetallicRoughness"),
               color = member(surface, "baseColorFactor");
    Material material;
    material.name = name.is_string() ? name.get<std::string>() : std::to_string(result.size());
    for (std::size_t k = 0; k < 4 && color.is_array() && k < color.size(); ++k)
      if (color[k].is_number()) material.color[k] = std::clamp(color[k].get<double>(), 0., 1.);
    const Json number = member(member(surface, "baseColorTexture"), "index");
    if (const Json* const texture = element_of(json, "textures", number))
      if (const Json* const image = element_of(json, "images", member(*texture, "source")))
        set_image(*image, look, material);
    result.push_back(std::move(material));
  }
  return result;
}

Gltf_materials gltf_of_materials(const std::vector<Material>& materials, const std::string& folder)
{
  if (materials.empty()) return {};
  Gltf_materials look;
  Json json = {{"materials", Json::array()}};
  for (const Material& material : materials) {
    Json surface = {{"baseColorFactor", material.color}, {"metallicFactor", 0}};
    Json image = {{"uri", material.texture}};
    std::string bytes = image_of_file(folder, image);
    if (!bytes.empty()) {
      surface["baseColorTexture"] = {{"index", look.images.size()}};
      json["textures"].push_back({{"source", look.images.size()}});
      image["bufferView"] = look.images.size();
      json["images"].push_back(image);
      look.images.push_back(std::move(bytes));
    }
    Json entry = {{"name", material.name}, {"pbrMetallicRoughness", surface}};
    if (material.color[3] < 1) entry["alphaMode"] = "BLEND";
    json["materials"].push_back(entry);
  }
  look.json = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return look;
}

std::string mtl_of_materials(const std::vector<Material>& materials,
                             const std::vector<std::string>& names)
{
  std::ostringstream text;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    const auto& [red, green, blue, opacity] = materials[k].color;
    text << "newmtl " << materials[k].name << "\nKd " << red << ' ' << green << ' ' << blue << '\n';
    if (opacity < 1) text << "d " << opacity << '\n';
    if (!names[k].empty()) text << "map_Kd " << names[k] << '\n';
  }
  return text.str();
}

bool choose_look(const std::string& input, const std::string& output, Mesh_properties& properties)
{
  const Format format = format_of(output);
  const Mesh_property* const material = find_property(properties.faces, "material");
  const std::string folder = fs::path(input).parent_path().string();
  const std::vector<std::string> files = std::exchange(properties.material_files, {});
  Gltf_materials look = std::exchange(properties.gltf_materials, {});
  const bool is_told = !files.empty() || !look.json.empty();
  std::vector<Material> materials;
  if (!material || material->names.empty()) {
    properties.texture_files.clear();
    return true;
  }
  if (format == Format::obj && !files.empty()) {
    for (const std::string& file : files)
      properties.material_files.push_back(seen_from(output, input, file));
    return true;
  }
  if (is_gltf(format) && !look.json.empty()) {
    embed_files(look, folder);
    properties.gltf_materials = std::move(look);
    return true;
  }
  if (!files.empty())
    materials = materials_of_mtl(folder, files, material->names);
  else if (!look.json.empty())
    materials = materials_of_gltf(look);
  else
    for (const std::string& file : std::exchange(properties.texture_files, {}))
      materials.push_back({file, {1, 1, 1, 1}, file});
  if (materials.empty()) return !is_told || !holds_texture(format);
  if (is_gltf(format)) {
    properties.gltf_materials = gltf_of_materials(materials, folder);
  } else if (format == Format::obj) {
    const std::vector<std::string> names =
        files_of_images(materials, input, output, properties.side_files);
    const fs::path file = fs::path(output).replace_extension(".mtl");
    properties.side_files.push_back({file.string(), mtl_of_materials(materials, names)});
    properties.material_files = {file.filename().string()};
  } else if (format == Format::ply) {
    set_texture_numbers(files_of_images(materials, input, output, properties.side_files), *material,
                        properties);
    return std::all_of(materials.begin(), materials.end(), [](const Material& m) {
      return m.color == std::array<double, 4>{1, 1, 1, 1};
    });
  }
  return true;
}

} // namespace tools
