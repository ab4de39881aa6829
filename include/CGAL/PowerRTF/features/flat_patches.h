// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flat parts of a surface.
#ifndef CGAL_POWER_RTF_FEATURES_FLAT_PATCHES_H
#define CGAL_POWER_RTF_FEATURES_FLAT_PATCHES_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <vector>

namespace CGAL::PowerRTF {

/// The maximal sets of connected facets whose normals differ from that of their first facet by less
/// than a tenth of a degree.
class Flat_patches {
public:
  explicit Flat_patches(const Surface& surface) : m_patches(surface.triangles.size(), -1)
  {
    const std::vector<int>& opposite = surface.adjacency.opposite;
    for (int f = 0; f < int(surface.triangles.size()); ++f)
      if (m_patches[f] < 0) grow(surface, f);
    m_perimeters.assign(m_areas.size(), 0);
    const auto is_boundary = [&](int h) {
      const int o = opposite[h];
      return o == Facet_adjacency::none || m_patches[o / 3] != m_patches[h / 3];
    };
    for (int h = 0; h < int(opposite.size()); ++h)
      if (is_boundary(h))
        m_perimeters[m_patches[h / 3]] +=
            length(surface.points[halfedge_target(surface.triangles, h)] -
                   surface.points[halfedge_source(surface.triangles, h)]);
  }

  /// The width of the patch of facet `f`: twice its area over its perimeter.
  double width(int f) const { return 2 * m_areas[m_patches[f]] / m_perimeters[m_patches[f]]; }

private:
  void grow(const Surface& surface, int seed)
  {
    constexpr double flat = 1 - 1.5e-6; // cosine
    const int patch = int(m_areas.size());
    double area = 0;
    std::vector<int> facets(1, seed);
    m_patches[seed] = patch;
    for (std::size_t k = 0; k < facets.size(); ++k) {
      area += surface.facet_areas[facets[k]];
      for (int h = 3 * facets[k]; h < 3 * facets[k] + 3; ++h) {
        const int o = surface.adjacency.opposite[h];
        if (o == Facet_adjacency::none || m_patches[o / 3] >= 0 ||
            !(dot(surface.facet_normals[o / 3], surface.facet_normals[seed]) > flat))
          continue;
        m_patches[o / 3] = patch;
        facets.push_back(o / 3);
      }
    }
    m_areas.push_back(area);
  }

  std::vector<int> m_patches; // by facet
  std::vector<double> m_areas, m_perimeters;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_FLAT_PATCHES_H
