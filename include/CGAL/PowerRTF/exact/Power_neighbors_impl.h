// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for Power_neighbors.h.
#ifndef CGAL_POWER_RTF_EXACT_POWER_NEIGHBORS_IMPL_H
#define CGAL_POWER_RTF_EXACT_POWER_NEIGHBORS_IMPL_H

#include <CGAL/PowerRTF/exact/Power_neighbors.h>
#include <CGAL/PowerRTF/geometry/vector.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

CGAL_POWER_RTF_INLINE Power_neighbors::Power_neighbors(const std::vector<Vec3d>& points,
                                                       const std::vector<double>& weights)
    : m_neighbors(points.size()), m_doubtful(points.size(), 1)
{
  using Kernel = Exact_predicates_inexact_constructions_kernel;
  using Vertex_base =
      Triangulation_vertex_base_with_info_3<int, Kernel,
                                            Regular_triangulation_vertex_base_3<Kernel>>;
  using Cell_base = Regular_triangulation_cell_base_3<Kernel>;
  using Triangulation =
      Regular_triangulation_3<Kernel, Triangulation_data_structure_3<Vertex_base, Cell_base>>;

  const int n = int(points.size());
  std::vector<std::pair<Kernel::Weighted_point_3, int>> sites;
  sites.reserve(n);
  for (int i = 0; i < n; ++i)
    sites.emplace_back(
        Kernel::Weighted_point_3({points[i].x, points[i].y, points[i].z}, weights[i]), i);
  Triangulation triangulation(sites.begin(), sites.end());
  if (triangulation.dimension() < 3) return;

  for (const auto& edge : triangulation.finite_edges()) {
    const int i = edge.first->vertex(edge.second)->info();
    const int j = edge.first->vertex(edge.third)->info();
    m_neighbors[i].push_back(j);
    m_neighbors[j].push_back(i);
  }
  for (const auto& v : triangulation.finite_vertex_handles()) m_doubtful[v->info()] = 0;
  std::vector<int> hidden;
  for (int i = 0; i < n; ++i)
    if (m_doubtful[i]) hidden.push_back(i);
  for (int i : hidden) {
    const auto cell = triangulation.locate(sites[i].first);
    for (int k = 0; k < 4; ++k)
      if (!triangulation.is_infinite(cell->vertex(k))) m_doubtful[cell->vertex(k)->info()] = 1;
  }
  for (int i = 0; i < n; ++i) {
    std::sort(m_neighbors[i].begin(), m_neighbors[i].end(), [&](int j, int k) {
      const double dj = squared_length(points[j] - points[i]);
      const double dk = squared_length(points[k] - points[i]);
      return std::make_pair(dj, j) < std::make_pair(dk, k);
    });
  }
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXACT_POWER_NEIGHBORS_IMPL_H
