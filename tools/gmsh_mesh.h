// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gmsh's meshes, for simulation: labels of the triangles are physical groups, on which a solver
// sets boundary conditions. (Gmsh 4.15 Reference Manual, "MSH file format version 2 (Legacy)",
// which more programs read than the later versions.)
#ifndef POWER_RTF_TOOLS_GMSH_MESH_H
#define POWER_RTF_TOOLS_GMSH_MESH_H

#include "Mesh_property.h"

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <iosfwd>
#include <vector>

namespace tools {

/// As text; the coordinates read back the same. The first property of the faces that has whole
/// numbers is the physical groups, named as its values are, or "NAME VALUE"; these begin at 1 where
/// a value is less, since Gmsh takes 0 for none. All properties are written as values, too.
void write_msh(std::ostream& out, const std::vector<CGAL::PowerRTF::Vec3d>& points,
               const std::vector<CGAL::PowerRTF::Triangle>& triangles,
               const Mesh_properties& properties = {});

} // namespace tools

#endif // POWER_RTF_TOOLS_GMSH_MESH_H
