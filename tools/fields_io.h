// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The file of a lattice's fields, in the coordinates and units of the input.
#ifndef POWER_RTF_TOOLS_FIELDS_IO_H
#define POWER_RTF_TOOLS_FIELDS_IO_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/sampling/Lattice_fields.h>

#include <iosfwd>

namespace tools {

/// Writes VTP: the lattice's points as vertices, and for each node a line of half the spacing along
/// the node's row, with the node in its middle. Their values, as cell data:
///
/// - `node`: the number of the node (from 0), for a point that of the node nearest to it
/// - `is_point`: 1 for a point of the lattice, 0 for a node
/// - `normal`, `axis`, `spacing`: the node's
/// - `index`, `dislocation`: what is wrong in the loop around the node (see lattice_defects.h), 0
///   where nothing is, and for points of the lattice
void write_fields(std::ostream& out, const CGAL::PowerRTF::Lattice_fields& fields,
                  const CGAL::PowerRTF::Normalization& normalization);

} // namespace tools

#endif // POWER_RTF_TOOLS_FIELDS_IO_H
