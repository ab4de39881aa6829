// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "obj_materials.h"

#include "Tokenizer.h"
#include "gltf_file.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tools {
namespace {

struct Material {
  double color[4] = {1, 1, 1, 1};
  std::string folder, texture; ///< its file, in the folder; empty: none
};

void read_file(const std::string& file, std::map<std::string, Material>& materials)
{
  const std::size_t slash = file.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : file.substr(0, slash);
  const std::string text = bytes_of_file(folder, file.substr(slash + 1));
  Tokenizer tokens(text);
  Material* material = nullptr;
  while (tokens.next()) {
    const std::string_view keyword = tokens.token();
    if (keyword == "newmtl") {
      material = &materials[rest_of_line(tokens)];
      material->folder = folder;
    } else if (material && keyword == "map_Kd") {
      material->texture = rest_of_line(tokens);
    } else if (material && (keyword == "Kd" || keyword == "d")) {
      for (int k = keyword == "d" ? 3 : 0; k < 4 && tokens.next_in_line(); ++k)
        if (const double x = tokens.number_or_nan(); x >= 0 && x <= 1) material->color[k] = x;
    }
    tokens.skip_line();
  }
}

} // namespace

Gltf_materials read_materials(const std::vector<std::string>& files,
                              const std::vector<std::string>& names)
{
  std::map<std::string, Material> materials;
  for (const std::string& file : files) read_file(file, materials);
  if (std::none_of(names.begin(), names.end(),
                   [&](const std::string& name) { return materials.count(name) > 0; }))
    return {};
  Gltf_materials look;
  Json json = {{"materials", Json::array()}};
  for (const std::string& name : names) {
    const Material& material = materials[name];
    Json surface = {{"baseColorFactor", material.color}, {"metallicFactor", 0}};
    Json image = {{"uri", material.texture}};
    std::string bytes = image_of_file(material.folder, image);
    if (!bytes.empty()) {
      surface["baseColorTexture"] = {{"index", look.images.size()}};
      json["textures"].push_back({{"source", look.images.size()}});
      image["bufferView"] = look.images.size();
      json["images"].push_back(image);
      look.images.push_back(std::move(bytes));
    }
    Json entry = {{"name", name}, {"pbrMetallicRoughness", surface}};
    if (material.color[3] < 1) entry["alphaMode"] = "BLEND";
    json["materials"].push_back(entry);
  }
  look.json = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return look;
}

} // namespace tools
