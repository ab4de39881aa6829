// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points within a fixed radius: a hashed uniform grid (Teschner et al. 2003), so that its memory
// follows the number of points and not the volume around the surface.
#ifndef CGAL_POWER_RTF_GEOMETRY_POINT_GRID_H
#define CGAL_POWER_RTF_GEOMETRY_POINT_GRID_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL::PowerRTF {

/// A static set of points of the unit box.
class Point_grid {
public:
  /// Takes the points `points[i]` for `i` in `indices`. Queries are fastest with radii around
  /// `radius`.
  Point_grid(const std::vector<Vec3d>& points, const std::vector<int>& indices, double radius)
      : m_inverse_cell(1 / (std::max)(cell_per_radius * radius, smallest_cell))
  {
    std::size_t slots = 16;
    while (slots < 2 * indices.size()) slots *= 2;
    m_mask = slots - 1;
    m_first.assign(slots + 1, 0);
    for (const int i : indices) ++m_first[slot(cell_of(points[i])) + 1];
    for (std::size_t s = 0; s < slots; ++s) m_first[s + 1] += m_first[s];
    m_entries.resize(indices.size());
    std::vector<int> end(m_first.begin(), m_first.end() - 1);
    for (const int i : indices) {
      const std::uint64_t key = cell_of(points[i]);
      m_entries[end[slot(key)]++] = {points[i], key, i};
    }
  }

  /// Calls `visit(index, squared_distance)` for every point at most `radius` away from `q`.
  template <class Visit>
  void for_each_near(const Vec3d& q, double radius, Visit visit) const
  {
    const double radius_2 = radius * radius;
    const std::int64_t x0 = along(q.x - radius), x1 = along(q.x + radius);
    const std::int64_t y0 = along(q.y - radius), y1 = along(q.y + radius);
    const std::int64_t z0 = along(q.z - radius), z1 = along(q.z + radius);
    for (std::int64_t z = z0; z <= z1; ++z)
      for (std::int64_t y = y0; y <= y1; ++y)
        for (std::int64_t x = x0; x <= x1; ++x) {
          const std::uint64_t key = pack(x, y, z);
          const std::size_t s = slot(key);
          for (int e = m_first[s]; e < m_first[s + 1]; ++e) {
            if (m_entries[e].cell != key) continue;
            const double d = squared_length(m_entries[e].point - q);
            if (d <= radius_2) visit(m_entries[e].index, d);
          }
        }
  }

private:
  static constexpr double cell_per_radius = 1.5;   // fewer cells, or fewer points per cell
  static constexpr double smallest_cell = 0x1p-19; // 21 bits for the number of a cell along an axis

  struct Entry {
    Vec3d point;
    std::uint64_t cell;
    int index;
  };

  std::int64_t along(double x) const
  {
    return static_cast<std::int64_t>(std::floor(x * m_inverse_cell));
  }

  static std::uint64_t pack(std::int64_t x, std::int64_t y, std::int64_t z)
  {
    constexpr std::uint64_t mask = (1u << 21) - 1;
    return (std::uint64_t(x) & mask) | (std::uint64_t(y) & mask) << 21 |
           (std::uint64_t(z) & mask) << 42;
  }

  std::uint64_t cell_of(const Vec3d& p) const { return pack(along(p.x), along(p.y), along(p.z)); }

  std::size_t slot(std::uint64_t cell) const
  {
    cell *= 0x9E3779B97F4A7C15u;
    return static_cast<std::size_t>(cell ^ cell >> 32) & m_mask;
  }

  double m_inverse_cell;
  std::size_t m_mask;
  std::vector<int> m_first; // the entries of each slot
  std::vector<Entry> m_entries;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_POINT_GRID_H
