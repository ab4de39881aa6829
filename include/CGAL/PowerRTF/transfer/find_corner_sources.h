// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the corners of a result's triangles come from, for values that jump at edges of the input,
// as texture coordinates do at the seams of an atlas.
#ifndef CGAL_POWER_RTF_TRANSFER_FIND_CORNER_SOURCES_H
#define CGAL_POWER_RTF_TRANSFER_FIND_CORNER_SOURCES_H

#include <CGAL/PowerRTF/transfer/find_sources.h>

#include <array>
#include <vector>

namespace CGAL::PowerRTF {

/// By triangle the sources of its corners. A corner has the source of its vertex, unless a seam
/// parts that from the source of the triangle; then it has the place nearest to it on the
/// triangle's side of the seam. So corners of a vertex differ only where seams part their
/// triangles.
///
/// \param input, normalization, points, triangles as for `find_sources()`
/// \param sources what that has found
/// \param seams pairs of points of `input`: edges of its polygons
std::vector<std::array<Source, 3>>
find_corner_sources(const Polygon_soup& input, const std::vector<Edge>& seams,
                    const Normalization& normalization, const std::vector<Vec3d>& points,
                    const std::vector<Triangle>& triangles, const Sources& sources,
                    internal::Concurrency concurrency = Sequential_tag());

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/transfer/find_corner_sources_impl.h>
#endif

#endif // CGAL_POWER_RTF_TRANSFER_FIND_CORNER_SOURCES_H
