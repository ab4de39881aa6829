// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the extracted triangles to a mesh of the user's type, with the sources that are asked for.
#ifndef CGAL_POWER_RTF_TRANSFER_EXPORT_WITH_SOURCES_H
#define CGAL_POWER_RTF_TRANSFER_EXPORT_WITH_SOURCES_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/extraction/export_mesh.h>
#include <CGAL/PowerRTF/input/read_mesh.h>
#include <CGAL/PowerRTF/internal/Stage.h>
#include <CGAL/PowerRTF/named_parameters.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF/transfer/Mesh_source.h>
#include <CGAL/PowerRTF/transfer/find_corner_sources.h>
#include <CGAL/PowerRTF/transfer/find_sources.h>
#include <CGAL/PowerRTF/transfer/keep_labels.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <optional>
#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The vertices and the faces of a mesh, in its order.
template <class FaceGraph>
auto vertices_of(const FaceGraph& mesh)
{
  const auto range = vertices(mesh);
  return std::vector<typename boost::graph_traits<FaceGraph>::vertex_descriptor>(range.begin(),
                                                                                 range.end());
}
template <class FaceGraph>
auto faces_of(const FaceGraph& mesh)
{
  const auto range = faces(mesh);
  return std::vector<typename boost::graph_traits<FaceGraph>::face_descriptor>(range.begin(),
                                                                               range.end());
}

/// The elements of a mesh, as the sources number them.
template <class FaceGraph>
struct Source_elements {
  using Graph_traits = boost::graph_traits<FaceGraph>;

  explicit Source_elements(const FaceGraph& mesh)
      : vertices(vertices_of(mesh)), faces(faces_of(mesh))
  {}

  Mesh_source<FaceGraph> operator()(const Source& s) const
  {
    const Triangle& t = s.vertices;
    return {faces[s.face], {vertices[t[0]], vertices[t[1]], vertices[t[2]]}, s.weights, {}};
  }
  /// That of face `f`.
  Mesh_source<FaceGraph> operator()(const Sources& sources, std::size_t f) const
  {
    Mesh_source<FaceGraph> result = (*this)(sources.faces[f]);
    for (const int k : sources.shares[f]) result.faces.push_back(faces[k]);
    return result;
  }

  std::vector<typename Graph_traits::vertex_descriptor> vertices;
  std::vector<typename Graph_traits::face_descriptor> faces;
};

/// Sets the maps `vertex_source_map`, `face_source_map` and `corner_source_map`, those of them that
/// `np` has. \param triangles of the mesh that has become `output`
template <class FaceGraph, class OutputMesh, class NamedParameters>
void put_sources(const Sources& sources, const Source_elements<FaceGraph>& input,
                 const Exported_mesh<OutputMesh>& exported, const std::vector<Triangle>& triangles,
                 const OutputMesh& output, const NamedParameters& np)
{
  if constexpr (has_parameter<NamedParameters, vertex_source_map_t>()) {
    const auto map = CGAL::parameters::get_parameter(np, vertex_source_map_t());
    for (std::size_t i = 0; i < exported.vertices.size(); ++i)
      put(map, exported.vertices[i], input(sources.vertices[exported.points[i]]));
  }
  if constexpr (has_parameter<NamedParameters, face_source_map_t>()) {
    const auto map = CGAL::parameters::get_parameter(np, face_source_map_t());
    for (std::size_t f = 0; f < exported.faces.size(); ++f)
      put(map, exported.faces[f], input(sources, f));
  }
  if constexpr (has_parameter<NamedParameters, corner_source_map_t>()) {
    const auto map = CGAL::parameters::get_parameter(np, corner_source_map_t());
    const auto points = get(CGAL::dynamic_vertex_property_t<int>(), output);
    for (std::size_t i = 0; i < exported.vertices.size(); ++i)
      put(points, exported.vertices[i], exported.points[i]);
    for (std::size_t f = 0; f < exported.faces.size(); ++f)
      for (const auto h : halfedges_around_face(halfedge(exported.faces[f], output), output)) {
        const Triangle& t = triangles[f];
        const auto corner = std::find(t.begin(), t.end(), get(points, target(h, output)));
        put(map, h, input(sources.corners[f][corner - t.begin()]));
      }
  }
}

/// The labels of the input's faces, the values of the named parameter `face_patch_map`.
template <class FaceGraph, class NamedParameters>
auto label_values(const FaceGraph& input, const NamedParameters& np)
{
  const auto map = CGAL::parameters::get_parameter(np, internal_np::face_patch);
  std::vector<typename boost::property_traits<std::decay_t<decltype(map)>>::value_type> labels;
  for (const auto f : faces(input)) labels.push_back(get(map, f));
  return labels;
}

/// Sets `face_patch_map` of `np` to `label(f)` of the f-th face.
template <class OutputMesh, class NamedParameters, class Label>
void put_labels(const Exported_mesh<OutputMesh>& exported, const NamedParameters& np,
                const Label& label)
{
  const auto map = CGAL::parameters::get_parameter(np, internal_np::face_patch);
  for (std::size_t f = 0; f < exported.faces.size(); ++f) put(map, exported.faces[f], label(f));
}

/// Exports `mesh`, the result of remeshing `input`, as `export_mesh()`, and sets the maps of
/// sources and labels that `np_out` has.
///
/// \param patches `patches()` returns the patch of each triangle
/// \param report of the run; gets the seconds
/// \param find what finds the links of the triangles of `mesh` instead, where it does
template <class InputMesh, class NamedParametersIn, class Patches, class OutputMesh,
          class NamedParametersOut>
void export_with_sources(const InputMesh& input, const NamedParametersIn& np_in,
                         const Extracted_mesh& mesh, const Normalization& normalization,
                         const Patches& patches, OutputMesh& output,
                         const NamedParametersOut& np_out, Remeshing_report& report,
                         Concurrency concurrency, const Find_links& find)
{
  constexpr bool puts_labels = has_parameter<NamedParametersOut, internal_np::face_patch_t>(),
                 has_labels = has_parameter<NamedParametersIn, internal_np::face_patch_t>();
  constexpr bool puts_sources = has_output_parameter<NamedParametersOut>();
  std::optional<Source_elements<InputMesh>> elements; // of `input`, which may be `output`
  Sources sources;
  if constexpr (puts_sources || (puts_labels && has_labels)) {
    const Stage stage("transfer", report.seconds.transfer);
    elements.emplace(input);
    const auto soup = soup_of_mesh(input, np_in, concurrency);
    sources =
        find_sources(soup, normalization, report.faces_as_input(), mesh.points, mesh.triangles,
                     concurrency, has_parameter<NamedParametersOut, face_source_map_t>());
    keep_labels(sources, soup, face_labels(input, np_in), normalization, mesh, concurrency);
    if constexpr (has_parameter<NamedParametersOut, corner_source_map_t>())
      sources.corners =
          find_corner_sources(soup, constrained_edges(input, np_in).value_or(std::vector<Edge>()),
                              normalization, mesh.points, mesh.triangles, sources, concurrency);
  }
  const Stage stage("write", report.seconds.write);
  const Uninterrupted run; // else the output could be neither what it was nor the result
  const auto find_safely = [&find](Triangle_links& links) {
    try {
      return find && find(links);
    } catch (const std::exception&) { // a device that fails now: the host goes on
      return false;
    }
  };
  if constexpr (puts_labels && has_labels) {
    const auto labels = label_values(input, np_in);
    const auto exported =
        export_mesh(mesh, normalization, output, np_out, concurrency, find_safely);
    put_sources(sources, *elements, exported, mesh.triangles, output, np_out);
    put_labels(exported, np_out, [&](std::size_t f) { return labels[sources.faces[f].face]; });
  } else {
    const auto exported =
        export_mesh(mesh, normalization, output, np_out, concurrency, find_safely);
    if constexpr (puts_sources)
      put_sources(sources, *elements, exported, mesh.triangles, output, np_out);
    if constexpr (puts_labels)
      put_labels(exported, np_out, [numbers = patches()](std::size_t f) { return numbers[f]; });
  }
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_TRANSFER_EXPORT_WITH_SOURCES_H
