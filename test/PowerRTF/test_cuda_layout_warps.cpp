// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells that a warp of the GPU makes together, run on the host, against the shared construction
// in double precision: guarded and empty cells, duplicates, weights that change while the warp
// keeps its sites. (The kernels themselves: cuda/test/test_cuda_cells.cu.)
#include <doctest/doctest.h>

#include <CGAL/PowerRTF/geometry/hilbert_code.h>

#include <CGAL/PowerRTF/cells/construct_cell.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "warp_on_host.h"

#include "../../cuda/cells/Warp_cell.cuh"
#include "../../cuda/test/kept_weights.h"

using namespace CGAL::PowerRTF;
using namespace CGAL::PowerRTF::device;

namespace {

struct Case {
  double tube = 0.15; ///< of the torus; thin: its two sides see each other
  double cos_angle = -0.766, guard_factor = 3;
  double weights = 0; ///< random, in units of the squared spacing
  bool has_duplicates = false, has_patches = false;
};

/// Sites on a torus along a Hilbert curve, and what the device keeps of them.
class Sites {
public:
  Sites(const Case& c, int n) : m_case(c)
  {
    constexpr double pi = 3.14159265358979, ring = 0.3;
    h2 = 4 * pi * pi * ring * c.tube / n;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Vec3d> points, directions;
    for (int i = 0; i < n; ++i) {
      const double a = 2 * pi * uniform(random), b = 2 * pi * uniform(random);
      directions.push_back({std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)});
      points.push_back(Vec3d{ring * std::cos(a), ring * std::sin(a), 0} + directions[i] * c.tube);
    }
    if (c.has_duplicates)
      for (int i = 40; i < n; i += 40) points[i] = points[i - 33];
    std::vector<int> order(n);
    for (int i = 0; i < n; ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return hilbert_code(points[a]) < hilbert_code(points[b]);
    });
    for (const int i : order) {
      const Vec3d p = points[i], d = directions[i];
      const double w = c.weights * h2 * (uniform(random) - 0.5);
      const int patch = c.has_patches && p.x > 0;
      sites.push_back({{float(p.x), float(p.y), float(p.z)}, float(w)});
      m_normals.push_back({{float(d.x), float(d.y), float(d.z)}, patch});
      m_patches.push_back(patch);
      m_caller.push_back(static_cast<int>(m_caller.size()));
    }
    make_tree();
    for (const auto& s : sites) m_list_weights.push_back(s.weight);
    m_growth.assign(view.tree.nodes(0), 0);
  }

  /// The tree for the current weights.
  void make_tree()
  {
    constexpr float infinity = 1e30f;
    view.tree = Group_layout(static_cast<int>(sites.size()));
    m_nodes.resize(view.tree.nodes());
    for (int level = 0; level < view.tree.levels; ++level)
      for (int k = 0; k < view.tree.nodes(level); ++k) {
        Group_node<float> node{
            {infinity, infinity, infinity}, -infinity, {-infinity, -infinity, -infinity}, 0};
        const int end = std::min((k + 1) * Group_layout::arity, view.tree.below(level));
        for (int c = k * Group_layout::arity; c < end; ++c) {
          Group_node<float> q{sites[c].point, sites[c].weight, sites[c].point, 0};
          if (level > 0) q = m_nodes[view.tree.first[level - 1] + c];
          node.lo = {fmin(node.lo.x, q.lo.x), fmin(node.lo.y, q.lo.y), fmin(node.lo.z, q.lo.z)};
          node.hi = {fmax(node.hi.x, q.hi.x), fmax(node.hi.y, q.hi.y), fmax(node.hi.z, q.hi.z)};
          node.max_weight = fmax(node.max_weight, q.max_weight);
        }
        m_nodes[view.tree.first[level] + k] = node;
      }
    view.sites = sites.data();
    view.normals = m_normals.data();
    view.caller = m_caller.data();
    view.nodes = m_nodes.data();
    view.cells = view.tree.items;
    view.cos_angle = float(m_case.cos_angle);
    view.guard_factor = float(m_case.guard_factor);
  }

  /// Weights that the tree and the lists do not know.
  void change_weights(double by)
  {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (std::size_t k = 0; k < sites.size(); ++k) {
      sites[k].weight += float(by * h2 * uniform(random));
      m_growth[k / 32] = std::max(m_growth[k / 32], sites[k].weight - m_list_weights[k]);
      m_all_growth = std::max(m_all_growth, m_growth[k / 32]);
    }
  }

  Verlet_lists<float> lists()
  {
    Verlet_lists<float> l;
    l.weights = m_list_weights.data();
    l.growth = m_growth.data();
    l.all_growth = &m_all_growth;
    return l;
  }

  /// For the shared construction.
  Sites_view<double> exact()
  {
    m_exact.clear();
    m_exact_normals.clear();
    for (std::size_t k = 0; k < sites.size(); ++k) {
      const auto &p = sites[k].point, &d = m_normals[k].normal;
      m_exact.push_back({{p.x, p.y, p.z}, sites[k].weight});
      m_exact_normals.push_back(normalized(Vec3d{d.x, d.y, d.z}));
    }
    const Packed_tree_layout tree(static_cast<int>(sites.size()));
    m_boxes.resize(tree.nodes());
    m_weights.resize(tree.nodes());
    for (int level = 0; level < tree.levels; ++level)
      for (int k = 0; k < tree.nodes(level); ++k)
        refit_sites_node(tree, level, k, m_exact.data(), m_boxes.data(), m_weights.data());
    return {m_exact.data(), m_exact_normals.data(), m_boxes.data(),  m_weights.data(),
            tree,           m_case.guard_factor,    m_patches.data()};
  }

  std::vector<Packed_site<float>> sites;
  Group_view<float> view;
  double h2; ///< squared spacing

private:
  Case m_case;
  std::vector<Packed_normal<float>> m_normals;
  std::vector<int> m_caller, m_patches;
  std::vector<Group_node<float>> m_nodes;
  std::vector<float> m_list_weights, m_growth;
  float m_all_growth = 0;
  std::vector<Site<double>> m_exact;
  std::vector<Vec3d> m_exact_normals;
  std::vector<Box3<double>> m_boxes;
  std::vector<double> m_weights;
};

struct Made {
  Cell_status status = Cell_status::incomplete;
  double area = 0;
};

Made exact_cell(const Sites_view<double>& view, int i, double cos_angle)
{
  Made made;
  const Site<double>& s = view.sites[i];
  construct_cell(
      view, i, distance_to_neighbor(view, i, 6) + 1e-9, cos_angle,
      [&](double r, auto&& f) {
        for_each_possible_neighbor(view, Box3<double>{s.point, s.point}, s.weight, r, f);
      },
      [&](int, Cell_status status, const Tangent_polygon<double>& p, const Tangent_frame<double>&) {
        made.status = status;
        for (int k = 0; k < p.size; ++k) {
          const int l = p.next(k);
          made.area += (p.x[k] * p.y[l] - p.x[l] * p.y[k]) / 2;
        }
      });
  return made;
}

/// What a warp knows of a cell from the last time.
struct Last {
  float radius, guard = 0;
};

template <class Make_weights>
Made warp_cell(const Sites& sites, int i, Last& last, Kept_sites<float>* keep,
               Make_weights&& weights)
{
  static Warp_cell_memory<float> memory;
  Made made;
  Kept_sites<float> after;
  const Last before = last;
  Host_warp::run([&](int lane) {
    Warp_cell<float> cell(sites.view, memory, i, lane);
    Kept_sites<float> kept = keep ? *keep : Kept_sites<float>();
    float guard = before.guard;
    const float guess = before.radius > 0 ? 2 * before.radius : -before.radius / 3;
    Cell_status status = Cell_status::incomplete;
    bool is_made = false;
    float radius_before = before.radius;
    if constexpr (decltype(weights())::keeps)
      if (kept.place == i) {
        is_made = cell.renew(weights(), kept, guard, status);
        radius_before = cell.radius_to_begin(kept, status, guard);
      }
    if (!is_made) status = cell.construct(weights(), radius_before, guard, guess, kept);
    const double area = cell.polygon().area(lane);
    const float radius = status == Cell_status::ok ? cell.radius() : -guard;
    if (lane != 0) return;
    made = {status, area};
    last = {radius, guard};
    after = kept;
  });
  if (keep) *keep = after;
  return made;
}

} // namespace

TEST_CASE("a warp's cells are the shared ones")
{
  Case c;
  SUBCASE("usual") {}
  SUBCASE("normals that differ")
  {
    c.cos_angle = 0.9;
    c.guard_factor = 1.5;
  }
  SUBCASE("a thin torus")
  {
    c.tube = 0.02;
    c.cos_angle = 0.5;
    c.guard_factor = 1.5;
  }
  SUBCASE("large weights")
  {
    c.weights = 6;
    c.guard_factor = 1.5;
  }
  SUBCASE("duplicates") { c.has_duplicates = true; }
  SUBCASE("patches") { c.has_patches = true; }

  Sites sites(c, 1200);
  const Last unknown{float(std::sqrt(sites.h2))};
  constexpr int step = 41;
  std::vector<Last> last(sites.sites.size(), unknown);
  for (const double change : {0.0, 0.3, 0.0}) { // after the first time with what is known
    const Verlet_lists<float> lists = sites.lists();
    Sites current = sites; // whose tree knows the weights
    current.make_tree();
    const Sites_view<double> exact_sites = current.exact();
    for (std::size_t first = 0; first < sites.sites.size(); first += step) {
      const int i = static_cast<int>(first);
      CAPTURE(i);
      const auto check = [&](const Made& made, const Made& exact) {
        CHECK(made.status == exact.status);
        CHECK(std::fabs(made.area - exact.area) < 2e-5 * sites.h2);
      };
      const Made exact = exact_cell(exact_sites, i, c.cos_angle);
      check(warp_cell(current, i, last[i], nullptr,
                      [&] { return Current_weights<float>(current.sites[i].weight); }),
            exact);
      // From sites that the warp keeps: gathered for old weights, read again for the current ones.
      Kept_sites<float> kept;
      Last own = last[i];
      for (int k = 0; k < 2; ++k)
        check(warp_cell(sites, i, own, &kept,
                        [&] { return Kept_weights<float>(lists, sites.sites.data(), i); }),
              exact);
    }
    sites.change_weights(change);
  }
}
