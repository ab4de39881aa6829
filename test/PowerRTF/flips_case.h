// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges that an engine finds worth a flip, perhaps, against a look at all.
#ifndef POWER_RTF_TEST_FLIPS_CASE_H
#define POWER_RTF_TEST_FLIPS_CASE_H

#include "sweeps_case.h"

#include <doctest/doctest.h>

#include <CGAL/PowerRTF/improvement/better_flips.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace flips_case {

using namespace CGAL::PowerRTF;

/// Of a mesh of `n` vertices on `soup`. `make(surface)` returns a pointer to an engine.
template <class Make>
void check(const shapes::Soup& soup, std::size_t n, const Make& make)
{
  const improvement_case::Case c = improvement_case::make_case(soup, n, 1);
  const auto engine = make(c.surface);
  engine->facet_finder(); // the surface is there
  const auto there = c.raw.there(engine->mesh_bringer());
  REQUIRE(there);
  Triangle_links links;
  REQUIRE(there->topology(&links));
  std::vector<int> halfedges;
  REQUIRE(there->find_flips(halfedges));
  CHECK(std::is_sorted(halfedges.begin(), halfedges.end()));

  const Facet_tree tree(c.surface.points, c.surface.triangles);
  const internal::Surface_projector projector(c.surface, tree);
  const internal::Star_mesh mesh(c.raw, projector);
  const auto& topology = mesh.working().mesh;
  const auto energy = [](const Vec3d& p, const Vec3d& q, const Vec3d& r) {
    return internal::shape_energy(p, q, r);
  };
  std::size_t better = 0;
  for (int h = 0; h < int(links.opposite.size()); ++h) {
    if (links.opposite[h] < h) continue;
    const auto e = topology.edge(
        topology.halfedge(internal::Working_mesh::Vertex(c.raw.triangles[h / 3][h % 3]),
                          internal::Working_mesh::Vertex(c.raw.triangles[h / 3][(h + 1) % 3])));
    if (!is_better_flipped(mesh, e, energy, internal::least_shape_energy, -1)) continue;
    ++better;
    CHECK(std::binary_search(halfedges.begin(), halfedges.end(), h));
  }
  CHECK(better > 0);
  CHECK(halfedges.size() < better + topology.number_of_edges() / 10);
}

} // namespace flips_case

#endif // POWER_RTF_TEST_FLIPS_CASE_H
