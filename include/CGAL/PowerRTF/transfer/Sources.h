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

/// How many points of a face tell which share of it comes from where.
inline constexpr int points_of_face = 16;

/// The sources of a mesh.
struct Sources {
  std::vector<Source> vertices, faces; ///< those of the faces are the sources of their centers
  /// By face the polygons under `points_of_face` points of it, the first being its center, where
  /// they are asked for.
  std::vector<std::array<int, points_of_face>> shares{};
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

/// The place of the first of `count` values that are equal most often. \param value `value(k)` is
/// one
template <class Value>
int most_frequent(int count, const Value& value)
{
  int first = 0, most = 0;
  for (int k = 0; k < count - most; ++k) {
    int equal = 0;
    for (int l = k; l < count; ++l) equal += value(l) == value(k);
    if (equal > most) first = k, most = equal;
  }
  return first;
}

/// The values of faces: those that the largest shares of them come from, or without shares, their
/// centers.
template <class T>
std::vector<T> face_values(const std::vector<T>& of_polygons, const Sources& sources)
{
  if (sources.shares.empty()) return values_at(of_polygons, sources.faces);
  std::vector<T> result;
  result.reserve(sources.shares.size());
  for (const auto& polygons : sources.shares) {
    const auto value = [&](int k) { return of_polygons[polygons[k]]; };
    result.push_back(value(most_frequent(points_of_face, value)));
  }
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_TRANSFER_SOURCES_H
