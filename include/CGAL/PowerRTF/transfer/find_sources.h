// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the vertices and faces of a result come from: places on the input as its user has it,
// before any repair, and with its own numbers of faces and vertices.
#ifndef CGAL_POWER_RTF_TRANSFER_FIND_SOURCES_H
#define CGAL_POWER_RTF_TRANSFER_FIND_SOURCES_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/input/Polygon_soup.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/transfer/Sources.h>

#include <vector>

namespace CGAL::PowerRTF {

/// The sources of a mesh: the places of `input` that are nearest to its vertices, which need not
/// lie on it exactly, and to the centers of its triangles. Where the other side of a thin part is
/// nearer, it does not count: a source faces the same way as what comes from it, unless there is no
/// such place within half the longest edge there.
///
/// \param normalization of the surface that the soup has become
/// \param is_oriented whether that surface is oriented as the soup is; if not, sides are not told
///   apart
/// \param points, triangles the mesh, in coordinates of the unit box
/// \param finds_shares whether the sources of other points of faces are found, too
/// \pre `input` has been remeshed: its polygons have finite coordinates, and some have an area
Sources find_sources(const Polygon_soup& input, const Normalization& normalization,
                     bool is_oriented, const std::vector<Vec3d>& points,
                     const std::vector<Triangle>& triangles,
                     internal::Concurrency concurrency = Sequential_tag(),
                     bool finds_shares = false);

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/transfer/find_sources_impl.h>
#endif

#endif // CGAL_POWER_RTF_TRANSFER_FIND_SOURCES_H
