// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_REFINEMENT_H
#define CGAL_POWER_RTF_REFINEMENT_H

#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFOptions
/// A part of space where edges shall be short: a ball, or a box with sides along the axes. All is
/// in the input's coordinates.
class Refinement {
public:
  /// The ball around `center`. \throws Invalid_input_error a number is not finite; the radius or
  /// the edge length is not above 0
  static Refinement sphere(const std::array<double, 3>& center, double radius, double edge_length)
  {
    return Refinement(center, {0, 0, 0}, radius, edge_length);
  }

  /// The box between two corners. \throws Invalid_input_error a number is not finite; a side or the
  /// edge length is not above 0
  static Refinement box(const std::array<double, 3>& low, const std::array<double, 3>& high,
                        double edge_length)
  {
    std::array<double, 3> center, half;
    for (int k = 0; k < 3; ++k) {
      center[k] = low[k] / 2 + high[k] / 2;
      half[k] = high[k] / 2 - low[k] / 2;
      if (!(half[k] > 0)) throw Invalid_input_error("a box to refine has a side not above 0");
    }
    return Refinement(center, half, 0, edge_length);
  }

  /// The wanted length of the edges inside.
  double edge_length() const { return m_edge_length; }

  /// The distance of a point; 0: it is inside.
  double distance(const Vec3d& p) const
  {
    const auto outside = [&](double x, int k) {
      return (std::max)(std::abs(x - m_center[k]) - m_half[k], 0.);
    };
    const Vec3d d{outside(p.x, 0), outside(p.y, 1), outside(p.z, 2)};
    return (std::max)(length(d) - m_radius, 0.);
  }

private:
  Refinement(const std::array<double, 3>& center, const std::array<double, 3>& half, double radius,
             double edge_length)
      : m_center(center), m_half(half), m_radius(radius), m_edge_length(edge_length)
  {
    bool is_finite = std::isfinite(radius) && std::isfinite(edge_length);
    for (int k = 0; k < 3; ++k)
      is_finite = is_finite && std::isfinite(center[k]) && std::isfinite(half[k]);
    if (!is_finite) throw Invalid_input_error("a refinement has a number that is not finite");
    if (!(radius > 0 || half[0] > 0))
      throw Invalid_input_error("a sphere to refine has a radius not above 0");
    if (!(edge_length > 0))
      throw Invalid_input_error("a refinement has an edge length not above 0");
  }

  std::array<double, 3> m_center, m_half; // of a box; of a ball, which has no sides: its center
  double m_radius, m_edge_length;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_REFINEMENT_H
