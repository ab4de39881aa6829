// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesh_property.h"

#include "Tokenizer.h"

#include <map>

namespace tools {
namespace {

bool is_held(Format format, const Mesh_property& property, bool of_vertices)
{
  if (holds_numbers(format)) return true;
  if (!holds_texture(format)) return false;
  if (of_vertices) return is_color(property.name) && (property.name != "alpha" || is_gltf(format));
  return !property.names.empty() && (property.name == "material" || format == Format::obj);
}

} // namespace

const Mesh_property* find_property(const std::vector<Mesh_property>& properties,
                                   const std::string& name)
{
  const auto found =
      std::find_if(properties.begin(), properties.end(),
                   [&](const Mesh_property& property) { return property.name == name; });
  return found == properties.end() ? nullptr : &*found;
}

bool is_color(const std::string& name)
{
  return std::find(color_channels.begin(), color_channels.end(), name) != color_channels.end();
}

std::string in_words(const std::string& name, bool of_vertices)
{
  static const std::map<std::string, const char*> meanings = {{"nx", "normals"},
                                                              {"ny", "normals"},
                                                              {"nz", "normals"},
                                                              {"s", "texture coordinates"},
                                                              {"t", "texture coordinates"},
                                                              {"u", "texture coordinates"},
                                                              {"v", "texture coordinates"},
                                                              {"texture_u", "texture coordinates"},
                                                              {"texture_v", "texture coordinates"},
                                                              {"texcoord", "texture coordinates"},
                                                              {"texnumber", "numbers of textures"}};
  if (is_color(name)) return "colors";
  const auto known = meanings.find(name);
  if (known != meanings.end()) return known->second;
  return (of_vertices ? "vertex property " : "facet property ") + printable(name);
}

Mesh_properties held_by(Format format, const Mesh_properties& properties)
{
  Mesh_properties held = properties;
  const auto drop = [format](std::vector<Mesh_property>& from, bool of_vertices) {
    from.erase(
        std::remove_if(from.begin(), from.end(),
                       [&](const Mesh_property& p) { return !is_held(format, p, of_vertices); }),
        from.end());
  };
  drop(held.vertices, true);
  drop(held.faces, false);
  if (!holds_texture(format)) held.texture = {};
  return held;
}

std::set<std::string> not_held_by(Format format, const Mesh_properties& properties)
{
  std::set<std::string> words;
  for (const Mesh_property& p : properties.vertices)
    if (!is_held(format, p, true)) words.insert(in_words(p.name, true));
  for (const Mesh_property& p : properties.faces)
    if (!is_held(format, p, false)) words.insert(in_words(p.name, false));
  if (!properties.texture.empty() && !holds_texture(format)) words.insert("texture coordinates");
  return words;
}

} // namespace tools
