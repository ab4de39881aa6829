// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the materials of OBJ files look like, for glTF.
#ifndef POWER_RTF_TOOLS_OBJ_MATERIALS_H
#define POWER_RTF_TOOLS_OBJ_MATERIALS_H

#include "Mesh_property.h"

#include <string>
#include <vector>

namespace tools {

/// Reads the diffuse color (`Kd`), its texture (`map_Kd`: PNG and JPEG, the whole file) and the
/// opacity (`d`) of materials from MTL files. What cannot be read is left out; where no material is
/// found, there is nothing.
/// \param names of the materials
Gltf_materials read_materials(const std::vector<std::string>& files,
                              const std::vector<std::string>& names);

} // namespace tools

#endif // POWER_RTF_TOOLS_OBJ_MATERIALS_H
