// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_CELL_MARKS_H
#define CGAL_POWER_RTF_GEOMETRY_CELL_MARKS_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The cells of a grid that some boxes touch: tells at once of most other boxes that they touch
/// none of these.
class Cell_marks {
public:
  /// \param around where the boxes are that matter
  explicit Cell_marks(const Box3<double>& around) : m_around(around), m_marks(size * size * size)
  {
    const Vec3d extent = around.hi - around.lo;
    const double longest = std::max({extent.x, extent.y, extent.z});
    m_scale = longest > 0 ? size / longest : 0;
  }

  void add(const Box3<double>& box)
  {
    for_each_row(box, [this](std::size_t begin, std::size_t end) {
      std::fill(m_marks.data() + begin, m_marks.data() + end, 1);
      return true;
    });
  }

  /// Whether `box` touches a marked cell, which it does where it overlaps a box that was added.
  bool touches(const Box3<double>& box) const
  {
    bool result = false;
    for_each_row(box, [&](std::size_t begin, std::size_t end) {
      result = std::find(m_marks.data() + begin, m_marks.data() + end, 1) != m_marks.data() + end;
      return !result;
    });
    return result;
  }

private:
  static constexpr int size = 64; // cells along the longest side

  int cell(double x, double lo) const
  {
    return static_cast<int>(std::clamp((x - lo) * m_scale, 0., size - 1.));
  }

  // Calls `f(begin, end)` for the rows of cells that the box touches, until it returns `false`.
  template <class F>
  void for_each_row(const Box3<double>& box, F&& f) const
  {
    const Vec3d& lo = m_around.lo;
    const int x = cell(box.lo.x, lo.x), x_end = cell(box.hi.x, lo.x) + 1;
    for (int z = cell(box.lo.z, lo.z); z <= cell(box.hi.z, lo.z); ++z)
      for (int y = cell(box.lo.y, lo.y); y <= cell(box.hi.y, lo.y); ++y) {
        const std::size_t row = std::size_t(size) * (size * z + y);
        if (!f(row + x, row + x_end)) return;
      }
  }

  Box3<double> m_around;
  double m_scale;
  std::vector<char> m_marks;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_CELL_MARKS_H
