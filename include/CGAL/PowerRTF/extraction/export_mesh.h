// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the extracted triangles to a mesh of the user's type: the counterpart of import_surface.h.
#ifndef CGAL_POWER_RTF_EXTRACTION_EXPORT_MESH_H
#define CGAL_POWER_RTF_EXTRACTION_EXPORT_MESH_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/extraction/connect_halfedges.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>

#include <array>
#include <cstddef>
#include <numeric>
#include <type_traits>
#include <vector>

namespace CGAL {

template <class Point>
class Surface_mesh;

namespace PowerRTF {

/// What `export_mesh()` has made of points and triangles.
template <class OutputMesh>
struct Exported_mesh {
  using Graph_traits = boost::graph_traits<OutputMesh>;

  std::vector<typename Graph_traits::vertex_descriptor> vertices;
  std::vector<int> points;                                   ///< of the vertices
  std::vector<typename Graph_traits::face_descriptor> faces; ///< of the triangles
};

namespace internal {

template <class Point>
Point from_vec3d(const Vec3d& p)
{
  if constexpr (std::is_same<Point, Vec3d>::value)
    return p;
  else
    return Point(p.x, p.y, p.z);
}

template <class FaceGraph>
void remove_all_elements(FaceGraph& mesh)
{
  CGAL::clear(mesh);
}

/// `clear()` would remove the property maps too, and with them perhaps the one to be written.
template <class Point>
void remove_all_elements(CGAL::Surface_mesh<Point>& mesh)
{
  mesh.clear_without_removing_property_maps();
}

/// Adds the polygons to the empty mesh. `false`: a halfedge structure cannot hold one of them.
/// `exported`: gets what has been added.
template <class OutputMesh, class PointMap>
bool add_polygons(const std::vector<Vec3d>& points,
                  const std::vector<std::array<std::size_t, 3>>& polygons, OutputMesh& output,
                  const PointMap& point_map, Exported_mesh<OutputMesh>& exported)
{
  using Point = typename boost::property_traits<PointMap>::value_type;
  using Graph = boost::graph_traits<OutputMesh>;
  using Vertex = typename Graph::vertex_descriptor;
  std::vector<char> is_used(points.size(), 0);
  for (const auto& polygon : polygons)
    for (const std::size_t v : polygon) is_used[v] = 1;
  exported = {};
  std::vector<Vertex> vertices(points.size(), Graph::null_vertex());
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!is_used[v]) continue;
    vertices[v] = add_vertex(output);
    put(point_map, vertices[v], from_vec3d<Point>(points[v]));
    exported.vertices.push_back(vertices[v]);
    exported.points.push_back(static_cast<int>(v));
  }
  for (const auto& p : polygons) {
    const std::array<Vertex, 3> corners = {vertices[p[0]], vertices[p[1]], vertices[p[2]]};
    exported.faces.push_back(Euler::add_face(corners, output));
    if (exported.faces.back() == Graph::null_face()) return false;
  }
  return true;
}

/// The same of the triangles of `mesh`, in the coordinates of the input, where that is faster than
/// one by one: not here.
template <class OutputMesh, class PointMap>
bool add_triangles(const Extracted_mesh&, const Normalization&, OutputMesh&, const PointMap&,
                   Exported_mesh<OutputMesh>&, Concurrency, const Find_links&)
{
  return false;
}
template <class MeshPoint, class PointMap>
bool add_triangles(const Extracted_mesh& mesh, const Normalization& normalization,
                   CGAL::Surface_mesh<MeshPoint>& output, const PointMap& point_map,
                   Exported_mesh<CGAL::Surface_mesh<MeshPoint>>& exported, Concurrency concurrency,
                   const Find_links& find)
{
  using Mesh = CGAL::Surface_mesh<MeshPoint>;
  using Vertex = typename Mesh::Vertex_index;
  using Face = typename Mesh::Face_index;
  using Point = typename boost::property_traits<PointMap>::value_type;
  const int points = static_cast<int>(mesh.points.size()),
            faces = static_cast<int>(mesh.triangles.size());
  // 1 for those that are used; then, if some are not: how many of them are before
  Unset_vector<int> name = filled(concurrency, points, 0);
  for_each_index(concurrency, faces, [&](int f) {
    for (const int v : mesh.triangles[f]) atomic_store(&name[v], 1);
  });
  exported.points = select(concurrency, points, [&](int v) { return name[v] == 1; });
  const int vertices = static_cast<int>(exported.points.size());
  std::vector<Triangle> renamed;
  if (vertices < points) {
    exclusive_scan(concurrency, points, name.data());
    renamed.resize(mesh.triangles.size());
    for_each_index(concurrency, faces, [&](int f) {
      for (int k = 0; k < 3; ++k) renamed[f][k] = name[mesh.triangles[f][k]];
    });
  }
  const std::vector<Triangle>& triangles = vertices < points ? renamed : mesh.triangles;
  if (!connect_halfedges(output, triangles, vertices, concurrency,
                         vertices < points ? Find_links() : find))
    return false;
  resize_in_parallel(concurrency, exported.vertices, vertices);
  const bool is_own = std::is_same<PointMap, typename Mesh::template Property_map<Vertex, Point>>();
  for_each_index(is_own ? concurrency : Sequential_tag(), vertices, [&](int v) {
    exported.vertices[v] = Vertex(v);
    put(point_map, Vertex(v), from_vec3d<Point>(mesh.outside(exported.points[v], normalization)));
  });
  resize_in_parallel(concurrency, exported.faces, faces);
  for_each_index(concurrency, faces, [&](int f) {
    exported.faces[f] = Face(f); // begins at its first corner, as `Euler::add_face()` has it
    output.set_halfedge(Face(f), output.prev(output.halfedge(Face(f))));
  });
  return true;
}

/// Names for the vertices of copied points the points of `mesh` that they are copies of.
/// `polygons`: the triangles of `mesh`, in their order.
template <class OutputMesh>
void name_originals(const Extracted_mesh& mesh, const std::vector<Vec3d>& points,
                    const std::vector<std::array<std::size_t, 3>>& polygons,
                    Exported_mesh<OutputMesh>& exported)
{
  std::vector<int> originals(points.size());
  std::iota(originals.begin(), originals.end(), 0);
  for (std::size_t f = 0; f < polygons.size(); ++f)
    for (const std::size_t v : polygons[f])
      if (v >= mesh.points.size())
        for (const int original : mesh.triangles[f])
          if (squared_length(points[v] - points[original]) == 0) originals[v] = original;
  for (int& p : exported.points) p = originals[p];
}

} // namespace internal

/// Replaces the elements of `output` by those of `mesh`, in the input's coordinates. Vertices come
/// in the order of `mesh.points`; points without triangles make none.
///
/// \tparam OutputMesh a model of `MutableFaceGraph`
/// \param np may contain `vertex_point_map` (default: the output's own), whose points are
///   constructible from three coordinates
/// \param concurrency of what is done beside the calls of the maps; the result is the same for all
/// \param find what finds the links of the triangles of `mesh` instead, where it does
/// \returns which vertices and faces these are
///
/// A halfedge structure holds 2-manifolds only. Where the triangles form none (those of
/// `extract_by_insertion()` do), vertices are duplicated and triangles turned until they do.
template <class OutputMesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
Exported_mesh<OutputMesh>
export_mesh(const Extracted_mesh& mesh, const Normalization& normalization, OutputMesh& output,
            const NamedParameters& np = NamedParameters(),
            internal::Concurrency concurrency = Sequential_tag(), const Find_links& find = {})
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  auto point_map = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                    get_property_map(CGAL::vertex_point, output));
  Exported_mesh<OutputMesh> exported;
  internal::remove_all_elements(output);
  if (internal::add_triangles(mesh, normalization, output, point_map, exported, concurrency, find))
    return exported;
  std::vector<Vec3d> points = mesh.outside(normalization, concurrency);
  std::vector<std::array<std::size_t, 3>> polygons;
  polygons.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles)
    polygons.push_back({std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2])});
  if (internal::add_polygons(points, polygons, output, point_map, exported)) return exported;
  internal::remove_all_elements(output);
  Polygon_mesh_processing::orient_polygon_soup(points, polygons);
  internal::add_polygons(points, polygons, output, point_map, exported);
  internal::name_originals(mesh, points, polygons, exported);
  return exported;
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_EXPORT_MESH_H
