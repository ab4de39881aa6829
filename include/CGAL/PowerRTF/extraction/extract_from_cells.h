// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From samples and their cells to triangles, with the guarantees of extract_by_insertion.h: the
// triangles on which the cells agree, and insertion and decimation where they do not.
#ifndef CGAL_POWER_RTF_EXTRACTION_EXTRACT_FROM_CELLS_H
#define CGAL_POWER_RTF_EXTRACTION_EXTRACT_FROM_CELLS_H

#include <CGAL/PowerRTF/cells/Find_sound_stars.h>
#include <CGAL/PowerRTF/cells/Neighbor_cycles.h>
#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/internal/compiled.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// What `extract_from_cells()` had to do.
struct Cell_extraction_statistics {
  std::size_t open_samples = 0;   ///< around which triangles were made by insertion
  std::size_t pieces = 0;         ///< of the surface, for that
  bool is_from_insertion = false; ///< all triangles were
};

/// A mesh on the samples as `extract_by_insertion()` makes it, with the same guarantees. Its
/// triangles are those on which the cells of all their corners agree. Where the cells leave gaps,
/// or the triangles lie badly, the piece of the surface there is triangulated by insertion and
/// decimation; pieces that do not touch, side by side. What comes of it is checked as a whole: that
/// it has the topology of the surface, all samples, all pieces of creases and borders, and no
/// self-intersections; otherwise all is done by `extract_by_insertion()`.
///
/// `neighbors`: of the cells of the samples that lie on no feature, as
/// `PowerRTFEngine::neighbors()` has them. `bring`: brings the mesh to where an engine works, or is
/// empty; `find_sound`: what finds cells whose triangles are sound instead, where it does.
/// The result is the same for any number of threads.
template <class ConcurrencyTag>
Extracted_mesh
extract_from_cells(const Surface& surface, const Samples& samples, const Feature_samples& features,
                   Neighbor_cycles&& neighbors, Cell_extraction_statistics* statistics = nullptr,
                   const Bring_mesh& bring = {}, const Find_sound_stars& find_sound = {});

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/extraction/extract_from_cells_impl.h>
#endif

#endif // CGAL_POWER_RTF_EXTRACTION_EXTRACT_FROM_CELLS_H
