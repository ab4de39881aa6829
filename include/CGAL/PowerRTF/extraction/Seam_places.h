// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which vertices of an opened surface are copies of one.
#ifndef CGAL_POWER_RTF_EXTRACTION_SEAM_PLACES_H
#define CGAL_POWER_RTF_EXTRACTION_SEAM_PLACES_H

#include <vector>

namespace CGAL::PowerRTF {

/// A place is a number that the copies of one vertex have in common; -1: there is one alone.
/// Vertices may also be at the same point by chance, where a surface passes through itself: those
/// are at different places.
struct Seam_places {
  std::vector<int> vertices; ///< by vertex of the opened surface; empty: all are alone
  std::vector<int> samples;  ///< by sample; of as many as the surface has samples, or empty
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXTRACTION_SEAM_PLACES_H
