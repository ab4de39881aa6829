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

/// The cells of `cloud`, as the engines construct them from a first guess of their radii; `cloud`
/// is put into spatial order and gets normals of length 1.
template <class Construction, class Tag = CGAL::Sequential_tag>
std::vector<Cell_polygon> construct(Cloud& cloud, const Remeshing_options& options,
                                    double first_radius)
{
  Cloud sorted = cloud;
  Owned_sites sites;
  int i = 0;
  for (int k : internal::spatial_order(cloud.samples.points)) {
    sorted.samples.points[i] = cloud.samples.points[k];
    sorted.samples.normals[i] = normalized(cloud.samples.normals[k]);
    sorted.samples.weights[i] = cloud.samples.weights[k];
    sites.add(sorted.samples.points[i], sorted.samples.normals[i], sorted.samples.weights[i]);
    ++i;
  }
  cloud = sorted;
  Host_backend<Tag> backend;
  Tree_cells<double, Host_backend<Tag>, Construction> tree(backend, i, cloud.cos_angle,
                                                           first_radius, options);
  tree.set_sites(sites.arrays());
  std::vector<Cell_polygon> cells(cloud.size());
  tree.for_each_cell([&](int site, Cell_status status, const auto& polygon, const auto& frame) {
    Cell_polygon& cell = cells[site];
    for (int k = 0; k < polygon.size; ++k) {
      cell.vertices.push_back(cloud.samples.points[site] + frame.u * polygon.x[k] +
                              frame.v * polygon.y[k]);
      cell.neighbors.push_back(polygon.neighbor[k]);
    }
    cell.area = cell_moments(polygon).area;
    cell.status = status;
  });
  return cells;
}

} // namespace fast_cells

#endif // CGAL_POWER_RTF_TEST_FAST_CELLS_H
