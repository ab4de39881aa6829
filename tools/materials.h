// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What materials look like, from one format to another.
#ifndef POWER_RTF_TOOLS_MATERIALS_H
#define POWER_RTF_TOOLS_MATERIALS_H

#include "Mesh_property.h"

#include <array>
#include <string>
#include <vector>

namespace tools {

/// A material as all formats have it.
struct Material {
  std::string name;
  std::array<double, 4> color{1, 1, 1, 1}; ///< red, green, blue, opacity: from 0 to 1
  std::string texture;  ///< the file of its image, as seen from the mesh's folder; empty: none
  std::string bytes{};  ///< of its image, if that lies in the mesh's file
  std::string ending{}; ///< of the name of a file for these: ".png"
};

/// The materials of those names in files (`newmtl`, `Kd`, `d`, `map_Kd`) of a folder; none, if the
/// files cannot be read or have none of them.
std::vector<Material> materials_of_mtl(const std::string& folder,
                                       const std::vector<std::string>& files,
                                       const std::vector<std::string>& names);

/// The same of glTF (base color and its texture), in their order there.
std::vector<Material> materials_of_gltf(const Gltf_materials& look);

/// What glTF has of materials, with the images that are PNG or JPEG files of that folder.
Gltf_materials gltf_of_materials(const std::vector<Material>& materials, const std::string& folder);

/// The text of a file for OBJ. `names` are those of the image files, empty: none.
std::string mtl_of_materials(const std::vector<Material>& materials,
                             const std::vector<std::string>& names);

/// Makes what `input` says about the look of its materials what `output` can say: files of OBJ,
/// materials of glTF with their images, texture files and the property `texnumber` of PLY. Images
/// inside of a glTF file and materials of OBJ get files beside the output that are named after it,
/// `side_files`.
/// \param input, output files; the properties are those of the first
/// \returns false if the output's format has textures, but cannot say it
bool choose_look(const std::string& input, const std::string& output, Mesh_properties& properties);

} // namespace tools

#endif // POWER_RTF_TOOLS_MATERIALS_H
