// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which samples on creases and borders lie on borders.
#ifndef CGAL_POWER_RTF_EXTRACTION_BORDER_SAMPLES_H
#define CGAL_POWER_RTF_EXTRACTION_BORDER_SAMPLES_H

#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// By sample of `features`.
inline std::vector<char> are_on_border(const Surface& surface, const Feature_samples& features)
{
  std::vector<char> result(features.size(), 0);
  if (features.size() == 0 || surface.adjacency.border_edges == 0) return result;
  std::vector<Edge> borders; // and each of their vertices twice
  const std::vector<int>& opposite = surface.adjacency.opposite;
  for (int h = 0; h < static_cast<int>(opposite.size()); ++h) {
    if (opposite[h] != Facet_adjacency::none) continue;
    const int a = halfedge_source(surface.triangles, h), b = halfedge_target(surface.triangles, h);
    borders.insert(borders.end(), {sorted_edge(a, b), {a, a}});
  }
  std::sort(borders.begin(), borders.end());
  for (std::size_t k = 0; k < features.size(); ++k) {
    const Edge_place& p = features.places[k];
    result[k] = std::binary_search(borders.begin(), borders.end(), sorted_edge(p.from, p.to));
  }
  return result;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_BORDER_SAMPLES_H
