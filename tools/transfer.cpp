// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "transfer.h"

#include "mesh_io.h"

#include <CGAL/PowerRTF/transfer/Mesh_source.h>

#include <cmath>
#include <cstddef>

namespace tools {
namespace {

using CGAL::PowerRTF::interpolated;
using CGAL::PowerRTF::Source;
using CGAL::PowerRTF::Sources;
using CGAL::PowerRTF::values_at;

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

Mesh_property of_faces(const Mesh_property& property, const std::vector<Source>& sources)
{
  return {property.name, property.type, values_at(property.values, sources), property.names};
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

Mesh_properties transferred(const Mesh_properties& input, const Sources& sources)
{
  Mesh_properties result;
  for (const Mesh_property& p : input.vertices)
    result.vertices.push_back(of_vertices(p, sources.vertices));
  for (const Mesh_property& p : input.faces) result.faces.push_back(of_faces(p, sources.faces));
  normalize(result.vertices);
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
