// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the device's cells are compared with: the shared construction in double precision on the
// host, of exactly the sites that the device has.
#ifndef CGAL_POWER_RTF_CUDA_HOST_CELLS_H
#define CGAL_POWER_RTF_CUDA_HOST_CELLS_H

#include "torus_sites.h"

#include <CGAL/PowerRTF/cells/cell_moments.h>
#include <CGAL/PowerRTF/cells/construct_cell.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <thread>
#include <vector>

namespace CGAL::PowerRTF::device {

/// A cell as both sides give it.
struct Plain_cell {
  Cell_status status = Cell_status::incomplete;
  double area = 0, mass = 0;
  Vec3d offset{0, 0, 0};
  std::vector<int> cycle;      ///< neighbors
  std::vector<double> lengths; ///< of the edges
};

struct Host_cells {
  std::vector<Site<double>> sites;
  std::vector<Vec3d> normals;
  std::vector<double> density_root;
  std::vector<int> patches;
  std::vector<Box3<double>> boxes;
  std::vector<double> max_weights;
  double cos_angle, guard_factor;

  template <class Real>
  Host_cells(const Host_sites<Real>& from, std::vector<int> patch_of, double cosine, double guard)
      : patches(std::move(patch_of)), cos_angle(cosine), guard_factor(guard)
  {
    for (std::size_t i = 0; i < from.sites.size(); ++i) {
      const auto& s = from.sites[i];
      const auto& n = from.normals[i];
      sites.push_back({{s.point.x, s.point.y, s.point.z}, s.weight});
      normals.push_back(normalized(Vec3d{n.x, n.y, n.z}));
      density_root.push_back(from.density_root[i]);
    }
  }

  Sites_view<double> view()
  {
    const Packed_tree_layout tree(static_cast<int>(sites.size()));
    boxes.resize(tree.nodes());
    max_weights.resize(tree.nodes());
    for (int level = 0; level < tree.levels; ++level)
      for (int k = 0; k < tree.nodes(level); ++k)
        refit_sites_node(tree, level, k, sites.data(), boxes.data(), max_weights.data());
    return {sites.data(),
            normals.data(),
            boxes.data(),
            max_weights.data(),
            tree,
            guard_factor,
            patches.empty() ? nullptr : patches.data()};
  }

  std::vector<Plain_cell> construct()
  {
    const Sites_view<double> v = view();
    const int n = v.size();
    std::vector<Plain_cell> cells(n);
    const auto one = [&](int i) {
      const double guess = distance_to_neighbor(v, i, 6) + 1e-9;
      const Vec3d p = sites[i].point;
      construct_cell(
          v, i, guess, cos_angle,
          [&](double r, auto&& f) {
            for_each_possible_neighbor(v, Box3<double>{p, p}, sites[i].weight, r, f);
          },
          [&](int, Cell_status status, const Tangent_polygon<double>& polygon,
              const Tangent_frame<double>& frame) {
            Plain_cell& c = cells[i];
            c.status = status;
            const auto m = cell_moments(polygon, i, [&](int j) { return density_root[j]; });
            c.area = m.area;
            c.mass = m.mass;
            c.offset = frame.u * m.x + frame.v * m.y;
            for (int k = 0; k < polygon.size; ++k) {
              const int l = polygon.next(k);
              c.cycle.push_back(polygon.neighbor[k]);
              c.lengths.push_back(
                  std::hypot(polygon.x[l] - polygon.x[k], polygon.y[l] - polygon.y[k]));
            }
          });
    };
    const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    std::vector<std::thread> pool;
    for (int t = 0; t < threads; ++t)
      pool.emplace_back([&, t] {
        for (int i = t; i < n; i += threads) one(i);
      });
    for (std::thread& t : pool) t.join();
    return cells;
  }
};

/// See `compare_cells()`.
inline std::vector<int> twins(const std::vector<Site<double>>& sites)
{
  std::map<std::array<double, 3>, int> first;
  std::vector<int> twin;
  for (const Site<double>& s : sites)
    twin.push_back(first
                       .emplace(std::array<double, 3>{s.point.x, s.point.y, s.point.z},
                                static_cast<int>(twin.size()))
                       .first->second);
  return twin;
}

struct Cell_comparison {
  int cells = 0, ok = 0, other_status = 0, other_cycle = 0;
  double longest_edge = 0; ///< that only one side has, in units of sqrt(area)
  double area_p99 = 0, area_most = 0, centroid_p99 = 0, centroid_most = 0; ///< of `ok` cells
};

/// `twin`: a number that sites share when they are at the same point; either may stand for both.
inline Cell_comparison compare_cells(std::vector<Plain_cell> cells, std::vector<Plain_cell> exact,
                                     const std::vector<int>& twin)
{
  for (auto* side : {&cells, &exact})
    for (Plain_cell& cell : *side)
      for (int& j : cell.cycle)
        if (j >= 0) j = twin[j];
  Cell_comparison c;
  std::vector<double> area, centroid;
  double mean = 0;
  for (const Plain_cell& e : exact) mean += e.area / double(exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Plain_cell &a = cells[i], &b = exact[i];
    ++c.cells;
    c.ok += b.status == Cell_status::ok;
    c.other_status += a.status != b.status;
    if (a.status != b.status || b.status == Cell_status::empty || b.area < 1e-3 * mean) continue;
    const double scale = std::sqrt(b.area);
    std::vector<int> cycle = a.cycle;
    if (!cycle.empty())
      std::rotate(cycle.begin(), std::find(cycle.begin(), cycle.end(), b.cycle[0]), cycle.end());
    if (cycle != b.cycle) {
      ++c.other_cycle;
      const auto only = [&](const Plain_cell& p, const Plain_cell& q) {
        for (std::size_t k = 0; k < p.cycle.size(); ++k)
          if (std::find(q.cycle.begin(), q.cycle.end(), p.cycle[k]) == q.cycle.end())
            c.longest_edge = std::max(c.longest_edge, p.lengths[k] / scale);
      };
      only(a, b);
      only(b, a);
    }
    if (b.status != Cell_status::ok) continue;
    area.push_back(std::fabs(a.area / b.area - 1));
    centroid.push_back(length(a.offset - b.offset) / scale);
  }
  const auto p99 = [](std::vector<double>& x, double& most) {
    std::sort(x.begin(), x.end());
    most = x.empty() ? 0 : x.back();
    return x.empty() ? 0 : x[x.size() * 99 / 100];
  };
  c.area_p99 = p99(area, c.area_most);
  c.centroid_p99 = p99(centroid, c.centroid_most);
  return c;
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_HOST_CELLS_H
