// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SMOOTHING_STAR_SWEEPS_BASE_H
#define CGAL_POWER_RTF_SMOOTHING_STAR_SWEEPS_BASE_H

#include <CGAL/PowerRTF/smoothing/Fit_equations.h>
#include <CGAL/PowerRTF/smoothing/Star_view.h>

#include <functional>
#include <memory>

namespace CGAL::PowerRTF {

/// Looks at all vertices of a mesh again and again, where an engine works. The mesh stays there.
/// What returns `false` has done nothing, as the memory does not suffice.
class Star_sweeps_base {
public:
  virtual ~Star_sweeps_base() = default;
  /// Takes the stars of a mesh; or, of the mesh that is there, those that have changed since it
  /// came, or since its vertices were read.
  virtual bool take(const internal::Flat_stars& stars) = 0;
  /// So many steps of each vertex; see `smooth_vertex()`.
  virtual void smooth(int steps) = 0;
  /// Moves the vertices, off the surface too, so that the mesh is nearer to it; see
  /// `Fit_equations`.
  virtual bool fit(const internal::Flat_fit& fit) = 0;
  /// Tells where the vertices are now, and which of them are doubtful.
  virtual void read(internal::Swept_vertices& result) = 0;
};

/// `surface`: the engine's, which meshes lie on; the engine has to live as long as the result.
/// `grid`: of the coordinates of the vertices; 0: none. Null: the engine's memory does not suffice.
using Make_star_sweeps =
    std::function<std::unique_ptr<Star_sweeps_base>(const Surface_descent& surface, double grid)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SMOOTHING_STAR_SWEEPS_BASE_H
