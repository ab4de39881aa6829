// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: from samples to triangles.
#include <CGAL/PowerRTF/extraction/Opened_surface_impl.h>
#include <CGAL/PowerRTF/extraction/extract_by_insertion_impl.h>
#include <CGAL/PowerRTF/extraction/extract_from_cells_impl.h>

#include <CGAL/tags.h>

namespace CGAL::PowerRTF {

template Extracted_mesh
extract_from_cells<Sequential_tag>(const Surface&, const Samples&, const Feature_samples&,
                                   Neighbor_cycles&&, Cell_extraction_statistics*,
                                   const Bring_mesh&, const Find_sound_stars&);
#ifdef CGAL_LINKED_WITH_TBB
template Extracted_mesh extract_from_cells<Parallel_tag>(const Surface&, const Samples&,
                                                         const Feature_samples&, Neighbor_cycles&&,
                                                         Cell_extraction_statistics*,
                                                         const Bring_mesh&,
                                                         const Find_sound_stars&);
#endif

} // namespace CGAL::PowerRTF
