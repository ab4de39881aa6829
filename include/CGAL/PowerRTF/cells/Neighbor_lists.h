// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Verlet (neighbor) lists on the CPU: the sites near each cell's, kept while sites and weights
// change. A list remains complete for cells up to a radius R that falls with the changes; it is
// computed anew for every construction and cell, so that every cell is still proved.
//
// Proof. When list i was made, with weights w0, every site j that is not in it was at a distance
// d >= 2 L, and so was its plane at one p >= L,
//   d^2 + w0_i - w0_j = 2 d p >= 2 d L.
// Since then i and j have moved by no more than e in all, and w_j - w_i has grown by no more than
// g. The plane passes outside of a cell of radius R if (d - e)^2 - 2 (d - e) R >= w_j - w_i. By
// growth: that holds if  2 d (L - R - e) + 2 e R + e^2 >= g; where R <= L - e, d may be set 2 L. By
// the weights themselves: it holds if  (2 L - e)^2 - 2 (2 L - e) R >= w  for some w >= 0 that is no
// less than w_j - w_i. One of the two suffices. The bounds e, g and w are those of the leaves near
// that of i; for the sites of all others they are those of all sites, with a larger L.
#ifndef CGAL_POWER_RTF_CELLS_NEIGHBOR_LISTS_H
#define CGAL_POWER_RTF_CELLS_NEIGHBOR_LISTS_H

#include <CGAL/PowerRTF/cells/Edge_chain.h>
#include <CGAL/PowerRTF/cells/Sites_view.h>
#include <CGAL/PowerRTF/cells/Tangent_polygon.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// The sites are in the order of the tree, and keep it. \tparam Backend a `Host_backend`
template <class Real, class Backend>
class Neighbor_lists {
  static constexpr int arity = Packed_tree_layout::arity;

public:
  static constexpr int capacity = 40, max_near_leaves = 96;
  /// L, in radii of the cells: of the lists, and of the leaves that count as near.
  static constexpr Real list_radius = Real(1.4), near_radius = Real(1.8);

  /// Bounds of what sites have done since the lists were made.
  struct Changes {
    Real motion = 0, growth = 0; ///< of the weights, at least 0
    Real weight = 0;             ///< the largest now

    void add(const Changes& other)
    {
      motion = (std::max)(motion, other.motion);
      growth = (std::max)(growth, other.growth);
      weight = (std::max)(weight, other.weight);
    }
  };

  /// Before each construction of the cells [0, `cells`). `radii`: of the cells, as expected.
  void update(Backend& backend, const Sites_view<Real>& view, int cells,
              const std::vector<Real>& radii)
  {
    if (int(m_lists.size()) != cells || int(m_then.size()) != view.size())
      clear(backend, view, cells); // the radii are guessed
    else if (m_is_out_of_date)
      make(backend, view, radii);
    track(backend, view);
  }

  /// Near a leaf with cells.
  Changes near_changes(int leaf) const
  {
    const Near_leaves& near = m_near[leaf];
    Changes changes = m_leaf_changes[leaf];
    for (int k = 0; k < near.size; ++k) changes.add(m_leaf_changes[near.leaves[k]]);
    return changes;
  }

  /// Cells of `i` of up to this radius are cut by sites of its list alone; -1: not known. `near`:
  /// of its leaf.
  Real radius(const Sites_view<Real>& view, int i, const Changes& near) const
  {
    const List& list = m_lists[i];
    if (list.size == 0) return -1;
    const Site<Real>&site = view.sites[i], &then = m_then[i];
    const Real motion = length(site.point - then.point), growth = site.weight - then.weight;
    const auto complete_radius = [&](Real l, const Changes& others) {
      const Real e = motion + others.motion, d = 2 * l - e;
      if (!(d > 0)) return Real(-1);
      const Real g = others.growth - growth, w = others.weight - site.weight;
      const Real by_growth = (std::min)(l - e, (4 * l * (l - e) + e * e - g) / (2 * d));
      return (std::max)(by_growth, (d * d - (std::max)(w, Real(0))) / (2 * d));
    };
    return (std::min)(complete_radius(list.radius, near),
                      complete_radius(m_near[i / arity].radius, m_changes)) -
           list.radius * (4096 * internal::epsilon<Real>());
  }

  template <class F>
  void for_each(int i, F&& f) const
  {
    for (int k = 0; k < m_lists[i].size; ++k) f(m_lists[i].sites[k]);
  }

  /// The sites of the list without those of the edges.
  template <class F>
  void for_each_but_edges(int i, F&& f) const
  {
    for (int k = m_lists[i].edges; k < m_lists[i].size; ++k) f(m_lists[i].sites[k]);
  }

  /// Whether `j` is the site of an edge of `i`.
  bool has_edge(int i, int j) const
  {
    const int* const end = m_lists[i].sites + m_lists[i].edges;
    return std::find(m_lists[i].sites, end, j) != end;
  }

  /// A polygon that the edges of a cell make, which others may cut.
  struct Edge_polygon {
    Tangent_polygon<Real> polygon;
    Real squared_radius;  ///< of its farthest vertex
    Real squared_nearest; ///< squared distance of the nearest of the edges' sites
  };

  /// The polygon of the edges that `i` had when it was last given to `set_edges()`; `false` if they
  /// make none.
  bool chain_edges(const Sites_view<Real>& view, int i, Real cos_angle,
                   const Tangent_frame<Real>& frame, Edge_polygon& result) const;

  /// Whether the polygon of `chain_edges()` is proved to be the cell, as `construct_cell()` would
  /// make it with the status `ok`. `for_each_other(f)`: calls `f(j)` for all other sites that may
  /// cut a cell of `max_radius` or are within twice that, and maybe for more.
  template <class For_each_other>
  bool is_cell(const Sites_view<Real>& view, int i, Real max_radius, Real cos_angle,
               const Tangent_frame<Real>& frame, const Edge_polygon& edges,
               For_each_other&& for_each_other) const;

  /// A cell that was constructed otherwise.
  void set_edges(int i, const Tangent_polygon<Real>& polygon)
  {
    List& list = m_lists[i];
    list.edges = 0;
    if (list.size == 0 && polygon.size <= capacity) {
      std::copy(polygon.neighbor, polygon.neighbor + polygon.size, list.sites);
      list.edges = polygon.size;
      return;
    }
    int edges = 0;
    for (int k = 0; k < polygon.size; ++k) {
      int* const end = list.sites + list.size;
      int* const found = std::find(list.sites + edges, end, polygon.neighbor[k]);
      if (found == end) return;
      std::swap(list.sites[edges++], *found);
    }
    list.edges = edges;
  }

  /// Of the cells of a leaf, those that were constructed without a list that there is.
  void set_misses(int leaf, int misses) { m_misses[leaf] = misses; }

  /// Of all leaves, after the last construction.
  long misses() const { return m_all_misses; }

  /// After each construction: are lists worth making again?
  void finish(Backend& backend)
  {
    backend.template reduce<1, 0>(
        int(m_misses.size()), [&](int k, auto& totals) { totals.add(0, m_misses[k]); },
        [&](const auto& totals) { m_all_misses = long(totals.sum(0)); });
    if (m_is_new) m_unavoidable_misses = m_all_misses;
    m_is_new = false;
    m_is_out_of_date = m_all_misses - m_unavoidable_misses > long(m_lists.size()) / max_misses;
  }

private:
  static constexpr long max_misses = 8; // one of so many: lists cost as much as some searches

  struct List {
    int sites[capacity]; // those of the edges first, in their order
    int size;            // 0: there is no list
    int edges;           // 0: they are not known
    Real radius;         // L
  };
  struct Near_leaves {
    int leaves[max_near_leaves];
    int size;    // 0: too many
    Real radius; // L of the sites of all others
  };

  /// The line of site `j` in the tangent plane of `i`.
  struct Site_line {
    Real squared_distance; ///< of the sites
    Edge_line<Real> line;

    Site_line(const Sites_view<Real>& view, int i, int j, const Tangent_frame<Real>& frame)
    {
      const Site<Real>&site = view.sites[i], &other = view.sites[j];
      const Vec3<Real> offset = other.point - site.point;
      squared_distance = squared_length(offset);
      const auto [a, b] = frame.components(offset, squared_distance);
      line = {a, b, (squared_distance + (site.weight - other.weight)) / 2};
    }
  };

  void clear(Backend& backend, const Sites_view<Real>& view, int cells)
  {
    m_lists.resize(cells);
    m_near.resize((cells + arity - 1) / arity);
    m_misses.resize(m_near.size());
    m_then.resize(view.size());
    m_leaf_changes.resize(view.tree.nodes(0));
    backend.for_each(cells, [&](int i) { m_lists[i].size = m_lists[i].edges = 0; });
    backend.for_each(int(m_near.size()), [&](int leaf) { m_near[leaf].size = m_misses[leaf] = 0; });
    backend.for_each(view.size(), [&](int i) { m_then[i] = view.sites[i]; });
  }

  void make(Backend& backend, const Sites_view<Real>& view, const std::vector<Real>& radii)
  {
    m_is_out_of_date = false;
    m_is_new = true;
    backend.for_each(view.size(), [&](int i) { m_then[i] = view.sites[i]; });
    backend.for_each_chunk(int(m_near.size()), 32, [&](int begin, int end) {
      std::vector<int> gathered;
      std::vector<std::pair<Real, int>> near;
      for (int leaf = begin; leaf < end; ++leaf) make_lists(view, leaf, radii, gathered, near);
    });
  }

  void make_lists(const Sites_view<Real>& view, int leaf, const std::vector<Real>& radii,
                  std::vector<int>& gathered, std::vector<std::pair<Real, int>>& near)
  {
    const int begin = leaf * arity, end = (std::min)(begin + arity, int(m_lists.size()));
    Real radius = 0, min_weight = std::numeric_limits<Real>::infinity();
    for (int i = begin; i < end; ++i) {
      radius = (std::max)(radius, radii[i]);
      min_weight = (std::min)(min_weight, view.sites[i].weight);
    }
    // Of a node, the largest weight w: plane and site may be nearer than L and 2 L only within
    // this.
    const auto is_within = [&](int node, Real l) {
      const Real more = (std::max)(view.max_weights[node] - min_weight, Real(0));
      const Real distance = l + std::sqrt(l * l + more);
      return squared_distance(view.boxes[node], view.boxes[leaf]) <= distance * distance;
    };
    Near_leaves& leaves = m_near[leaf];
    leaves.radius = near_radius * radius;
    leaves.size = 0;
    gathered.clear();
    bool are_too_many = false;
    traverse(
        view.tree, [&](int node) { return !are_too_many && is_within(node, leaves.radius); },
        [&](int first, int last) {
          are_too_many = are_too_many || leaves.size == max_near_leaves;
          if (are_too_many) return;
          leaves.leaves[leaves.size++] = first / arity;
          if (!is_within(first / arity, list_radius * radius)) return;
          for (int j = first; j < last; ++j) gathered.push_back(j);
        });
    for (int i = begin; i < end; ++i) {
      if (are_too_many)
        m_lists[i].size = 0;
      else
        make_list(view, i, list_radius * radii[i], gathered, near);
    }
  }

  void make_list(const Sites_view<Real>& view, int i, Real radius, const std::vector<int>& gathered,
                 std::vector<std::pair<Real, int>>& near)
  {
    near.clear();
    const Site<Real>& site = view.sites[i];
    for (const int j : gathered) {
      if (j == i) continue;
      const Real d2 = squared_length(view.sites[j].point - site.point);
      const Real power = d2 + (std::min)(site.weight - view.sites[j].weight, Real(0));
      if (!(power > 0 && power * power >= 4 * d2 * radius * radius))
        near.emplace_back(power > 0 ? power / (2 * std::sqrt(d2)) : Real(0), j);
    }
    List& list = m_lists[i];
    list.radius = radius;
    if (near.size() > capacity) {
      std::nth_element(near.begin(), near.begin() + capacity, near.end());
      list.radius = near[capacity].first;
      near.resize(capacity);
    }
    Tangent_polygon<Real> former;
    former.size = list.edges;
    std::copy(list.sites, list.sites + list.edges, former.neighbor);
    list.size = int(near.size());
    for (int k = 0; k < list.size; ++k) list.sites[k] = near[k].second;
    set_edges(i, former);
  }

  void track(Backend& backend, const Sites_view<Real>& view)
  {
    backend.for_each(view.tree.nodes(0), [&](int leaf) {
      const int begin = view.tree.children_begin(leaf), end = view.tree.children_end(0, leaf);
      Changes& changes = m_leaf_changes[leaf];
      changes = {0, 0, view.max_weights[leaf]};
      for (int j = begin; j < end; ++j) {
        changes.motion =
            (std::max)(changes.motion, squared_length(view.sites[j].point - m_then[j].point));
        changes.growth = (std::max)(changes.growth, view.sites[j].weight - m_then[j].weight);
      }
      changes.motion = std::sqrt(changes.motion);
    });
    backend.template reduce<0, 3>(
        int(m_leaf_changes.size()),
        [&](int k, auto& totals) {
          totals.raise(0, double(m_leaf_changes[k].motion));
          totals.raise(1, double(m_leaf_changes[k].growth));
          totals.raise(2, double(m_leaf_changes[k].weight));
        },
        [&](const auto& totals) {
          m_changes = {Real(totals.maximum(0)), Real(totals.maximum(1)), Real(totals.maximum(2))};
        });
  }

  bool m_is_out_of_date = false, m_is_new = false;
  long m_all_misses = 0, m_unavoidable_misses = 0;
  internal::Unset_vector<List> m_lists;       // of each cell
  internal::Unset_vector<Near_leaves> m_near; // of each leaf with cells
  internal::Unset_vector<int> m_misses;       // the same
  internal::Unset_vector<Site<Real>> m_then;  // all, when the lists were made
  internal::Unset_vector<Changes> m_leaf_changes;
  Changes m_changes; // of all
};

template <class Real, class Backend>
bool Neighbor_lists<Real, Backend>::chain_edges(const Sites_view<Real>& view, int i, Real cos_angle,
                                                const Tangent_frame<Real>& frame,
                                                Edge_polygon& result) const
{
  const List& list = m_lists[i];
  if (list.edges < 3) return false;
  Edge_chain<Tangent_polygon<Real>, false> chain(result.polygon, 1);
  result.squared_nearest = std::numeric_limits<Real>::infinity();
  for (int k = 0; k < list.edges; ++k) {
    const int j = list.sites[k];
    if (!view.same_patch(i, j) || !are_compatible(view.normals[i], view.normals[j], cos_angle))
      return false;
    const Site_line line(view, i, j, frame);
    result.squared_nearest = (std::min)(result.squared_nearest, line.squared_distance);
    result.polygon.neighbor[k] = j;
    chain.add(k, line.line, 1);
  }
  if (!chain.close(list.edges)) return false;
  result.squared_radius = chain.result().radius2;
  return true;
}

template <class Real, class Backend>
template <class For_each_other>
bool Neighbor_lists<Real, Backend>::is_cell(const Sites_view<Real>& view, int i, Real max_radius,
                                            Real cos_angle, const Tangent_frame<Real>& frame,
                                            const Edge_polygon& edges,
                                            For_each_other&& for_each_other) const
{
  const Real radius2 = edges.squared_radius;
  if (!(max_radius > 0 && radius2 <= max_radius * max_radius)) return false;
  Real squared_nearest = (std::min)(edges.squared_nearest, 4 * max_radius * max_radius);
  bool is_cut = false;
  for_each_other([&](int j) {
    if (is_cut || j == i || !view.same_patch(i, j)) return;
    const Site_line site(view, i, j, frame);
    squared_nearest = (std::min)(squared_nearest, site.squared_distance);
    const Edge_line<Real>& l = site.line;
    const Real t2 = l.a * l.a + l.b * l.b;
    if ((l.c > 0 && l.c * l.c > radius2 * t2) || has_edge(i, j)) return;
    is_cut = are_compatible(view.normals[i], view.normals[j], cos_angle) &&
             (!(t2 > 0) || !edges.polygon.is_chain_inside(l.a, l.b, l.c));
  });
  return !is_cut && radius2 <= view.guard_factor * view.guard_factor * squared_nearest;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_NEIGHBOR_LISTS_H
