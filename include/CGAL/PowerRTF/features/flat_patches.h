// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flat parts of a surface.
#ifndef CGAL_POWER_RTF_FEATURES_FLAT_PATCHES_H
#define CGAL_POWER_RTF_FEATURES_FLAT_PATCHES_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <vector>

namespace CGAL::PowerRTF {

/// The maximal sets of connected facets whose normals differ from that of their first facet by less
/// than an angle (its sine, by default a tenth of a degree).
class Flat_patches {
public:
  /// Of normals of coplanar facets whose coordinates are rounded to binary32.
  static constexpr double coplanar_sine = 1e-7;

  explicit Flat_patches(const Surface& surface, double max_sine = 1.73e-3)
      : m_max_sine(max_sine), m_patches(surface.triangles.size(), -1)
  {
    const std::vector<int>& opposite = surface.adjacency.opposite;
    for (int f = 0; f < int(surface.triangles.size()); ++f) {
      internal::Cancellation::poll_now_and_then();
      if (m_patches[f] < 0) grow(surface, f);
    }
    m_perimeters.assign(m_areas.size(), 0);
    const auto is_boundary = [&](int h) {
      const int o = opposite[h];
      return o == Facet_adjacency::none || m_patches[o / 3] != m_patches[h / 3];
    };
    for (int h = 0; h < int(opposite.size()); ++h) {
      internal::Cancellation::poll_now_and_then();
      if (is_boundary(h))
        m_perimeters[m_patches[h / 3]] +=
            length(surface.points[halfedge_target(surface.triangles, h)] -
                   surface.points[halfedge_source(surface.triangles, h)]);
    }
  }

  int operator[](int facet) const { return m_patches[facet]; }

  /// The width of the patch of facet `f`: twice its area over its perimeter.
  double width(int f) const { return 2 * m_areas[m_patches[f]] / m_perimeters[m_patches[f]]; }

private:
  void grow(const Surface& surface, int seed)
  {
    const Vec3d& n = surface.facet_normals[seed];
    const auto is_flat = [&](const Vec3d& m) {
      return dot(m, n) > 0 && squared_length(cross(m, n)) < m_max_sine * m_max_sine;
    };
    const int patch = int(m_areas.size());
    double area = 0;
    std::vector<int> facets(1, seed);
    m_patches[seed] = patch;
    for (std::size_t k = 0; k < facets.size(); ++k) {
      area += surface.facet_areas[facets[k]];
      for (int h = 3 * facets[k]; h < 3 * facets[k] + 3; ++h) {
        const int o = surface.adjacency.opposite[h];
        if (o == Facet_adjacency::none || m_patches[o / 3] >= 0 ||
            !is_flat(surface.facet_normals[o / 3]))
          continue;
        m_patches[o / 3] = patch;
        facets.push_back(o / 3);
      }
    }
    m_areas.push_back(area);
  }

  double m_max_sine;
  std::vector<int> m_patches; // by facet
  std::vector<double> m_areas, m_perimeters;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_FLAT_PATCHES_H
