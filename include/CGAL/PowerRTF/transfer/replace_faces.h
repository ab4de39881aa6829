// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faces of the user's mesh are replaced by new ones, the others and their vertices stay the same
// elements.
#ifndef CGAL_POWER_RTF_TRANSFER_REPLACE_FACES_H
#define CGAL_POWER_RTF_TRANSFER_REPLACE_FACES_H

#include <CGAL/PowerRTF/Remeshed_region.h>
#include <CGAL/PowerRTF/extraction/export_mesh.h>
#include <CGAL/PowerRTF/transfer/Joined_mesh.h>
#include <CGAL/PowerRTF/transfer/export_with_sources.h>
#include <CGAL/PowerRTF/transfer/keep_labels.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// By face of `mesh`: whether it is one of `faces`.
template <class FaceGraph, class FaceRange>
std::vector<char> marks_of_faces(const FaceGraph& mesh, const FaceRange& faces)
{
  const auto places = get(CGAL::dynamic_face_property_t<int>(), mesh);
  int count = 0;
  for (const auto f : faces_of(mesh)) put(places, f, count++);
  std::vector<char> marks(count, 0);
  for (const auto f : faces) marks[get(places, f)] = 1;
  return marks;
}

/// Replaces the faces of `region`, of `mesh`, by the new ones of `joined`. Where these form no
/// 2-manifold with the others, they get copies of their vertices.
/// \param put_point `put_point(v, p)` gives a new vertex its point
/// \returns the new faces, in the order of the new triangles
template <class FaceGraph, class PutPoint>
auto replace_faces(FaceGraph& mesh, const Soup_region& region, const Joined_mesh& joined,
                   const PutPoint& put_point)
{
  using Graph_traits = boost::graph_traits<FaceGraph>;
  using Corners = std::array<typename Graph_traits::vertex_descriptor, 3>;
  const auto old_vertices = vertices_of(mesh);
  const auto old_faces = faces_of(mesh);
  for (const int f : region.polygons) Euler::remove_face(halfedge(old_faces[f], mesh), mesh);

  const std::size_t kept = joined.input_points.size();
  std::vector<typename Graph_traits::vertex_descriptor> vertices;
  for (const int v : joined.input_points) vertices.push_back(old_vertices[v]);
  const auto new_vertex = [&](const Vec3d& p) {
    const auto v = add_vertex(mesh);
    put_point(v, p);
    return v;
  };
  for (std::size_t v = kept; v < joined.points.size(); ++v)
    vertices.push_back(new_vertex(joined.points[v]));

  const std::size_t first = joined.input_polygons.size();
  std::vector<typename Graph_traits::face_descriptor> faces(joined.triangles.size() - first,
                                                            Graph_traits::null_face());
  std::vector<std::size_t> left; // a face may have to wait for others at its vertices
  for (std::size_t f = 0; f < faces.size(); ++f) left.push_back(f);
  const auto add = [&](std::size_t f, const auto& vertex) {
    const Triangle& t = joined.triangles[first + f];
    faces[f] = Euler::add_face(Corners{vertex(t[0]), vertex(t[1]), vertex(t[2])}, mesh);
    return faces[f] != Graph_traits::null_face();
  };
  for (std::size_t before = left.size() + 1; left.size() < before;) {
    before = left.size();
    left.erase(
        std::remove_if(left.begin(), left.end(),
                       [&](std::size_t f) { return add(f, [&](int v) { return vertices[v]; }); }),
        left.end());
  }
  for (const std::size_t f : left) add(f, [&](int v) { return new_vertex(joined.points[v]); });
  return faces;
}

/// Replaces the faces of a region of `mesh` by those of `part`, which it has become, and those that
/// change with it, and gives them labels, if `np` has any.
/// \param whole the soup of `mesh`
/// \param report of the run; gets the seconds and what is new about the whole
template <class FaceGraph, class NamedParameters>
void replace_region(FaceGraph& mesh, const NamedParameters& np, const Polygon_soup& whole,
                    const Remeshed_region& remeshed, Extracted_mesh part,
                    const Normalization& normalization, Remeshing_report& report,
                    Concurrency concurrency)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  const Stage stage("write", report.seconds.write);
  constexpr bool has_labels = has_parameter<NamedParameters, internal_np::face_patch_t>();
  const Soup_region& own = remeshed.own();
  Sources sources;
  if (has_labels) {
    sources = find_sources(own.soup, normalization, report.faces_as_input(), part.points,
                           part.triangles, concurrency);
    keep_labels(sources, own.soup, own.fields.labels, normalization, part, concurrency);
  }
  remeshed.complete(part, normalization);
  if (has_labels) remeshed.complete_sources(part, normalization, sources);
  const Soup_region& region = remeshed.replaced();
  const Joined_mesh joined(whole, region, part, normalization);
  report.changed_faces = remeshed.changed_faces();
  joined.judge(whole, region, report, concurrency);
  auto point_map = choose_parameter(get_parameter(np, internal_np::vertex_point),
                                    get_property_map(CGAL::vertex_point, mesh));
  using Point = typename boost::property_traits<decltype(point_map)>::value_type;
  const auto replace = [&] {
    return replace_faces(mesh, region, joined,
                         [&](auto v, const Vec3d& p) { put(point_map, v, from_vec3d<Point>(p)); });
  };
  if constexpr (has_labels) {
    const auto labels = label_values(mesh, np);
    const auto map = get_parameter(np, internal_np::face_patch);
    const auto faces = replace();
    for (std::size_t f = 0; f < faces.size(); ++f)
      put(map, faces[f], labels[region.polygons[sources.faces[f].face]]);
  } else {
    replace();
  }
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_TRANSFER_REPLACE_FACES_H
