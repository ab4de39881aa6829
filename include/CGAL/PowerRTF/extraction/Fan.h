// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles at a vertex, and their order around it.
#ifndef CGAL_POWER_RTF_EXTRACTION_FAN_H
#define CGAL_POWER_RTF_EXTRACTION_FAN_H

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// The other two vertices of a triangle at a vertex, counter-clockwise.
using Fan_corner = std::array<int, 2>;
/// Triangles at a vertex.
using Fan = boost::container::small_vector<Fan_corner, 12>;

/// Brings the triangles of a star into their order around the vertex, from a border on if there is
/// one. Returns whether they are one fan, open or closed.
inline bool sort_around(Fan& star)
{
  const auto starts_at = [&star](int v, std::size_t from) {
    for (std::size_t k = from; k < star.size(); ++k)
      if (star[k][0] == v) return k;
    return star.size();
  };
  if (star.empty()) return false;
  for (std::size_t k = 0; k < star.size(); ++k)
    if (std::none_of(star.begin(), star.end(),
                     [&](const Fan_corner& c) { return c[1] == star[k][0]; })) {
      std::swap(star[0], star[k]);
      break;
    }
  for (std::size_t k = 1; k < star.size(); ++k) {
    const std::size_t next = starts_at(star[k - 1][1], k);
    if (next == star.size()) return false;
    std::swap(star[k], star[next]);
  }
  for (std::size_t k = 0; k < star.size(); ++k)
    if (starts_at(star[k][0], k + 1) < star.size()) return false;
  return std::none_of(star.begin(), star.end() - 1,
                      [&](const Fan_corner& c) { return c[1] == star.back()[1]; });
}

/// Of a star in the order around the vertex.
inline bool is_closed(const Fan& star) { return star.back()[1] == star.front()[0]; }

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_FAN_H
