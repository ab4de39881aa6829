// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Improvement of an extracted mesh (an addition to the paper): rounder triangles, and a mesh nearer
// to the surface.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_IMPROVE_MESH_H
#define CGAL_POWER_RTF_IMPROVEMENT_IMPROVE_MESH_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/geometry/Find_close_faces.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/Star_sweeps_base.h>

#include <vector>

namespace CGAL::PowerRTF {

class Facet_tree;

/// Improves the triangles of `mesh` and its distance to `surface`. Keeps the vertices' number, the
/// topology, the feature edges and the border; vertices on these slide along them where that
/// helps, corners stay, the others move, and a few may go far. Makes no self-intersection. The
/// largest distance of the surface's vertices to the mesh grows by at most 0.2 h, h = sqrt(area /
/// n). Where an improvement would break one of these, everything stays as it is.
///
/// `surface`: with normals smoothed at the scale of the samples (`smooth_normals()`). `tree`: of
/// its facets and their patches. `concurrency`: a tag of CGAL's; the result is the same for all.
/// `dislocations`: those that are kept cost roundness, not time. `carriers`: for the first
/// points of `mesh`, or none, the facets that they probably lie on, which saves time. `find`,
/// `make_sweeps`: what finds intersections and moves vertices instead, where it does.
/// `max_distance`: that is asked for, in coordinates of the unit box, or 0.
///
/// \returns `false` if `mesh` is no oriented 2-manifold: then nothing is done.
bool improve_mesh(const Surface& surface, const Facet_tree& tree, Extracted_mesh& mesh,
                  internal::Concurrency concurrency = Sequential_tag(),
                  Dislocations dislocations = Dislocations::annihilate,
                  const std::vector<int>& carriers = {}, const Find_close_faces& find = {},
                  const Make_star_sweeps& make_sweeps = {}, double max_distance = 0);

/// The same with a tree of its own.
bool improve_mesh(const Surface& surface, Extracted_mesh& mesh,
                  internal::Concurrency concurrency = Sequential_tag());

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/improvement/improve_mesh_impl.h>
#endif

#endif // CGAL_POWER_RTF_IMPROVEMENT_IMPROVE_MESH_H
