// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fast cells of a cloud of samples, and their comparison with the exact ones.
#ifndef CGAL_POWER_RTF_TEST_FAST_CELLS_H
#define CGAL_POWER_RTF_TEST_FAST_CELLS_H

#include "sample_families.h"

#include <CGAL/PowerRTF/cells/cell_moments.h>
#include <CGAL/PowerRTF/exact/Exact_construction.h>
#include <CGAL/PowerRTF/exact/check_cells.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>

#include <vector>

namespace fast_cells {

using namespace CGAL::PowerRTF;
using sample_families::Cloud;
using sample_families::families;
using sample_families::Family;

/// Puts `cloud` into spatial order, with normals of length 1.
inline void sort(Cloud& cloud)
{
  const Cloud before = cloud;
  int i = 0;
  for (int k : internal::spatial_order(before.samples.points)) {
    cloud.samples.points[i] = before.samples.points[k];
    cloud.samples.normals[i] = normalized(before.samples.normals[k]);
    cloud.samples.weights[i] = before.samples.weights[k];
    ++i;
  }
}

/// The cells of a sorted cloud by `tree`.
template <class Tree>
std::vector<Cell_polygon> construct(Tree& tree, const Cloud& cloud)
{
  const Samples& samples = cloud.samples;
  Owned_sites sites;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    sites.add(samples.points[i], samples.normals[i], samples.weights[i]);
  tree.set_sites(sites.arrays());
  std::vector<Cell_polygon> cells(cloud.size());
  tree.for_each_cell([&](int site, Cell_status status, const auto& polygon, const auto& frame) {
    Cell_polygon& cell = cells[site];
    for (int k = 0; k < polygon.size; ++k) {
      cell.vertices.push_back(samples.points[site] + frame.u * polygon.x[k] +
                              frame.v * polygon.y[k]);
      cell.neighbors.push_back(polygon.neighbor[k]);
    }
    cell.area = cell_moments(polygon).area;
    cell.status = status;
  });
  return cells;
}

/// The cells of `cloud`, as the engines construct them from a first guess of their radii; `cloud`
/// is sorted.
template <class Construction, class Tag = CGAL::Sequential_tag>
std::vector<Cell_polygon> construct(Cloud& cloud, const Remeshing_options& options,
                                    double first_radius)
{
  sort(cloud);
  Host_backend<Tag> backend;
  Tree_cells<double, Host_backend<Tag>, Construction> tree(backend, int(cloud.size()),
                                                           cloud.cos_angle, first_radius, options);
  return construct(tree, cloud);
}

} // namespace fast_cells

#endif // CGAL_POWER_RTF_TEST_FAST_CELLS_H
