// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Creases that the samples cannot resolve: of two that run closer together than samples do, only
// one is kept. (The rim of a thin sheet has two; between them there is room for slivers only.)
#ifndef CGAL_POWER_RTF_SURFACE_NARROW_PATCHES_H
#define CGAL_POWER_RTF_SURFACE_NARROW_PATCHES_H

#include <CGAL/PowerRTF/surface/cut_surface.h>
#include <CGAL/PowerRTF/surface/feature_curves.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL {
namespace PowerRTF {
namespace internal {

/// A curve of creases between two patches; no seam.
struct Crease_curve {
  std::vector<Edge> edges;
  double length = 0;
  std::array<int, 2> patches{-1, -1};
};

inline std::vector<Crease_curve> crease_curves(const Surface& surface, const Cut_surface& cut,
                                               std::vector<double>& perimeters)
{
  const auto& triangles = surface.triangles;
  const Facet_adjacency adjacency = facet_adjacency(triangles, surface.points.size());
  std::vector<std::array<int, 2>> sides(surface.creases.size(), {-1, -1}); // of the creases
  for (int h = 0; h < static_cast<int>(adjacency.opposite.size()); ++h) {
    const int a = halfedge_source(triangles, h), b = halfedge_target(triangles, h);
    const Edge edge = sorted_edge(a, b);
    const auto crease = std::lower_bound(surface.creases.begin(), surface.creases.end(), edge);
    const bool is_crease = crease != surface.creases.end() && *crease == edge;
    if (!is_crease && adjacency.opposite[h] != Facet_adjacency::none) continue;
    const int patch = cut.surface.facet_patches[h / 3];
    perimeters[patch] += length(surface.points[b] - surface.points[a]);
    if (is_crease) sides[crease - surface.creases.begin()][a < b] = patch;
  }

  std::vector<Crease_curve> curves;
  for (const Feature_curve& curve : feature_curves(surface, 0)) {
    Crease_curve result;
    bool has_seam = false;
    for (std::size_t k = 0; k + 1 < curve.vertices.size(); ++k) {
      const Edge edge = sorted_edge(curve.vertices[k], curve.vertices[k + 1]);
      const auto crease = std::lower_bound(surface.creases.begin(), surface.creases.end(), edge);
      if (crease == surface.creases.end() || *crease != edge) continue; // a border
      has_seam = has_seam || std::binary_search(surface.seams.begin(), surface.seams.end(), edge);
      result.edges.push_back(edge);
      result.length += length(surface.points[edge[1]] - surface.points[edge[0]]);
      result.patches = sides[crease - surface.creases.begin()];
    }
    if (!result.edges.empty() && !has_seam) curves.push_back(std::move(result));
  }
  return curves;
}

} // namespace internal

/// Joins each patch narrower than `width` (twice its area over its perimeter) to a neighbour: the
/// longest crease curve around it is taken out of `surface.creases`, the first of equal ones.
inline void join_narrow_patches(Surface& surface, double width)
{
  for (bool changed = true; changed && !surface.creases.empty();) {
    changed = false;
    const Cut_surface cut = cut_along_creases(surface);
    const auto& patches = cut.surface.facet_patches;
    const std::size_t count = *std::max_element(patches.begin(), patches.end()) + 1;
    std::vector<double> areas(count, 0), perimeters(count, 0);
    for (std::size_t f = 0; f < patches.size(); ++f) areas[patches[f]] += surface.facet_areas[f];
    const auto curves = internal::crease_curves(surface, cut, perimeters);

    std::vector<int> longest(count, -1);
    for (std::size_t c = 0; c < curves.size(); ++c)
      for (const int p : curves[c].patches)
        if (curves[c].patches[0] != curves[c].patches[1] &&
            (longest[p] < 0 || curves[c].length > curves[longest[p]].length * (1 + 1e-9)))
          longest[p] = static_cast<int>(c);
    std::vector<Edge> dropped;
    std::vector<char> is_joined(count, 0); // in this pass
    for (std::size_t p = 0; p < count; ++p) {
      if (longest[p] < 0 || !(2 * areas[p] < width * perimeters[p])) continue;
      const internal::Crease_curve& curve = curves[longest[p]];
      if (is_joined[curve.patches[0]] || is_joined[curve.patches[1]]) continue;
      is_joined[curve.patches[0]] = is_joined[curve.patches[1]] = 1;
      dropped.insert(dropped.end(), curve.edges.begin(), curve.edges.end());
    }
    if (dropped.empty()) break;
    changed = true;
    std::sort(dropped.begin(), dropped.end());
    std::vector<Edge> kept;
    std::set_difference(surface.creases.begin(), surface.creases.end(), dropped.begin(),
                        dropped.end(), std::back_inserter(kept));
    surface.creases.swap(kept);
  }
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_SURFACE_NARROW_PATCHES_H
