// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faces of a mesh by the places of their centers.
#ifndef CGAL_POWER_RTF_TEST_REGIONS_FACES_WHERE_H
#define CGAL_POWER_RTF_TEST_REGIONS_FACES_WHERE_H

#include "../mesh_of_shape.h"
#include "../shapes.h"

#include <CGAL/tags.h>

#include <doctest/doctest.h>

#include <cmath>
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

/// A region becomes the same on one thread, and for a scaled mesh.
/// \param remesh `remesh(faces, mesh, concurrency tag)`
template <class Remesh>
void check_invariance(const Remesh& remesh)
{
  const auto points = [&](double scale, auto concurrency) {
    Mesh mesh = shapes::make_mesh(shapes::scaled(shapes::icosphere(4), scale));
    remesh(faces_where(mesh, [scale](const Vec3d& p) { return is_upper((1 / scale) * p); }), mesh,
           concurrency);
    std::vector<Vec3d> result;
    for (const auto v : mesh.vertices())
      result.push_back((1 / scale) * CGAL::PowerRTF::internal::to_vec3d(mesh.point(v)));
    return result;
  };
  const std::vector<Vec3d> one = points(1, CGAL::Parallel_if_available_tag());
  CHECK(one == points(1, CGAL::Sequential_tag()));
  CHECK(one == points(std::ldexp(1., -30), CGAL::Sequential_tag()));
}

} // namespace regions

#endif // CGAL_POWER_RTF_TEST_REGIONS_FACES_WHERE_H
