// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normal, area and angles of a facet, and what they make of the normals at vertices, for host and
// device.
#ifndef CGAL_POWER_RTF_GEOMETRY_FACET_SHAPE_H
#define CGAL_POWER_RTF_GEOMETRY_FACET_SHAPE_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/host_device.h>

#include <cmath>

namespace CGAL::PowerRTF {

/// A facet is degenerate when its height is below this share of its longest edge, or below a few
/// roundings of the unit box.
constexpr double degenerate_aspect = 1e-10;
constexpr double unit_box_rounding = 1e-15;

/// Whether the triangle `a b c` (unit-box coordinates) has no usable normal.
CGAL_POWER_RTF_HD inline bool is_degenerate(const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  const double longest_2 = internal::larger(
      internal::larger(squared_length(b - a), squared_length(c - b)), squared_length(a - c));
  const double height_2 = squared_length(cross(b - a, c - a)); // times longest_2
  return !(height_2 > degenerate_aspect * degenerate_aspect * longest_2 * longest_2 &&
           height_2 > unit_box_rounding * unit_box_rounding * longest_2);
}

namespace internal {

/// The angles of a facet at its corners; 0: it is degenerate.
struct Facet_angles {
  double at[3];

  CGAL_POWER_RTF_HD bool are_known() const { return at[0] != 0 || at[1] != 0 || at[2] != 0; }
};

struct Facet_shape {
  double area;
  Vec3d normal; ///< of length 1; not set: it is degenerate
  Facet_angles angles;
};

CGAL_POWER_RTF_HD inline Facet_shape facet_shape(const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  constexpr double pi = 3.14159265358979323846;
  const Vec3d n = cross(b - a, c - a);
  const double twice_area = length(n);
  Facet_shape shape;
  shape.area = twice_area / 2;
  shape.angles = {0, 0, 0};
  if (is_degenerate(a, b, c)) return shape;
  shape.normal = n * (1 / twice_area);
  const double angle_a = std::atan2(twice_area, dot(b - a, c - a));
  const double angle_b = std::atan2(twice_area, dot(c - b, a - b));
  shape.angles = {angle_a, angle_b, pi - angle_a - angle_b};
  return shape;
}

/// The normal at a vertex: that of its facets, weighted by their angles, or 0, where they cancel.
/// `first` to `end`: the corners there, three of each facet.
CGAL_POWER_RTF_HD inline Vec3d vertex_normal(const int* first, const int* end,
                                             const Facet_angles* angles, const Vec3d* normals)
{
  constexpr double no_direction = 1e-6; // of sums of angles, which are of order 1
  Vec3d sum{0, 0, 0};
  for (const int* c = first; c < end; ++c) {
    const double angle = angles[*c / 3].at[*c % 3];
    if (angle != 0) sum += angle * normals[*c / 3];
  }
  const double l = length(sum);
  return l > no_direction ? sum * (1 / l) : Vec3d{0, 0, 0};
}

} // namespace internal
} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_FACET_SHAPE_H
