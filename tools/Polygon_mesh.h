// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh as it is read from a file.
#ifndef POWER_RTF_TOOLS_POLYGON_MESH_H
#define POWER_RTF_TOOLS_POLYGON_MESH_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace tools {

struct Polygon_mesh {
  std::vector<CGAL::PowerRTF::Vec3d> points;
  std::vector<std::vector<std::size_t>> polygons; ///< indices into `points`
  std::set<std::string> attributes;               ///< what else the file had, in words: "normals"
};

} // namespace tools

#endif // POWER_RTF_TOOLS_POLYGON_MESH_H
