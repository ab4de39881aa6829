// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a mesh or a polygon soup to the flat arrays that the remesher reads: triangulated, oriented,
// 2-manifold, in the unit box; or an `Invalid_input_error` that says why that cannot be.
#ifndef CGAL_POWER_RTF_INPUT_IMPORT_SURFACE_H
#define CGAL_POWER_RTF_INPUT_IMPORT_SURFACE_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/input/clean_surface.h>
#include <CGAL/PowerRTF/input/read_mesh.h>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFSurface
/// Imports any model of `FaceListGraph`. Its connectivity is kept: vertices at the same place stay
/// apart unless an edge of no length joins them.
///
/// \param np may contain `vertex_point_map` (default: the mesh's own)
/// \param repairs counts what had to be mended
/// \param repair no: facets without area and sheets that touch in a vertex are refused
/// \returns the surface with normals and areas and density 1; `input_vertices` are places in
///   `vertices(mesh)`, in their order unless there are more than 65536 facets: then what is near in
///   space is near in memory, too. Facets with more than three sides are triangulated, facets
///   without area are removed where the surface stays a 2-manifold, isolated vertices are dropped.
///   Sheets that touch in a vertex get copies of it.
/// \throws Invalid_input_error no facet, a coordinate that is not finite, no area, or not a
///   2-manifold
template <class FaceGraph, class NamedParameters = CGAL::parameters::Default_named_parameters>
Surface import_surface(const FaceGraph& mesh, const NamedParameters& np, Repair_counts& repairs,
                       Repair repair = Repair::yes)
{
  return internal::clean_surface(internal::soup_of_mesh(mesh, np), repair, Non_manifold::split,
                                 repairs);
}

/// \ingroup PkgPowerRTFSurface
/// Imports a polygon soup, as read from a file. Vertices at exactly the same place become one,
/// unless the polygons form a closed 2-manifold without that and none with it.
///
/// \param points range of `Vec3d` or of points with `x()`, `y()`, `z()`
/// \param polygons range of ranges of indices into `points`
/// \param repairs counts what had to be mended
/// \param repair no: all that is named below is refused
/// \param non_manifold keep: edges of more than two facets are seams of the surface, and vertices
///   where sheets touch its contacts
/// \returns the surface as `import_surface()` does; `input_vertices` are indices into `points`.
///   Repeated polygons are dropped; neighbors are turned to agree, as few as possible (a component
///   that is inside out stays so); sheets that meet in an edge are parted (`split_sheets()`),
///   cracks that rounding has torn are closed (`merged_near_borders()`).
/// \throws Invalid_input_error as `import_surface()`; also for an index out of range, for a surface
///   that cannot be oriented and for facets at an edge that do not pair up into sheets
template <class PointRange, class PolygonRange>
Surface import_soup(const PointRange& points, const PolygonRange& polygons, Repair_counts& repairs,
                    Repair repair = Repair::yes, Non_manifold non_manifold = Non_manifold::split)
{
  return internal::clean_surface(internal::soup_of_ranges(points, polygons), repair, non_manifold,
                                 repairs);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INPUT_IMPORT_SURFACE_H
