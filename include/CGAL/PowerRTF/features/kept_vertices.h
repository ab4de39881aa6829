// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices of the input that the result has.
#ifndef CGAL_POWER_RTF_FEATURES_KEPT_VERTICES_H
#define CGAL_POWER_RTF_FEATURES_KEPT_VERTICES_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <cstddef>
#include <string>
#include <vector>

namespace CGAL::PowerRTF {

/// Keeps vertices of `surface`, given by points of the input, which has `count`.
/// \param wanted, merged the points, and those that these have become where points were merged
/// \throws Invalid_input_error the surface lacks one of them
inline void keep_vertices(Surface& surface, const std::vector<int>& wanted,
                          const std::vector<int>& merged, std::size_t count)
{
  std::vector<char> is_wanted(count, 0), is_found(count, 0); // by point
  for (const std::vector<int>* points : {&wanted, &merged})
    for (const int v : *points) is_wanted[v] = 1;
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    const int point = surface.input_vertices[v];
    if (!is_wanted[point]) continue;
    is_found[point] = 1;
    surface.kept_vertices.push_back(static_cast<int>(v));
  }
  sort_uniquely(surface.kept_vertices);
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (!is_found[wanted[k]] && !is_found[merged[k]])
      throw Invalid_input_error("vertex " + std::to_string(wanted[k]) +
                                " (numbered from 0) cannot stay: no facet with an area has it, or "
                                "it has been joined with another one");
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_KEPT_VERTICES_H
