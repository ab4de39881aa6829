// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_RESOLUTION_H
#define CGAL_POWER_RTF_RESOLUTION_H

#include <CGAL/PowerRTF/Remeshing_options.h>

#include <cstddef>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFOptions
/// How fine a mesh shall be.
class Resolution {
public:
  /// With so many vertices.
  Resolution(std::size_t number_of_samples) : m_number_of_samples(number_of_samples) {}

  /// With edges of this median length, in the input's unit.
  static Resolution edge_length(double length)
  {
    return Resolution(&Remeshing_options::edge_length, length);
  }
  /// The same over the diagonal of the input's bounding box.
  static Resolution relative_edge_length(double ratio)
  {
    return Resolution(&Remeshing_options::relative_edge_length, ratio);
  }
  /// With edges of so many times the lengths of `PowerRTF::parameters::sizing_map`.
  static Resolution size_factor(double factor = 1)
  {
    return Resolution(&Remeshing_options::size_factor, factor);
  }
  /// With so many vertices for each one of the input.
  static Resolution vertex_share(double share)
  {
    return Resolution(&Remeshing_options::vertex_share, share);
  }

  /// With as few vertices as keep all points of input and output within this distance from the
  /// other, in the input's unit. They are looked for by some runs; the distance is verified. Where
  /// no density is asked for, vertices that it can spare are taken out.
  static Resolution max_distance(double distance)
  {
    return Resolution(&Remeshing_options::max_distance, distance);
  }
  /// The same over the diagonal of the input's bounding box.
  static Resolution relative_max_distance(double ratio)
  {
    return Resolution(&Remeshing_options::relative_max_distance, ratio);
  }

  /// Writes what is asked for to `options`, and that nothing else is.
  void set(Remeshing_options& options) const
  {
    options.vertex_share = options.edge_length = options.relative_edge_length = 0;
    options.size_factor = 0;
    options.max_distance = options.relative_max_distance = 0;
    if (m_option)
      options.*m_option = m_value;
    else
      options.number_of_samples = m_number_of_samples;
  }

private:
  Resolution(double Remeshing_options::*option, double value) : m_option(option), m_value(value) {}

  std::size_t m_number_of_samples = 0;
  double Remeshing_options::*m_option = nullptr;
  double m_value = 0;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_RESOLUTION_H
