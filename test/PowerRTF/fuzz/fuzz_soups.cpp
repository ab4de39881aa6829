// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any polygons become a sound surface, or are refused with the reason.
#include "../exact_judge.h"
#include "engine.h"
#include "mutate_polygons.h"
#include "options_of.h"
#include "promise.h"

#include <CGAL/PowerRTF/input/import_surface.h>

#include <cmath>

namespace {

using namespace CGAL::PowerRTF;

void check(const Surface& s, std::size_t input_points)
{
  judge::Mesh mesh;
  for (const Vec3d& p : s.points) mesh.points.emplace_back(p.x, p.y, p.z);
  for (const Triangle& t : s.triangles)
    mesh.facets.push_back({std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2])});
  const judge::Topology topology = judge::topology(mesh);
  fuzz::promise(topology.facets > 0, "a surface has facets");
  fuzz::promise(topology.unused_vertices == 0, "all vertices are those of facets");
  fuzz::promise(topology.is_manifold(), "a surface is a 2-manifold");
  fuzz::promise(topology.oriented == topology.orientable, "facets agree where they can");
  for (const auto& n : s.facet_normals)
    fuzz::promise(std::abs(length(n) - 1) < 1e-9, "facets have unit normals");
  for (const auto& n : s.vertex_normals)
    fuzz::promise(std::abs(length(n) - 1) < 1e-9, "vertices have unit normals");
  double area = 0; // a facet may have none: not all can be removed
  for (const double a : s.facet_areas) {
    fuzz::promise(a >= 0, "no area is negative");
    area += a;
  }
  fuzz::promise(area > 0, "a surface has an area");
  for (const int v : s.input_vertices)
    fuzz::promise(v >= -1 && v < int(input_points), "vertices are the input's");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const auto input = fuzz::polygons_of(fuzz::text_of(data, size));
  if (!input) return -1;
  const Remeshing_options options = fuzz::options_of(*input);
  try {
    Repair_counts repairs;
    check(import_soup(input->points, input->polygons, repairs, options.repair),
          input->points.size());
  } catch (const Invalid_input_error& e) {
    fuzz::promise(e.what()[0] != 0, "a refusal has a reason");
  }
  return 0;
}
