// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of the cells and of the samples, in the coordinates and units of the input.
#ifndef POWER_RTF_TOOLS_CELLS_IO_H
#define POWER_RTF_TOOLS_CELLS_IO_H

#include "Format.h"

#include <CGAL/PowerRTF/cells/Cell_polygon.h>
#include <CGAL/PowerRTF/geometry/Surface.h>

#include <cstddef>
#include <iosfwd>
#include <vector>

namespace tools {

/// Writes the polygons F_i with the number of their sample (from 0), weight w_i, mass m_i, density
/// rho_i and status (0: ok, 1: guarded, 2: empty, 3: incomplete). Empty cells have no polygon.
/// `format` is ply or vtp; `encoding` is that of PLY.
/// \param half 0, or the number of samples in one half of a symmetric surface: the second half of
///   the cells are the images of the first, and their samples come after these
void write_cells(std::ostream& out, Format format, Encoding encoding,
                 const std::vector<CGAL::PowerRTF::Cell_polygon>& cells,
                 const CGAL::PowerRTF::Normalization& normalization, std::size_t half = 0);

/// Writes the samples with normals n_i, weights w_i and densities rho_i.
void write_samples(std::ostream& out, Format format, Encoding encoding,
                   const CGAL::PowerRTF::Samples& samples,
                   const CGAL::PowerRTF::Normalization& normalization);

} // namespace tools

#endif // POWER_RTF_TOOLS_CELLS_IO_H
