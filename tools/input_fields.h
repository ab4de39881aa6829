// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the command line says about places of the input: fields and regions.
#ifndef POWER_RTF_TOOLS_INPUT_FIELDS_H
#define POWER_RTF_TOOLS_INPUT_FIELDS_H

#include "Polygon_mesh.h"
#include "options.h"

#include <CGAL/PowerRTF/Surface_fields.h>

#include <string>
#include <vector>

namespace tools {

/// A number for each vertex of `mesh`: its property `name`, or else the lines of the file `name`.
/// \throws Invalid_input_error there is neither; the file has other lines than a number for each
///   vertex; a facet's corner has a value that is not positive and finite
std::vector<double> vertex_values(const Polygon_mesh& mesh, const std::string& name);

/// The seams of a texture: the edges where its coordinates jump, or the material is another.
/// \param material a property of the facets; null: all have one
std::vector<CGAL::PowerRTF::Edge> texture_seams(const CGAL::PowerRTF::Polygon_soup& soup,
                                                const Texture& texture,
                                                const Mesh_property* material = nullptr);

/// The fields, regions and creases that the options name, of `mesh`.
/// \throws Invalid_input_error as `vertex_values()`; a label is no whole number; a line
///   runs along no edge of a facet; texture coordinates cannot be used
CGAL::PowerRTF::Surface_fields fields_of(const Program_options& options, const Polygon_mesh& mesh);

/// By facet of `mesh`: whether the options want it to be remeshed.
/// \throws Invalid_input_error the facets have no such property, or none has that value
std::vector<char> region_of(const Program_options& options, const Polygon_mesh& mesh);

/// Leaves of the materials, groups and texture of an OBJ file those that the options name, and of
/// what is not carried over names what these options do carry over no longer. The files of
/// materials get the names that they have for the output's file.
void choose_names(const Program_options& options, Polygon_mesh& mesh);

/// From `sphere:x,y,z,r,h` or `box:x0,y0,z0,x1,y1,z1,h`.
/// \throws Invalid_input_error it is neither
CGAL::PowerRTF::Refinement parse_refinement(const std::string& text);

} // namespace tools

#endif // POWER_RTF_TOOLS_INPUT_FIELDS_H
