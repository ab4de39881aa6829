// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh as it is read from a file.
#ifndef POWER_RTF_TOOLS_POLYGON_MESH_H
#define POWER_RTF_TOOLS_POLYGON_MESH_H

#include "Mesh_property.h"

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/input/Polygon_soup.h>

#include <limits>
#include <set>
#include <string>
#include <vector>

namespace tools {

struct Polygon_mesh {
  CGAL::PowerRTF::Polygon_soup soup;
  Mesh_properties properties;
  std::vector<CGAL::PowerRTF::Edge> lines; ///< pairs of points: pieces of the file's lines
  std::vector<int> dots;                   ///< points that the file lists alone
  std::string texture_error;               ///< why the file's texture coordinates cannot be used
  std::set<std::string> attributes; ///< what else the file had, in words: "texture coordinates"
};

/// A number of a file as a corner of a polygon; -1, which no point has, if it is too large.
inline int corner(long long number)
{
  return number >= 0 && number < std::numeric_limits<int>::max() ? static_cast<int>(number) : -1;
}

} // namespace tools

#endif // POWER_RTF_TOOLS_POLYGON_MESH_H
