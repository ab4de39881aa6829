// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the extracted triangles to a mesh of the user's type: the counterpart of import_surface.h.
#ifndef CGAL_POWER_RTF_EXTRACTION_EXPORT_MESH_H
#define CGAL_POWER_RTF_EXTRACTION_EXPORT_MESH_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>

#include <array>
#include <type_traits>
#include <vector>

namespace CGAL
{

template <class Point>
class Surface_mesh;

namespace PowerRTF
{
namespace internal
{

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

} // namespace internal

/// Replaces the elements of `output` by those of `mesh`, in the input's coordinates. Vertices come
/// in the order of `mesh.points`; points without triangles make none.
///
/// \tparam OutputMesh a model of `MutableFaceGraph`
/// \param np may contain `vertex_point_map` (default: the output's own), whose points are
///   constructible from three coordinates
///
/// A halfedge structure holds 2-manifolds only: a triangle that would break that is left out (a
/// result of `extract_by_insertion()` has none).
template <class OutputMesh, class NamedParameters = CGAL::parameters::Default_named_parameters>
void export_mesh(const Extracted_mesh& mesh, const Normalization& normalization, OutputMesh& output,
                 const NamedParameters& np = NamedParameters())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  using Point_map = typename GetVertexPointMap<OutputMesh, NamedParameters>::type;
  using Point = typename boost::property_traits<Point_map>::value_type;
  using Vertex = typename boost::graph_traits<OutputMesh>::vertex_descriptor;
  const Vertex none = boost::graph_traits<OutputMesh>::null_vertex();

  internal::remove_all_elements(output);
  Point_map point_map = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                         get_property_map(CGAL::vertex_point, output));
  std::vector<char> is_used(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) is_used[v] = 1;
  std::vector<Vertex> vertices(mesh.points.size(), none);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (!is_used[v]) continue;
    vertices[v] = add_vertex(output);
    put(point_map, vertices[v], internal::from_vec3d<Point>(normalization.to_outside(mesh.points[v])));
  }
  for (const Triangle& t : mesh.triangles)
    Euler::add_face(std::array<Vertex, 3>{vertices[t[0]], vertices[t[1]], vertices[t[2]]}, output);
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_EXPORT_MESH_H
