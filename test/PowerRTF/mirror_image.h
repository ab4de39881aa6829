// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_TEST_MIRROR_IMAGE_H
#define CGAL_POWER_RTF_TEST_MIRROR_IMAGE_H

#include "shapes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>

namespace mirror_image {

using namespace CGAL::PowerRTF;
using shapes::Soup;
using Point = std::array<double, 3>;

inline Point image(const Vec3d& p, int axis, double at)
{
  Point q{p.x, p.y, p.z};
  q[axis] = 2 * at - q[axis];
  return q;
}

/// How many vertices have no mirror image among the vertices, or more than one, or share their
/// point; and how many triangles none, turned over, among the triangles. In the numbers of the
/// mesh, bit for bit. (A zero has no sign.)
inline std::size_t differences(const Soup& mesh, int axis, double at)
{
  std::map<Point, int> vertices;
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    vertices[{mesh.points[v].x, mesh.points[v].y, mesh.points[v].z}] = int(v);
  std::size_t differences = mesh.points.size() - vertices.size();
  std::vector<int> images;
  for (const Vec3d& p : mesh.points) {
    const auto found = vertices.find(image(p, axis, at));
    images.push_back(found == vertices.end() ? -1 : found->second);
    differences += images.back() < 0;
  }
  const auto cycle = [](Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  std::set<Triangle> triangles;
  for (const Triangle& t : mesh.triangles) triangles.insert(cycle(t));
  for (const auto& [a, b, c] : mesh.triangles)
    differences += triangles.count(cycle({images[a], images[c], images[b]})) == 0;
  return differences;
}

/// The vertices on the plane.
inline std::size_t vertices_on(const Soup& mesh, int axis, double at)
{
  return std::count_if(mesh.points.begin(), mesh.points.end(), [&](const Vec3d& p) {
    return Point{p.x, p.y, p.z} == image(p, axis, at);
  });
}

} // namespace mirror_image

#endif // CGAL_POWER_RTF_TEST_MIRROR_IMAGE_H
