// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faces of a mesh by the places of their centers.
#ifndef CGAL_POWER_RTF_TEST_REGIONS_FACES_WHERE_H
#define CGAL_POWER_RTF_TEST_REGIONS_FACES_WHERE_H

#include "../mesh_of_shape.h"
#include "../shapes.h"

#include <functional>
#include <vector>

namespace regions {

using CGAL::PowerRTF::Vec3d;
using shapes::Mesh;
using Is_inside = std::function<bool(const Vec3d&)>;

inline bool is_upper(const Vec3d& p) { return p.z > 0.1; }

inline Vec3d center(const Mesh& mesh, Mesh::Face_index f)
{
  Vec3d sum{0, 0, 0};
  int corners = 0;
  for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
    sum += CGAL::PowerRTF::internal::to_vec3d(mesh.point(v));
    ++corners;
  }
  return (1. / corners) * sum;
}

/// The faces whose centers are inside.
inline std::vector<Mesh::Face_index> faces_where(const Mesh& mesh, const Is_inside& is_inside)
{
  std::vector<Mesh::Face_index> result;
  for (const auto f : mesh.faces())
    if (is_inside(center(mesh, f))) result.push_back(f);
  return result;
}

inline Mesh sphere() { return shapes::make_mesh(shapes::icosphere(4)); }

} // namespace regions

#endif // CGAL_POWER_RTF_TEST_REGIONS_FACES_WHERE_H
