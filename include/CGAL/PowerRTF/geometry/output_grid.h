// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The grid of the result's points. What is rounded after it has been judged may intersect itself;
// so all points are rounded at once, to places that the output's numbers hold exactly.
#ifndef CGAL_POWER_RTF_GEOMETRY_OUTPUT_GRID_H
#define CGAL_POWER_RTF_GEOMETRY_OUTPUT_GRID_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

namespace CGAL::PowerRTF {

/// Sets the grid that `options.coordinates` asks for.
/// \throws Invalid_input_error when its points are too far apart for so many samples
inline void set_output_grid(Surface& surface, const Remeshing_options& options)
{
  constexpr double coarsest = 0.05; // in units of the samples' spacing
  Normalization& normalization = surface.normalization;
  if (!(normalization.grid > 0)) return; // a surface that was made in the unit box
  const bool is_single = options.coordinates == Coordinates::single_precision;
  const double spacing =
      is_single ? normalization.spacing<float>() : normalization.spacing<double>();
  const double h =
      std::sqrt(surface.area / double(options.number_of_samples)) / normalization.scale;
  const bool overflows = is_single && normalization.reach > std::numeric_limits<float>::max();
  if (overflows || !(spacing <= coarsest * h)) {
    std::ostringstream message;
    message << "the output's coordinates, numbers of " << (is_single ? "single" : "double")
            << " precision, cannot hold " << options.number_of_samples << " samples: ";
    if (overflows)
      message << "they are too large";
    else
      message << "so far from the origin such numbers are " << spacing
              << " apart, and the samples about " << h;
    throw Invalid_input_error(message.str());
  }
  normalization.grid = spacing * normalization.scale;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_OUTPUT_GRID_H
