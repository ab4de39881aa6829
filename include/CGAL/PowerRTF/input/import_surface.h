// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a mesh or a polygon soup to the flat arrays that the remesher reads: triangulated, oriented,
// 2-manifold, in the unit box; or an `Invalid_input_error` that says why that cannot be. Only what
// makes a `Polygon_soup` depends on the user's types.
#ifndef CGAL_POWER_RTF_INPUT_IMPORT_SURFACE_H
#define CGAL_POWER_RTF_INPUT_IMPORT_SURFACE_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/input/clean_soup.h>
#include <CGAL/PowerRTF/internal/compat.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <utility>

namespace CGAL::PowerRTF {
namespace internal {

inline const Vec3d& to_vec3d(const Vec3d& p) { return p; }

template <class Point>
Vec3d to_vec3d(const Point& p)
{
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

/// The place of each vertex in `vertices(mesh)`, as a property map.
template <class FaceGraph>
auto vertex_places(const FaceGraph& mesh)
{
  auto places = get(CGAL::dynamic_vertex_property_t<int>(), mesh);
  int count = 0;
  for (const auto v : vertices(mesh)) put(places, v, count++);
  return places;
}

/// The points and facets of a mesh; vertices at the same place stay apart.
template <class FaceGraph, class NamedParameters>
Polygon_soup soup_of_mesh(const FaceGraph& mesh, const NamedParameters& np)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  const auto point_map = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                          get_const_property_map(CGAL::vertex_point, mesh));
  const auto places = vertex_places(mesh);
  Polygon_soup soup;
  soup.points.reserve(num_vertices(mesh));
  for (const auto v : vertices(mesh)) soup.points.push_back(to_vec3d(get(point_map, v)));
  soup.reserve_polygons(num_faces(mesh));
  for (const auto f : faces(mesh)) {
    for (const auto v : CGAL::vertices_around_face(halfedge(f, mesh), mesh))
      soup.corners.push_back(get(places, v));
    soup.end_polygon();
  }
  return soup;
}

/// Points and polygons as read from a file; vertices at the same place become one.
/// \throws Invalid_input_error an index is out of range
template <class PointRange, class PolygonRange>
Polygon_soup soup_of_ranges(const PointRange& points, const PolygonRange& polygons)
{
  Polygon_soup soup;
  soup.merges_vertices = true;
  soup.points.reserve(points.size());
  for (const auto& p : points) soup.points.push_back(to_vec3d(p));
  soup.reserve_polygons(polygons.size());
  for (const auto& polygon : polygons) {
    for (const auto v : polygon) soup.add_corner(v);
    soup.end_polygon();
  }
  return soup;
}

} // namespace internal

/// \ingroup PkgPowerRTFSurface
/// Imports any model of `FaceListGraph`. Its connectivity is kept: vertices at the same place stay
/// apart unless an edge of no length joins them.
///
/// \param np may contain `vertex_point_map` (default: the mesh's own)
/// \param repairs counts what had to be mended
/// \param repair no: facets without area and sheets that touch in a vertex are refused
/// \returns the surface with normals and areas and density 1; `input_vertices` are places in
///   `vertices(mesh)`. Facets with more than three sides are triangulated, facets without area are
///   removed where the surface stays a 2-manifold, isolated vertices are dropped. Sheets that touch
///   in a vertex get copies of it.
/// \throws Invalid_input_error no facet, a coordinate that is not finite, no area, or not a
///   2-manifold
template <class FaceGraph, class NamedParameters = CGAL::parameters::Default_named_parameters>
Surface import_surface(const FaceGraph& mesh, const NamedParameters& np, Repair_counts& repairs,
                       Repair repair = Repair::yes)
{
  return internal::clean_surface(internal::soup_of_mesh(mesh, np), repair, repairs);
}

/// \ingroup PkgPowerRTFSurface
/// Imports a polygon soup, as read from a file. Vertices at exactly the same place become one,
/// unless the polygons form a closed 2-manifold without that and none with it.
///
/// \param points range of `Vec3d` or of points with `x()`, `y()`, `z()`
/// \param polygons range of ranges of indices into `points`
/// \param repairs counts what had to be mended
/// \param repair no: all that is named below is refused
/// \returns the surface as `import_surface()` does; `input_vertices` are indices into `points`.
///   Repeated polygons are dropped; neighbors are turned to agree, as few as possible (a component
///   that is inside out stays so); sheets that meet in an edge are parted (`split_sheets()`),
///   cracks that rounding has torn are closed (`merged_near_borders()`).
/// \throws Invalid_input_error as `import_surface()`; also for an index out of range, for a surface
///   that cannot be oriented and for facets at an edge that do not pair up into sheets
template <class PointRange, class PolygonRange>
Surface import_soup(const PointRange& points, const PolygonRange& polygons, Repair_counts& repairs,
                    Repair repair = Repair::yes)
{
  return internal::clean_surface(internal::soup_of_ranges(points, polygons), repair, repairs);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INPUT_IMPORT_SURFACE_H
