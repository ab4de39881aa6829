// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Improvement of an extracted mesh (an addition to the paper): rounder triangles, and a mesh nearer
// to the surface.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_IMPROVE_MESH_H
#define CGAL_POWER_RTF_IMPROVEMENT_IMPROVE_MESH_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/Star_sweeps_base.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL::PowerRTF {

class Facet_tree;

/// What `improve_mesh()` begins with, of the surface alone.
struct Improvement_preparation;

/// Makes it before it is needed, and comes by the memory of the mesh.
/// \param vertices of the mesh to come, or nearly so many
std::shared_ptr<Improvement_preparation>
prepare_improvement(const Surface& surface, const Facet_tree& tree, std::size_t vertices,
                    internal::Concurrency concurrency = Sequential_tag());

/// What is asked of `improve_mesh()`, and what may save it time.
struct Improvement_settings {
  /// Those that are kept cost roundness, not time.
  Dislocations dislocations = Dislocations::annihilate;
  double max_distance = 0;        ///< that is asked for, in coordinates of the unit box, or 0
  std::vector<int> carriers{};    ///< the facets that the first points probably lie on, or none
  Bring_mesh bring{};             ///< brings meshes to where an engine works, or is empty
  Make_star_sweeps make_sweeps{}; ///< makes what moves vertices there instead, where it does
  /// For this surface and tree, for one mesh; none: it is made.
  std::shared_ptr<Improvement_preparation> prepared{};
};

/// Improves the triangles of `mesh` and its distance to `surface`. Keeps the vertices' number, the
/// topology, the feature edges and the border; vertices on these slide along them where that
/// helps, corners stay, the others move, and a few may go far. Makes no self-intersection. The
/// largest distance of the surface's vertices to the mesh grows by at most 0.2 h, h = sqrt(area /
/// n). Where an improvement would break one of these, everything stays as it is.
///
/// `surface`: with normals smoothed at the scale of the samples (`smooth_normals()`). `tree`: of
/// its facets and their patches. `concurrency`: a tag of CGAL's; the result is the same for all.
///
/// `changes`: becomes the number of vertices that were changed, or their edges, one place at a time
/// on the host: before, between and after the sweeps over all vertices, each of which counts what
/// has changed since the one before.
///
/// \returns `false` if `mesh` is no oriented 2-manifold: then nothing is done.
bool improve_mesh(const Surface& surface, const Facet_tree& tree, Extracted_mesh& mesh,
                  internal::Concurrency concurrency = Sequential_tag(),
                  const Improvement_settings& settings = {}, std::size_t* changes = nullptr);

/// The same with a tree of its own.
bool improve_mesh(const Surface& surface, Extracted_mesh& mesh,
                  internal::Concurrency concurrency = Sequential_tag());

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/improvement/improve_mesh_impl.h>
#endif

#endif // CGAL_POWER_RTF_IMPROVEMENT_IMPROVE_MESH_H
