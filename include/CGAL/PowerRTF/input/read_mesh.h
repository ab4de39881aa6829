// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points and facets of the user's mesh, or of arrays, as a `Polygon_soup`: all of the import
// that depends on types of the user's.
#ifndef CGAL_POWER_RTF_INPUT_READ_MESH_H
#define CGAL_POWER_RTF_INPUT_READ_MESH_H

#include <CGAL/PowerRTF/input/Polygon_soup.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <optional>
#include <type_traits>
#include <vector>

namespace CGAL {

template <class Point>
class Surface_mesh;

namespace PowerRTF::internal {

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

/// Adds the points of a mesh to an empty soup, one by one.
template <class FaceGraph, class PointMap>
void add_points(const FaceGraph& mesh, const PointMap& point_map, Polygon_soup& soup, Concurrency)
{
  soup.points.reserve(num_vertices(mesh));
  for (const auto v : vertices(mesh)) soup.points.push_back(to_vec3d(get(point_map, v)));
}
/// The same of a mesh's own points, that threads may read at the same time.
template <class Point>
void add_points(const CGAL::Surface_mesh<Point>& mesh,
                const typename CGAL::Surface_mesh<Point>::template Property_map<
                    typename CGAL::Surface_mesh<Point>::Vertex_index, Point>& points,
                Polygon_soup& soup, Concurrency concurrency)
{
  using Vertex = typename CGAL::Surface_mesh<Point>::Vertex_index;
  // Numbers that are computed when they are needed are no more than one thread's.
  constexpr bool are_plain = std::is_arithmetic_v<std::decay_t<decltype(points[Vertex()].x())>>;
  if (mesh.has_garbage() || !are_plain) {
    add_points<CGAL::Surface_mesh<Point>, decltype(points)>(mesh, points, soup, concurrency);
    return;
  }
  resize_in_parallel(concurrency, soup.points, mesh.number_of_vertices());
  for_each_index(concurrency, int(soup.points.size()),
                 [&](int v) { soup.points[v] = to_vec3d(points[Vertex(v)]); });
}

/// Adds the facets of a mesh to the soup of its points, one by one.
template <class FaceGraph>
void add_facets(const FaceGraph& mesh, Polygon_soup& soup, Concurrency)
{
  const auto places = vertex_places(mesh);
  soup.reserve_polygons(num_faces(mesh));
  for (const auto f : faces(mesh)) {
    for (const auto v : CGAL::vertices_around_face(halfedge(f, mesh), mesh))
      soup.corners.push_back(get(places, v));
    soup.end_polygon();
  }
}
/// The same of a mesh that threads may read at the same time. Its faces and vertices count on,
/// unless some have been removed.
template <class Point>
void add_facets(const CGAL::Surface_mesh<Point>& mesh, Polygon_soup& soup, Concurrency concurrency)
{
  using Mesh = CGAL::Surface_mesh<Point>;
  using Face = typename Mesh::Face_index;
  std::vector<Face> faces;
  std::optional<decltype(vertex_places(mesh))> places;
  if (mesh.has_garbage()) {
    places.emplace(vertex_places(mesh));
    faces.assign(mesh.faces().begin(), mesh.faces().end());
  }
  const auto face = [&](int k) { return places ? faces[k] : Face(k); };
  const int n = static_cast<int>(mesh.number_of_faces());
  resize_in_parallel(concurrency, soup.first, n + 1, 0);
  for_each_index(concurrency, n, [&](int k) { soup.first[k] = int(mesh.degree(face(k))); });
  resize_in_parallel(concurrency, soup.corners,
                     exclusive_scan(concurrency, n + 1, soup.first.data()));
  for_each_index(concurrency, n, [&](int k) {
    int corner = soup.first[k];
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(face(k)), mesh))
      soup.corners[corner++] = places ? get(*places, v) : int(v);
  });
}

/// The points and facets of a mesh; vertices at the same place stay apart.
template <class FaceGraph, class NamedParameters>
Polygon_soup soup_of_mesh(const FaceGraph& mesh, const NamedParameters& np,
                          Concurrency concurrency = Sequential_tag())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  const auto point_map = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                          get_const_property_map(CGAL::vertex_point, mesh));
  Polygon_soup soup;
  add_points(mesh, point_map, soup, concurrency);
  add_facets(mesh, soup, concurrency);
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

} // namespace PowerRTF::internal
} // namespace CGAL

#endif // CGAL_POWER_RTF_INPUT_READ_MESH_H
