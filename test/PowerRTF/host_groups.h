// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The device's sites, tree and polygons on the host: groups of 32 sites one after another, the
// lanes of a group one after another; compared with the shared construction in double precision.
#ifndef POWER_RTF_TEST_HOST_GROUPS_H
#define POWER_RTF_TEST_HOST_GROUPS_H

#include <doctest/doctest.h>

#include "../../cuda/cells/Verlet_lists.h"
#include "../../cuda/test/listed_cells.h"
#include <CGAL/PowerRTF/cells/cell_moments.h>
#include <CGAL/PowerRTF/cells/construct_cell.h>
#include <CGAL/PowerRTF/geometry/hilbert_code.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace host_groups {

using namespace CGAL::PowerRTF;
using namespace CGAL::PowerRTF::device;

/// What the device has in its memory.
template <class Real>
struct Host_groups {
  std::vector<Packed_site<Real>> sites;
  std::vector<Packed_normal<Real>> normals;
  std::vector<Group_node<Real>> nodes;
  Group_view<Real> view;

  Host_groups(std::vector<Packed_site<Real>> s, std::vector<Packed_normal<Real>> n)
      : sites(std::move(s)), normals(std::move(n))
  {
    view.tree = Group_layout(static_cast<int>(sites.size()));
    nodes.resize(view.tree.nodes());
    for (int level = 0; level < view.tree.levels; ++level)
      for (int k = 0; k < view.tree.nodes(level); ++k) join_children(level, k);
    view.sites = sites.data();
    view.normals = normals.data();
    view.nodes = nodes.data();
    view.cells = view.tree.items;
  }

  void join_children(int level, int k)
  {
    Group_node<Real>& node = nodes[view.tree.first[level] + k];
    const int end = std::min((k + 1) * Group_layout::arity, view.tree.below(level));
    for (int c = k * Group_layout::arity; c < end; ++c) {
      Group_node<Real> child{sites[0].point, sites[0].weight, sites[0].point, 0};
      if (level == 0)
        child = {sites[c].point, sites[c].weight, sites[c].point, 0};
      else
        child = nodes[view.tree.first[level - 1] + c];
      if (c == k * Group_layout::arity) {
        node = child;
        continue;
      }
      node.lo = {std::min(node.lo.x, child.lo.x), std::min(node.lo.y, child.lo.y),
                 std::min(node.lo.z, child.lo.z)};
      node.hi = {std::max(node.hi.x, child.hi.x), std::max(node.hi.y, child.hi.y),
                 std::max(node.hi.z, child.hi.z)};
      node.max_weight = std::max(node.max_weight, child.max_weight);
    }
  }

  /// The places of the sites that a warp gathers.
  void gather(const Group_query<Real>& query, std::vector<int>& found) const
  {
    found.clear();
    std::vector<std::pair<int, int>> pending{{view.tree.levels - 1, 0}};
    while (!pending.empty()) {
      const auto [level, k] = pending.back();
      pending.pop_back();
      const int end = std::min((k + 1) * Group_layout::arity, view.tree.below(level));
      for (int c = k * Group_layout::arity; c < end; ++c) {
        if (level == 0) {
          if (query.reaches(sites[c].point, sites[c].point, sites[c].weight)) found.push_back(c);
        } else {
          const Group_node<Real>& box = nodes[view.tree.first[level - 1] + c];
          if (query.reaches(box.lo, box.hi, box.max_weight)) pending.push_back({level - 1, c});
        }
      }
    }
  }
};

struct Comparison {
  int finished = 0, cells = 0, wrong_cycles = 0;
  double area_error = 0, centroid_error = 0, candidates = 0;
  double area_p99 = 0, centroid_p99 = 0;
};

inline double percentile_99(std::vector<double> x)
{
  std::sort(x.begin(), x.end());
  return x.empty() ? 0 : x[x.size() * 99 / 100];
}

/// Constructs all cells both ways. The radii are first guesses of the groups' cells.
template <class Real>
inline Comparison
compare(const std::vector<Vec3d>& points, const std::vector<Vec3d>& surface_normals,
        const std::vector<double>& weights, const std::vector<int>& patches, double cos_angle)
{
  const int n = static_cast<int>(points.size());
  std::vector<int> order(n);
  for (int i = 0; i < n; ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return hilbert_code(points[a]) < hilbert_code(points[b]); });
  std::vector<Packed_site<Real>> packed(n);
  std::vector<Packed_normal<Real>> packed_normals(n);
  std::vector<Site<double>> sites(n);
  std::vector<Vec3d> normals(n);
  std::vector<int> sorted_patches(n);
  for (int place = 0; place < n; ++place) {
    const int i = order[place];
    const Vec3d p = points[i], m = surface_normals[i];
    packed[place] = {{Real(p.x), Real(p.y), Real(p.z)}, Real(weights[i])};
    packed_normals[place] = {{Real(m.x), Real(m.y), Real(m.z)}, patches[i]};
    const auto& q = packed[place];
    sites[place] = {{q.point.x, q.point.y, q.point.z}, q.weight};
    const auto& normal = packed_normals[place].normal;
    normals[place] = normalized(Vec3d{normal.x, normal.y, normal.z});
    sorted_patches[place] = patches[i];
  }
  Host_groups<Real> groups(packed, packed_normals);
  groups.view.cos_angle = Real(cos_angle);

  const Packed_tree_layout tree(n);
  std::vector<Box3<double>> boxes(tree.nodes());
  std::vector<double> max_weights(tree.nodes());
  for (int level = 0; level < tree.levels; ++level)
    for (int k = 0; k < tree.nodes(level); ++k)
      refit_sites_node(tree, level, k, sites.data(), boxes.data(), max_weights.data());
  Sites_view<double> shared{sites.data(),         normals.data(), boxes.data(),
                            max_weights.data(),   tree,           3,
                            sorted_patches.data()};

  Comparison result;
  std::vector<double> area_errors, centroid_errors;
  auto memory = std::make_unique<Warp_memory<Real>>();
  std::vector<int> found;
  for (int place = 0; place < n; ++place) {
    Cell_status status;
    std::vector<int> cycle;
    Cell_moments<double> moments;
    double radius = 0;
    const double guess = 0.7 * distance_to_neighbor(shared, place, 6) + 1e-3;
    construct_cell(
        shared, place, guess, cos_angle,
        [&](double r, auto&& f) {
          const Vec3d p = sites[place].point;
          for_each_possible_neighbor(shared, Box3<double>{p, p}, sites[place].weight, r, f);
        },
        [&](int, Cell_status s, const Tangent_polygon<double>& polygon, const auto&) {
          status = s;
          cycle.assign(polygon.neighbor, polygon.neighbor + polygon.size);
          moments = cell_moments(polygon);
          radius = std::sqrt(polygon.squared_radius());
        });
    ++result.cells;

    Lane_cell<Real> cell;
    cell.place = place;
    cell.site = packed[place];
    cell.radius = Real(status == Cell_status::ok ? 1.15 * radius : guess);
    Group_query<Real> query;
    query.lo = query.hi = cell.site.point;
    query.radius = cell.radius;
    query.min_weight = cell.site.weight;
    groups.gather(query, found);
    result.candidates += double(found.size()) / n;
    int gathered = 0;
    for (const int j : found) {
      if (gathered == Warp_memory<Real>::max_candidates) {
        list_candidates(cell, *memory, gathered, 3, place % 32);
        gathered = 0;
      }
      memory->candidates.sites[gathered] = packed[j];
      memory->candidates.places[gathered++] = j;
    }
    list_candidates(cell, *memory, gathered, 3, place % 32);
    Ring_polygon<Real, 32> polygon(memory->polygons, place % 32);
    const int* column = memory->listed + place % 32;
    const Tangent_frame<Real> frame(packed_normals[place].normal);
    bool hopeless;
    if (!clip_listed(groups.view, cell, packed_normals[place], frame, column, polygon, hopeless) ||
        cell.near > 6)
      continue;
    // Finished here: then it must be the cell.
    ++result.finished;
    REQUIRE(status == Cell_status::ok);
    const Listed_polygon<Real> listed(polygon, column, 32);
    std::vector<int> own;
    for (int k = 0; k < listed.size; ++k) own.push_back(listed.neighbor[k]);
    const auto first = std::find(own.begin(), own.end(), cycle[0]);
    std::rotate(own.begin(), first, own.end());
    result.wrong_cycles += own != cycle;
    const auto m = cell_moments(listed, place, [](int) { return Real(1); });
    area_errors.push_back(std::fabs(m.area / moments.area - 1));
    centroid_errors.push_back(std::hypot(m.x - moments.x, m.y - moments.y) /
                              std::sqrt(moments.area));
    result.area_error = std::max(result.area_error, area_errors.back());
    result.centroid_error = std::max(result.centroid_error, centroid_errors.back());
  }
  result.area_p99 = percentile_99(std::move(area_errors));
  result.centroid_p99 = percentile_99(std::move(centroid_errors));
  return result;
}

struct Input {
  std::vector<Vec3d> points, normals;
  std::vector<double> weights;
  std::vector<int> patches;
  void add(const Vec3d& p, const Vec3d& n, double w = 0, int patch = 0)
  {
    points.push_back(p);
    normals.push_back(normalized(n));
    weights.push_back(w);
    patches.push_back(patch);
  }
  template <class Real>
  Comparison compare(double cos_angle = 0) const
  {
    return host_groups::compare<Real>(points, normals, weights, patches, cos_angle);
  }
};

inline Input sphere(int n, double radius, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-0.25, 0.25);
  const double spacing = std::sqrt(4 * 3.14159265358979 / n);
  Input in;
  for (int k = 0; k < n; ++k) { // a Fibonacci spiral, disturbed
    const double z = 1 - (2 * k + 1 + jitter(random)) / n, r = std::sqrt(std::max(0.0, 1 - z * z));
    const double a = 2.399963229728653 * k + jitter(random) * spacing / std::max(r, spacing);
    const Vec3d p{r * std::cos(a), r * std::sin(a), z};
    in.add(p * radius, p);
  }
  return in;
}

} // namespace host_groups

#endif // POWER_RTF_TEST_HOST_GROUPS_H
