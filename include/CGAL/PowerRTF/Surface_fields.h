// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SURFACE_FIELDS_H
#define CGAL_POWER_RTF_SURFACE_FIELDS_H

#include <CGAL/PowerRTF/Refinement.h>
#include <CGAL/PowerRTF/geometry/Surface.h>

#include <optional>
#include <vector>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFSurface
/// What a user says about places of the input. Points are numbered as those of its soup.
struct Surface_fields {
  std::optional<std::vector<Edge>> creases;     ///< pairs of points; none: they are found
  std::optional<std::vector<double>> densities; ///< one per point; none: that of the options
  /// The wanted edge length at each point, in the input's unit, instead of densities.
  std::optional<std::vector<double>> sizes;
  std::vector<Refinement> refinements; ///< where edges shall be shorter
  std::vector<Edge> lines;             ///< pairs of points: creases beside those above
  /// For each polygon what it belongs to; between different labels there are creases, too. Empty:
  /// all are the same.
  std::vector<int> labels;
  std::vector<Edge> kept_edges; ///< pairs of points: edges of the border that the result shall have
  std::vector<int> kept_vertices; ///< points that shall be vertices of the result
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SURFACE_FIELDS_H
