// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for clean_surface.h.
#ifndef CGAL_POWER_RTF_INPUT_CLEAN_SURFACE_IMPL_H
#define CGAL_POWER_RTF_INPUT_CLEAN_SURFACE_IMPL_H

#include <CGAL/PowerRTF/input/clean_soup.h>
#include <CGAL/PowerRTF/input/clean_surface.h>

#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

namespace CGAL::PowerRTF::internal {

CGAL_POWER_RTF_INLINE Surface clean_surface(const Polygon_soup& soup, Repair repair,
                                            Repair_counts& repairs)
{
  if (soup.first.size() == 1) throw Invalid_input_error("the mesh has no facet");
  std::vector<char> used(soup.points.size(), 0);
  for (const int v : soup.corners) used[v] = 1;
  const Normalization normalization = unit_box(soup.points, used);

  std::vector<int> own_vertex(soup.points.size());
  std::iota(own_vertex.begin(), own_vertex.end(), 0);
  const std::vector<int> vertex =
      soup.merges_vertices ? first_of_equal_points(soup.points) : own_vertex;
  std::size_t duplicates = 0, unused = 0;
  for (std::size_t v = 0; v < used.size(); ++v) {
    duplicates += used[v] && vertex[v] != own_vertex[v];
    unused += !used[v];
  }
  std::vector<Vec3d> points(soup.points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    points[v] = used[v] ? normalization.to_inside(soup.points[v]) : Vec3d{0, 0, 0};

  std::string reason;
  for (const auto& [merges, allowed] : repair_attempts(repair, duplicates > 0)) {
    Repair_counts counts = repairs;
    counts.unused_vertices += unused;
    if (merges) counts.duplicate_vertices += duplicates;
    Surface surface;
    const Repair_status status = make_surface(soup, points, merges ? vertex : own_vertex,
                                              normalization, allowed, counts, surface);
    if (status.is_done() && (merges || surface.adjacency.border_edges == 0)) {
      repairs = counts;
      return surface;
    }
    if (merges && allowed != Manifold_repair::split_double) reason = status.failure;
  }
  throw Invalid_input_error(reason);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INPUT_CLEAN_SURFACE_IMPL_H
