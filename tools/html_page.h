// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run as a page to look at. It is made of the files of page/, and needs no network: meshes and
// report are inside, and the viewer is WebGL without a library (a few hundred lines: the smallest
// that could be embedded, three.js, has 600 KB and would be needed for building).
#ifndef POWER_RTF_TOOLS_HTML_PAGE_H
#define POWER_RTF_TOOLS_HTML_PAGE_H

#include <CGAL/PowerRTF/cells/Cell_polygon.h>
#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace tools {

/// Writes the page: input and output side by side, turned together, colored by quality, distance,
/// area or density, or the cells by their sides; histograms of angles, quality, lengths and
/// distances; the report; the worst triangles.
///
/// \param mesh, cells in the coordinates of the unit box, as `surface`
/// \param report what `write_json()` writes
void write_html(std::ostream& out, const CGAL::PowerRTF::Surface& surface,
                const CGAL::PowerRTF::Extracted_mesh& mesh,
                const std::vector<CGAL::PowerRTF::Cell_polygon>& cells, const std::string& report);

} // namespace tools

#endif // POWER_RTF_TOOLS_HTML_PAGE_H
