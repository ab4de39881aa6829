// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any polygons become a sound surface, or are refused with the reason.
#include "engine.h"
#include "mutate_polygons.h"
#include "options_of.h"
#include "promise.h"

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/input/import_surface.h>

#include <cmath>

namespace {

using namespace CGAL::PowerRTF;

void check(const Surface& s, std::size_t input_points)
{
  const auto adjacency = facet_adjacency(s.triangles, s.points.size());
  fuzz::promise(!s.triangles.empty(), "a surface has facets");
  fuzz::promise(adjacency.non_manifold_edges == 0 && !adjacency.same_direction &&
                    !adjacency.repeated_facets,
                "facets agree at edges of one or two");
  fuzz::promise(count_non_manifold_vertices(s.triangles, adjacency, s.points.size()) == 0,
                "sheets do not touch in vertices");
  fuzz::promise(adjacency.opposite == s.adjacency.opposite, "the adjacency is up to date");
  for (const auto& n : s.facet_normals)
    fuzz::promise(std::abs(length(n) - 1) < 1e-9, "facets have unit normals");
  for (const auto& n : s.vertex_normals)
    fuzz::promise(std::abs(length(n) - 1) < 1e-9, "vertices have unit normals");
  for (const double area : s.facet_areas) fuzz::promise(area > 0, "facets have areas");
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

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                    unsigned seed)
{
  return fuzz::mutate_polygons(data, size, max_size, seed);
}
