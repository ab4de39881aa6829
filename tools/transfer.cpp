// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "transfer.h"

#include "mesh_io.h"

#include <CGAL/PowerRTF/transfer/Mesh_source.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tools {
namespace {

using CGAL::PowerRTF::face_values;
using CGAL::PowerRTF::interpolated;
using CGAL::PowerRTF::Source;
using CGAL::PowerRTF::Sources;

Mesh_property of_vertices(const Mesh_property& property, const std::vector<Source>& sources)
{
  const bool is_label = !is_real(property.type) && !is_color(property.name);
  Mesh_property result{property.name, property.type, {}};
  result.values.reserve(sources.size());
  for (const Source& s : sources) {
    const auto& v = property.values;
    const double a = v[s.vertices[0]], b = v[s.vertices[1]], c = v[s.vertices[2]];
    result.values.push_back(is_label
                                ? interpolated((long long)a, (long long)b, (long long)c, s.weights)
                                : interpolated(a, b, c, s.weights));
  }
  return result;
}

Mesh_property of_faces(const Mesh_property& property, const Sources& sources)
{
  return {property.name, property.type, face_values(property.values, sources), property.names};
}

/// Corners that come from near the same place have the same coordinates, which for that are rounded
/// to single precision; those of a corner of the input are its own.
Texture of_corners(const Texture& texture, const CGAL::PowerRTF::Polygon_soup& soup,
                   const Sources& sources)
{
  constexpr double at_corner = 1 - 1e-9;
  Texture result;
  for (const auto& triangle : sources.corners)
    for (const Source& s : triangle) {
      std::array<int, 3> c;
      for (int i = 0; i < 3; ++i)
        c[i] = texture.corners[corner_number(soup, s.face, s.vertices[i])];
      if (*std::min_element(c.begin(), c.end()) < 0) {
        result.corners.push_back(-1);
        continue;
      }
      const auto& [a, b, d] = c;
      const auto& all = texture.coordinates;
      std::array<double, 2> uv = interpolated(all[a], all[b], all[d], s.weights);
      for (double& x : uv) x = static_cast<float>(x);
      for (int i = 0; i < 3; ++i)
        if (s.weights[i] > at_corner) uv = all[c[i]];
      result.corners.push_back(static_cast<int>(result.coordinates.size()));
      result.coordinates.push_back(uv);
    }
  result.merge_equal();
  return result;
}

/// Gives the normals, where there are some, the length 1.
void normalize(std::vector<Mesh_property>& properties)
{
  std::vector<double>* xyz[3];
  const char* const names[] = {"nx", "ny", "nz"};
  for (int k = 0; k < 3; ++k) {
    const Mesh_property* const found = find_property(properties, names[k]);
    if (!found) return;
    xyz[k] = &properties[found - properties.data()].values;
  }
  for (std::size_t i = 0; i < xyz[0]->size(); ++i) {
    const double length = std::hypot((*xyz[0])[i], (*xyz[1])[i], (*xyz[2])[i]);
    if (length > 0)
      for (std::vector<double>* const x : xyz) (*x)[i] /= length;
  }
}

} // namespace

int corner_number(const CGAL::PowerRTF::Polygon_soup& soup, int face, int vertex)
{
  const auto begin = soup.corners.begin();
  return static_cast<int>(
      std::find(begin + soup.first[face], begin + soup.first[face + 1], vertex) - begin);
}

Mesh_properties transferred(const Polygon_mesh& mesh, const Sources& sources)
{
  const Mesh_properties& input = mesh.properties;
  Mesh_properties result;
  for (const Mesh_property& p : input.vertices)
    result.vertices.push_back(of_vertices(p, sources.vertices));
  for (const Mesh_property& p : input.faces) result.faces.push_back(of_faces(p, sources));
  normalize(result.vertices);
  if (!input.texture.empty()) result.texture = of_corners(input.texture, mesh.soup, sources);
  result.material_files = input.material_files;
  result.gltf_materials = input.gltf_materials;
  result.texture_files = input.texture_files;
  result.side_files = input.side_files;
  return result;
}

void set_patches(const std::vector<int>& patches, Mesh_properties& properties)
{
  Mesh_property patch{"patch", Number_type::int32, {patches.begin(), patches.end()}};
  std::vector<Mesh_property>& faces = properties.faces;
  const Mesh_property* const old = find_property(faces, patch.name);
  if (old)
    faces[old - faces.data()] = std::move(patch);
  else
    faces.push_back(std::move(patch));
}

void write_sources(std::ostream& out, Format format, Encoding encoding,
                   const std::vector<CGAL::PowerRTF::Vec3d>& points,
                   const std::vector<CGAL::PowerRTF::Triangle>& triangles, const Sources& sources)
{
  constexpr Number_type index = Number_type::int32;
  Mesh_properties properties;
  Mesh_property face{"source_face", index, {}};
  for (const Source& s : sources.vertices) face.values.push_back(s.face);
  properties.vertices.push_back(face);
  for (int k = 0; k < 3; ++k) {
    Mesh_property corner{"source_vertex_" + std::to_string(k), index, {}};
    for (const Source& s : sources.vertices) corner.values.push_back(s.vertices[k]);
    properties.vertices.push_back(std::move(corner));
  }
  for (int k = 0; k < 3; ++k) {
    Mesh_property weight{"weight_" + std::to_string(k), Number_type::float64, {}};
    for (const Source& s : sources.vertices) weight.values.push_back(s.weights[k]);
    properties.vertices.push_back(std::move(weight));
  }
  face.values.clear();
  for (const Source& s : sources.faces) face.values.push_back(s.face);
  properties.faces.push_back(std::move(face));
  write_mesh(out, format, encoding, points, triangles, properties);
}

} // namespace tools
