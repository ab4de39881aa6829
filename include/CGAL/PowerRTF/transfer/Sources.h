// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_TRANSFER_SOURCES_H
#define CGAL_POWER_RTF_TRANSFER_SOURCES_H

#include <CGAL/PowerRTF/geometry/Surface.h>

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

#endif // CGAL_POWER_RTF_TRANSFER_SOURCES_H
