// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What must hold for every imported surface.
#ifndef CGAL_POWER_RTF_TEST_SOUND_SURFACE_H
#define CGAL_POWER_RTF_TEST_SOUND_SURFACE_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sound_surface {

namespace PRTF = CGAL::PowerRTF;
using PRTF::Surface;
using PRTF::Vec3d;

/// What `import` says when it refuses.
template <class Import>
std::string reason(const Import& import)
{
  try {
    import();
  } catch (const PRTF::Invalid_input_error& e) {
    return e.what();
  }
  return "";
}

inline long euler_characteristic(const Surface& s)
{
  const auto adjacency = PRTF::facet_adjacency(s.triangles, s.points.size());
  const long borders = static_cast<long>(adjacency.border_edges);
  const long edges = (3 * static_cast<long>(s.triangles.size()) + borders) / 2;
  return static_cast<long>(s.points.size()) - edges + static_cast<long>(s.triangles.size());
}

inline void check_is_sound(const Surface& s)
{
  const auto adjacency = PRTF::facet_adjacency(s.triangles, s.points.size());
  CHECK(adjacency.non_manifold_edges == 0);
  CHECK_FALSE(adjacency.same_direction);
  CHECK_FALSE(adjacency.repeated_facets);
  CHECK(adjacency.opposite == s.adjacency.opposite);
  CHECK(adjacency.corners.first == s.adjacency.corners.first);
  CHECK(adjacency.corners.entries == s.adjacency.corners.entries);
  CHECK(PRTF::count_non_manifold_vertices(adjacency) == 0);
  CHECK(s.facet_normals.size() == s.triangles.size());
  CHECK(s.facet_areas.size() == s.triangles.size());
  CHECK(s.vertex_normals.size() == s.points.size());
  CHECK(s.vertex_density == std::vector<double>(s.points.size(), 1));
  CHECK(s.input_vertices.size() == s.points.size());
  for (const Vec3d& n : s.facet_normals) CHECK(length(n) == doctest::Approx(1));
  for (const Vec3d& n : s.vertex_normals) CHECK(length(n) == doctest::Approx(1));
  double side = 0;
  for (const Vec3d& p : s.points)
    side = std::max({side, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  CHECK(side <= 0.5 + 1e-12);
  CHECK(side > 0.25 - 1e-12);
}

} // namespace sound_surface

#endif // CGAL_POWER_RTF_TEST_SOUND_SURFACE_H
