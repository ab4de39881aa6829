// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for extract_from_cells.h.
#ifndef CGAL_POWER_RTF_EXTRACTION_EXTRACT_FROM_CELLS_IMPL_H
#define CGAL_POWER_RTF_EXTRACTION_EXTRACT_FROM_CELLS_IMPL_H

#include <CGAL/PowerRTF/extraction/Mended_stars.h>
#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/extraction/extract_from_cells.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

template <class ConcurrencyTag>
Extracted_mesh extract_from_cells(const Surface& surface, const Samples& samples,
                                  const Feature_samples& features, Neighbor_cycles&& neighbors,
                                  Cell_extraction_statistics* statistics, const Bring_mesh& bring,
                                  const Find_sound_stars& find_sound)
{
  internal::Progress_part part(0.3);
  internal::Mended_stars<ConcurrencyTag> stars(surface, samples, features, std::move(neighbors),
                                               bring, find_sound);
  part.next(0.95); // what follows is rare
  const bool is_mended = stars.mend();
  if (statistics) *statistics = {stars.open_samples(), stars.pieces(), !is_mended};
  return is_mended ? std::move(stars.mesh()) : extract_by_insertion(surface, samples, features);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXTRACTION_EXTRACT_FROM_CELLS_IMPL_H
