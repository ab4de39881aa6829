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

#include <array>
#include <vector>

namespace CGAL::PowerRTF {

/// A place on a polygon soup.
struct Source {
  int face = -1;                          ///< the number of the polygon
  Triangle vertices{-1, -1, -1};          ///< the corners of a triangle of that polygon
  std::array<double, 3> weights{0, 0, 0}; ///< barycentric coordinates in it: none negative, sum 1
};

/// The sources of a mesh.
struct Sources {
  std::vector<Source> vertices, faces; ///< those of the faces are the sources of their centers
  /// By triangle those of its corners, where they are asked for: see `find_corner_sources()`.
  std::vector<std::array<Source, 3>> corners{};
};

/// The sources of a mesh: the places of `input` that are nearest to its vertices, which need not
/// lie on it exactly, and to the centers of its triangles. Where the other side of a thin part is
/// nearer, it does not count: a source faces the same way as what comes from it, unless there is no
/// such place within half the longest edge there.
///
/// \param normalization of the surface that the soup has become
/// \param is_oriented whether that surface is oriented as the soup is; if not, sides are not told
///   apart
/// \param points, triangles the mesh, in coordinates of the unit box
/// \pre `input` has been remeshed: its polygons have finite coordinates, and some have an area
Sources find_sources(const Polygon_soup& input, const Normalization& normalization,
                     bool is_oriented, const std::vector<Vec3d>& points,
                     const std::vector<Triangle>& triangles,
                     internal::Concurrency concurrency = Sequential_tag());

/// The values of the polygons that the sources are on.
template <class T>
std::vector<T> values_at(const std::vector<T>& of_polygons, const std::vector<Source>& sources)
{
  std::vector<T> result;
  result.reserve(sources.size());
  for (const Source& s : sources) result.push_back(of_polygons[s.face]);
  return result;
}

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/transfer/find_sources_impl.h>
#endif

#endif // CGAL_POWER_RTF_TRANSFER_FIND_SOURCES_H
