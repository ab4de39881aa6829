// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Verlet lists of the GPU, run on the host. (The kernels themselves:
// cuda/test/test_cuda_cells.cu.)
#include "host_groups.h"

using namespace host_groups;

/// Keeps the list of a finished cell, all sites of which are compatible, with its edges in front.
void keep_list(const Verlet_lists<double>& lists, const Lane_cell<double>& cell,
               const Ring_polygon<double, 32>& polygon, const int* column)
{
  for (int k = 0; k < cell.listed; ++k)
    lists.neighbors[std::size_t(k) * lists.stride + cell.place] = column[k * 32];
  lists.sizes[cell.place] = static_cast<unsigned short>(cell.listed);
  lists.radius[cell.place] = cell.radius;
  lists.outside[cell.place] = std::min(cell.radius, std::sqrt(cell.outside2));
  reorder_list(lists, cell.place, polygon);
}

TEST_CASE("a Verlet list gives the cell of later weights, or says that it does not")
{
  const Input in = sphere(1500, 0.45, 6);
  const int n = static_cast<int>(in.points.size());
  std::vector<Packed_site<double>> sites(n);
  std::vector<Packed_normal<double>> normals(n);
  for (int i = 0; i < n; ++i) {
    sites[i] = {in.points[i], 0};
    normals[i] = {in.normals[i], 0};
  }
  Host_groups<double> groups(sites, normals); // not in Hilbert order: slow, but as right
  groups.view.cos_angle = 0;
  std::vector<double> density_root(n);
  for (int i = 0; i < n; ++i) density_root[i] = 1 + in.points[i].x;
  groups.view.density_root = density_root.data();
  std::vector<int> neighbors(std::size_t(n) * Verlet_lists<double>::capacity);
  std::vector<unsigned short> sizes(n, Verlet_lists<double>::none);
  std::vector<double> radius(n), outside(n);
  Verlet_lists<double> lists;
  lists.neighbors = neighbors.data();
  lists.sizes = sizes.data();
  lists.radius = radius.data();
  lists.outside = outside.data();
  lists.stride = n;
  const double spacing = std::sqrt(4 * 3.14159 * 0.2025 / n);
  auto memory = std::make_unique<Warp_memory<double>>();
  Ring_polygon<double, 32> polygon(memory->polygons, 3);
  std::vector<int> found;
  // The polygon of a cell by the sites within `r`; whether it is the cell.
  Lane_cell<double> cell;
  const auto construct = [&](int i, double r) {
    cell.clear();
    cell.place = i;
    cell.site = groups.sites[i];
    cell.radius = r;
    groups.gather({cell.site.point, cell.site.point, r, cell.site.weight}, found);
    REQUIRE(found.size() < Warp_memory<double>::max_candidates);
    for (std::size_t k = 0; k < found.size(); ++k) {
      memory->candidates.sites[k] = groups.sites[found[k]];
      memory->candidates.places[k] = found[k];
    }
    list_candidates(cell, *memory, static_cast<int>(found.size()), 3, 3);
    bool hopeless;
    return clip_listed(groups.view, cell, normals[i], Tangent_frame<double>(normals[i].normal),
                       memory->listed + 3, polygon, hopeless);
  };
  int kept = 0;
  for (int i = 0; i < n; ++i)
    if (construct(i, 1.1 * spacing) && cell.listed <= Verlet_lists<double>::capacity) {
      keep_list(lists, cell, polygon, memory->listed + 3);
      ++kept;
    }
  CHECK(kept > 0.9 * n);

  std::mt19937 random(2);
  for (const double size : {0.05, 0.3, 1.0}) { // in units of the squared spacing
    double growth = 0;
    for (int i = 0; i < n; ++i) {
      const double w = size * spacing * spacing * ((random() % 1000) / 1000.0 - 0.5);
      groups.sites[i].weight = w;
      growth = std::max(growth, w);
    }
    for (int level = 0; level < groups.view.tree.levels; ++level)
      for (int k = 0; k < groups.view.tree.nodes(level); ++k) groups.join_children(level, k);
    int proved = 0, compared = 0, chains = 0, reordered = 0, refused = 0;
    double error = 0, chain_error = 0;
    for (int i = 0; i < n; ++i) {
      if (sizes[i] == Verlet_lists<double>::none) continue;
      cell.place = i;
      cell.site = groups.sites[i];
      const Tangent_frame<double> frame(normals[i].normal);
      if (!clip_kept(groups.view, lists, cell, frame, radius[i], sizes[i], polygon)) continue;
      if (!list_suffices(std::sqrt(polygon.squared_radius()), radius[i], outside[i], 10.0,
                         cell.site.weight, growth, growth))
        continue;
      ++proved;
      const int* column = neighbors.data() + i;
      const double area = cell_moments(Listed_polygon<double>(polygon, column, n)).area;
      const double list_radius2 = polygon.squared_radius();
      const auto moments = cell_moments(Listed_polygon<double>(polygon, column, n), i,
                                        [&](int j) { return density_root[j]; });
      Chain_result<double> chain;
      if (clip_chain<true>(groups.view, lists, cell, frame, sizes[i], polygon, chain)) {
        ++chains;
        const auto& m = chain.moments;
        chain_error =
            std::max({chain_error, std::fabs(chain.radius2 / list_radius2 - 1),
                      std::fabs(m.area / moments.area - 1), std::fabs(m.mass / moments.mass - 1),
                      std::hypot(m.x - moments.x, m.y - moments.y) / spacing});
      } else {
        clip_entries(groups.view, lists, cell, frame, radius[i], sizes[i], polygon);
        reorder_list(lists, i, polygon);
        ++reordered;
        if (clip_chain<true>(groups.view, lists, cell, frame, sizes[i], polygon, chain))
          chain_error = std::max(chain_error, std::fabs(chain.moments.area / area - 1));
        else
          ++refused; // edges that are nearly parallel
      }
      if (!construct(i, 1.1 * spacing) && !construct(i, 1.4 * spacing)) continue;
      ++compared;
      const double exact =
          cell_moments(Listed_polygon<double>(polygon, memory->listed + 3, 32)).area;
      error = std::max(error, std::fabs(area / exact - 1));
    }
    CHECK(compared > 0.9 * proved);
    CHECK(error < 1e-12);
    CHECK(chains + reordered == proved); // those have other edges than before
    CHECK(reordered > 0);
    CHECK(refused <= 0.01 * proved);
    CHECK(chain_error < 1e-11);
    if (size < 0.1) CHECK(chains > 0.5 * proved);
    if (size < 0.1) CHECK(proved > 0.95 * kept);
    if (size == 1.0) CHECK(proved < kept);
  }
}
