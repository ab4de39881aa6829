// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells of given sites, as users see them: without a surface, and without an engine that keeps
// them.
#ifndef CGAL_POWER_RTF_CELLS_CELLS_OF_SITES_H
#define CGAL_POWER_RTF_CELLS_CELLS_OF_SITES_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/cells/Cell_polygon.h>
#include <CGAL/PowerRTF/cells/Tree_cells.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// What cells are made of.
struct Cell_sites {
  Samples samples;         ///< those that have cells first; the others only clip
  int cells = 0;           ///< how many have cells
  double area = 0;         ///< of the surface: a guess of the cells' sizes begins with it
  double cos_angle = -2;   ///< of Theta; -2: all sites are compatible
  double guard_factor = 3; ///< as in `Remeshing_options`
};

/// The cells of the sites in double precision, whatever engine has placed them. The same bits for
/// any number of threads.
template <class ConcurrencyTag>
std::vector<Cell_polygon> cells_of_sites(const Cell_sites& in)
{
  const Samples& s = in.samples;
  if (in.cells == 0) return {};
  Owned_sites sites;
  sites.patches = s.patches;
  for (std::size_t i = 0; i < s.size(); ++i) sites.add(s.points[i], s.normals[i], s.weights[i]);
  Sites_arrays<double> arrays = sites.arrays();
  arrays.cells = in.cells;
  Remeshing_options options;
  options.guard_factor = in.guard_factor;
  const int size = static_cast<int>(s.size());
  const double radius = first_search_radius(options.neighbors, in.area, size);
  Host_backend<ConcurrencyTag> backend;
  Tree_cells<double, Host_backend<ConcurrencyTag>> tree(backend, size, in.cos_angle, radius,
                                                        options);
  tree.set_sites(arrays);
  std::vector<Cell_polygon> cells(in.cells);
  tree.for_each_cell([&](int i, Cell_status status, const auto& polygon, const auto&) {
    cells[i] = cell_polygon(s, i, status, polygon);
  });
  return cells;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_CELLS_OF_SITES_H
