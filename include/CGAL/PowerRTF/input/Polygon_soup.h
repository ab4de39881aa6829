// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input as the package reads it: free of the types of the user's mesh.
#ifndef CGAL_POWER_RTF_INPUT_POLYGON_SOUP_H
#define CGAL_POWER_RTF_INPUT_POLYGON_SOUP_H

#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <cstddef>
#include <string>
#include <vector>

namespace CGAL::PowerRTF {

/// Points and polygons; polygon `k` has the corners `corners[first[k]] .. corners[first[k+1]-1]`.
struct Polygon_soup {
  std::vector<Vec3d> points;
  std::vector<int> corners, first{0};
  bool merges_vertices = false; ///< vertices at the same place are one

  void reserve_polygons(std::size_t n)
  {
    corners.reserve(3 * n);
    first.reserve(n + 1);
  }
  void end_polygon() { first.push_back(static_cast<int>(corners.size())); }

  /// \throws Invalid_input_error there is no point `v`
  template <class Integer>
  void add_corner(Integer v)
  {
    if (v < Integer(0) || static_cast<std::size_t>(v) >= points.size())
      throw Invalid_input_error("facet " + std::to_string(first.size() - 1) + " refers to vertex " +
                                std::to_string(v) + ", but there are only " +
                                std::to_string(points.size()) + " (numbered from 0)");
    corners.push_back(static_cast<int>(v));
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INPUT_POLYGON_SOUP_H
