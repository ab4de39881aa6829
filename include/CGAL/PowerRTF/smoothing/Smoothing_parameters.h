// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of what moves all vertices of a mesh. Angles between normals are given by their
// cosines. "Agreement" is the least cosine between the normals of triangles and those of the
// surface at their corners.
#ifndef CGAL_POWER_RTF_SMOOTHING_SMOOTHING_PARAMETERS_H
#define CGAL_POWER_RTF_SMOOTHING_SMOOTHING_PARAMETERS_H

namespace CGAL::PowerRTF::internal {

/// What is less than this times another number is less: rounding decides nothing.
constexpr double clearly_less = 1 - 1e-9;

/// smooth_vertex.h and flip_edges.h
struct Smoothing_parameters {
  static constexpr int max_flip_passes = 10;
  /// Agreement that a star must keep, if it had it. One on a strongly curved part stands for
  /// features that smoothing would slide off.
  static constexpr double min_agreement = 0.75;
  /// Of Newton's step: successive over-relaxation, as good in four passes as in seven without it.
  static constexpr double relaxation = 1.4;
  /// In the shortest edge of the star; smaller steps are not worth their search of the surface.
  static constexpr double max_step = 0.25, min_step = 0.001;
};

/// Fit_equations.h and fit_to_surface.h
struct Fitting_parameters {
  static constexpr int sweeps = 5; ///< the matrix is like a mass matrix: they converge fast
  static constexpr double max_turn_cosine = 0.5; ///< of a triangle by one move
  /// What moves in the tangent plane cost; more where the samples are to be spaced evenly.
  static constexpr double tangential_weight = 0.05, even_tangential_weight = 0.3;
  static constexpr double normal_weight = 1e-3; ///< and those along the normal
  /// Where at least this share of a star lies in a flat patch that is at least so wide (in h), the
  /// vertex stays there, whatever is next to it: a flat face that bulges is worse than a round one
  /// that is cut short.
  static constexpr double flat_width = 1.2, flat_share = 0.25, flat_normal_weight = 1e6;
  static constexpr double coplanar_cosine = 0.99999; ///< of normals of facets in one plane
  static constexpr double sheet_cosine = 0.5;        ///< of normals of facets on one sheet
  /// The weight of the surface's vertices where there are at least so many of them for each vertex
  /// of the mesh. The fewer there are, the more they are a random choice: it falls with the square
  /// of their number.
  static constexpr double tracked_weight = 0.7, fully_tracked = 8;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_SMOOTHING_PARAMETERS_H
