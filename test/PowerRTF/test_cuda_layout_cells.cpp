// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tuned cells of the GPU, their tree and their polygons in a ring, run on the host: groups of
// 32 sites one after another, the lanes of a group one after another. Compared with the shared
// construction in double precision. (The kernels themselves: cuda/test/test_cuda_cells.cu.)
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include "../../cuda/cells/Verlet_lists.h"
#include "../../cuda/test/listed_cells.h"
#include <CGAL/PowerRTF/geometry/hilbert_code.h>

#include <CGAL/PowerRTF/cells/cell_moments.h>
#include <CGAL/PowerRTF/cells/construct_cell.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

using namespace CGAL::PowerRTF;
using namespace CGAL::PowerRTF::device;

namespace {

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

double percentile_99(std::vector<double> x)
{
  std::sort(x.begin(), x.end());
  return x.empty() ? 0 : x[x.size() * 99 / 100];
}

/// Constructs all cells both ways. The radii are first guesses of the groups' cells.
template <class Real>
Comparison compare(const std::vector<Vec3d>& points, const std::vector<Vec3d>& surface_normals,
                   const std::vector<double>& weights, const std::vector<int>& patches,
                   double cos_angle)
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
    return ::compare<Real>(points, normals, weights, patches, cos_angle);
  }
};

Input sphere(int n, double radius, unsigned seed)
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

} // namespace

TEST_CASE("the tree's layout has a root, and every item under it")
{
  for (int n : {0, 1, 2, 31, 32, 33, 1024, 1025, 40000}) {
    const Group_layout tree(n);
    CHECK((tree.levels == 0) == (n == 0));
    if (n == 0) continue;
    CHECK(tree.nodes(tree.levels - 1) == 1);
    CHECK(tree.below(0) == n);
    for (int level = 0; level < tree.levels; ++level)
      CHECK(tree.nodes(level) * 32 >= tree.below(level));
  }
}

TEST_CASE("a ring polygon cuts like the shared polygon")
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  auto memory = std::make_unique<Ring_memory<double, 32>>();
  for (int trial = 0; trial < 2000; ++trial) {
    Ring_polygon<double, 32> ring(*memory, trial % 32);
    Tangent_polygon<double> shared;
    ring.set_square(1);
    shared.set_square(1);
    for (int k = 0; k < 30; ++k) {
      const double a = uniform(random), b = uniform(random), c = 0.3 + 0.3 * uniform(random);
      ring.clip(a, b, c, k);
      shared.clip(a, b, c, k);
      if (ring.overflow) break;
      REQUIRE(ring.size == shared.size);
      if (ring.size == 0) break;
      int first = 0;
      while (first < ring.size &&
             std::hypot(ring.x(first) - shared.x[0], ring.y(first) - shared.y[0]) > 1e-12)
        ++first;
      REQUIRE(first < ring.size);
      for (int v = 0; v < ring.size; ++v) {
        const int r = (first + v) % ring.size;
        CHECK(std::hypot(ring.x(r) - shared.x[v], ring.y(r) - shared.y[v]) < 1e-12);
        CHECK(ring.edge(r) ==
              (shared.neighbor[v] < 0 ? 251 - shared.neighbor[v] : shared.neighbor[v]));
      }
    }
  }
}

TEST_CASE_TEMPLATE("regular cells are finished and right", Real, float, double)
{
  Input in = sphere(4000, 0.45, 1);
  const double tolerance = sizeof(Real) == 4 ? 4e-6 : 1e-13;
  SUBCASE("no weights") {}
  SUBCASE("weights")
  {
    std::mt19937 random(5);
    for (double& w : in.weights) w = 1e-4 * (random() % 1000) / 1000.0;
  }
  SUBCASE("large smooth weights")
  {
    for (std::size_t i = 0; i < in.points.size(); ++i)
      in.weights[i] = 0.01 * std::sin(3 * in.points[i].x);
  }
  const Comparison c = in.compare<Real>();
  CHECK(c.finished >= 0.98 * c.cells);
  CHECK(c.wrong_cycles == 0);
  CHECK(c.area_error < tolerance);
  CHECK(c.centroid_error < tolerance);
  CHECK(c.candidates < 40); // the tree finds them without looking at everything
}

TEST_CASE("smooth weights much larger than the squared spacing cost no precision")
{
  Input in = sphere(4000, 0.45, 1);
  const double h2 = 4 * 3.14159265358979 * 0.45 * 0.45 / 4000;
  for (const double amplitude : {30.0, 140.0}) { // rms about 20 and 100
    for (std::size_t i = 0; i < in.points.size(); ++i)
      in.weights[i] = amplitude * h2 * std::sin(3 * in.points[i].x + 2 * in.points[i].y);
    const Comparison c = in.compare<float>();
    CHECK(c.finished >= 0.1 * c.cells); // many lie far from their sites, near the guard radius
    CHECK(c.wrong_cycles == 0);
    CHECK(c.area_p99 <= 5e-7);
    CHECK(c.centroid_p99 <= 5e-7);
  }
}

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

TEST_CASE("two sheets: sites of the other sheet or patch do not count")
{
  Input in = sphere(2000, 0.45, 2);
  const Input inner = sphere(2000, 0.44, 3);
  SUBCASE("by normals")
  {
    for (std::size_t i = 0; i < inner.points.size(); ++i)
      in.add(inner.points[i], -inner.normals[i]);
  }
  SUBCASE("by patches")
  {
    for (std::size_t i = 0; i < inner.points.size(); ++i)
      in.add(inner.points[i], inner.normals[i], 0, 1);
  }
  const Comparison c = in.compare<float>();
  CHECK(c.finished >= 0.9 * c.cells);
  CHECK(c.wrong_cycles == 0);
  CHECK(c.area_error < 1e-5);
}

TEST_CASE("nothing wrong is called finished")
{
  Input in;
  SUBCASE("one site") { in.add({0, 0, 0}, {0, 0, 1}); }
  SUBCASE("two sites")
  {
    in.add({0, 0, 0}, {0, 0, 1});
    in.add({0.1, 0, 0}, {0, 0, 1});
  }
  SUBCASE("three sites")
  {
    in.add({0, 0, 0}, {0, 0, 1});
    in.add({0.1, 0, 0}, {0, 0, 1});
    in.add({0, 0.1, 0}, {0, 0, 1});
  }
  SUBCASE("all at one point")
  {
    for (int k = 0; k < 100; ++k) in.add({0.1, 0.2, 0.3}, {0, 0, 1});
  }
  SUBCASE("a huge weight")
  {
    in = sphere(500, 0.45, 4);
    in.weights[17] = 1;
  }
  SUBCASE("cocircular: a grid")
  {
    for (int x = 0; x < 20; ++x)
      for (int y = 0; y < 20; ++y) in.add({x / 64.0, y / 64.0, 0}, {0, 0, 1});
    const Comparison c = in.compare<float>();
    CHECK(c.area_error < 1e-6); // neighbors at corners may or may not have an edge of length 0
    return;
  }
  SUBCASE("a wheel: 40 cocircular sites around one")
  {
    in.add({0, 0, 0}, {0, 0, 1});
    for (int k = 0; k < 40; ++k)
      in.add({0.1 * std::cos(k * 0.15707963), 0.1 * std::sin(k * 0.15707963), 0}, {0, 0, 1});
  }
  const Comparison c = in.compare<float>();
  CHECK(c.wrong_cycles == 0);
  CHECK(c.area_error < 1e-5);
}
