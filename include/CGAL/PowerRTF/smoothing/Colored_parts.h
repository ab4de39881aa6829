// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lists of vertices by their colors, many at once: the parts of each list are counted, placed one
// behind the other by a scan, and written.
#ifndef CGAL_POWER_RTF_SMOOTHING_COLORED_PARTS_H
#define CGAL_POWER_RTF_SMOOTHING_COLORED_PARTS_H

#include <CGAL/PowerRTF/internal/host_device.h>

namespace CGAL::PowerRTF::internal {

/// The vertices by color: each part has those of one color in a chunk of all. The parts are in the
/// order of the colors from `first_color` on, those of one color in that of the chunks.
struct Colored_parts {
  static constexpr int chunk = 64, colors_at_once = 9; // mostly all, and none

  const int* colors;
  int vertices, first_color;

  CGAL_POWER_RTF_HD int chunks() const { return vertices / chunk + 1; }
  CGAL_POWER_RTF_HD int size() const { return colors_at_once * chunks(); }

  /// Calls `f(v)` for the vertices of a part, in order.
  template <class F>
  CGAL_POWER_RTF_HD void for_each_of(int part, const F& f) const
  {
    const int color = first_color + part / chunks(), begin = part % chunks() * chunk,
              end = begin + chunk < vertices ? begin + chunk : vertices;
    for (int v = begin; v < end; ++v)
      if (colors[v] == color) f(v);
  }
};

/// For all parts, and the end.
struct Count_colored {
  Colored_parts parts;
  int* counts;
  CGAL_POWER_RTF_HD void operator()(int part) const
  {
    int count = 0;
    if (part < parts.size()) parts.for_each_of(part, [&](int) { ++count; });
    counts[part] = count;
  }
};

struct List_colored {
  Colored_parts parts;
  const int* first; ///< by part
  int* order;
  CGAL_POWER_RTF_HD void operator()(int part) const
  {
    int at = first[part];
    parts.for_each_of(part, [&](int v) { order[at++] = v; });
  }
};

/// Where the colors begin that are listed at once, and the end.
struct Take_color_starts {
  Colored_parts parts;
  const int* first; ///< by part
  int* starts;
  CGAL_POWER_RTF_HD void operator()(int k) const { starts[k] = first[k * parts.chunks()]; }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_COLORED_PARTS_H
