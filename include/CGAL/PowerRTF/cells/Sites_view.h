// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The weighted samples as the construction of the cells sees them: plain arrays and a packed tree
// with the largest weight below each node, which makes every search end with a proof.
#ifndef CGAL_POWER_RTF_CELLS_SITES_VIEW_H
#define CGAL_POWER_RTF_CELLS_SITES_VIEW_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>

namespace CGAL::PowerRTF {

/// A sample s_i and its weight w_i, side by side for one load.
template <class FT>
struct Site {
  Vec3<FT> point;
  FT weight;
};

/// Whether two unit normals make less than Theta (`cos_angle`: its cosine; -2: any two do). Close
/// to the bound single precision decides as double precision does, where products of floats are
/// exact.
template <class FT>
CGAL_POWER_RTF_HD inline bool are_compatible(const Vec3<FT>& a, const Vec3<FT>& b, FT cos_angle)
{
  if (cos_angle < -1) return true;
  const FT above = dot(a, b) - cos_angle;
  if constexpr (sizeof(FT) < sizeof(double)) {
    if (std::fabs(above) < 4 * internal::epsilon<FT>())
      return dot(Vec3<double>{a.x, a.y, a.z}, Vec3<double>{b.x, b.y, b.z}) > double(cos_angle);
  }
  return above > 0;
}

/// Non-owning view of n sites in spatial order.
template <class FT>
struct Sites_view {
  const Site<FT>* sites = nullptr;   ///< n
  const Vec3<FT>* normals = nullptr; ///< n, unit
  const Box3<FT>* boxes = nullptr;   ///< one per node of `tree`
  const FT* max_weights = nullptr;   ///< one per node of `tree`
  Packed_tree_layout tree;
  /// A cell whose farthest vertex lies beyond this many distances to the 6th neighbor is guarded.
  FT guard_factor = 3;
  const int* patches =
      nullptr; ///< n; sites of other patches do not exist for a cell. Null: one patch

  CGAL_POWER_RTF_HD int size() const { return tree.items; }
  CGAL_POWER_RTF_HD bool same_patch(int i, int j) const
  {
    return !patches || patches[i] == patches[j];
  }
};

/// Computes box and largest weight of node `k` of `level`; the levels are done in ascending order.
template <class FT>
CGAL_POWER_RTF_HD inline void refit_sites_node(const Packed_tree_layout& tree, int level, int k,
                                               const Site<FT>* sites, Box3<FT>* boxes,
                                               FT* max_weights)
{
  const int begin = tree.children_begin(k), end = tree.children_end(level, k);
  const int below = level > 0 ? tree.first[level - 1] : 0;
  Box3<FT> box =
      level > 0 ? boxes[below + begin] : Box3<FT>{sites[begin].point, sites[begin].point};
  FT weight = level > 0 ? max_weights[below + begin] : sites[begin].weight;
  for (int c = begin + 1; c < end; ++c) {
    if (level > 0)
      box.add(boxes[below + c]);
    else
      box.add(sites[c].point);
    const FT w = level > 0 ? max_weights[below + c] : sites[c].weight;
    if (w > weight) weight = w;
  }
  boxes[tree.first[level] + k] = box;
  max_weights[tree.first[level] + k] = weight;
}

/// Calls `f(j)` for every site that may cut a cell of radius at most `radius` whose site lies in
/// `box` and weighs at least `min_weight`, and for every site within twice that radius.
///
/// The plane of a site at distance d with weight w is (d^2 + w_i - w) / (2 d) away from s_i. It
/// reaches a ball of radius R only if d^2 - 2 d R <= w - w_i, that is d <= R + sqrt(R^2 + w - w_i).
/// A node is skipped when its nearest point and its largest weight rule that out, so every site
/// not reported is proved not to cut.
template <class FT, class F>
CGAL_POWER_RTF_HD inline void for_each_possible_neighbor(const Sites_view<FT>& view,
                                                         const Box3<FT>& box, FT min_weight,
                                                         FT radius, F&& f)
{
  const FT margin = 1 + 16 * internal::epsilon<FT>();
  traverse(
      view.tree,
      [&](int node) {
        const FT more = internal::larger(view.max_weights[node] - min_weight, FT(0));
        const FT reach = (radius + std::sqrt(radius * radius + more)) * margin;
        return squared_distance(view.boxes[node], box) <= reach * reach;
      },
      [&](int begin, int end) {
        for (int j = begin; j < end; ++j) f(j);
      });
}

/// Distance from site `i` to its k-th nearest other site of its patch (to the farthest one when
/// there are fewer than k, 0 when there is none); k <= 8. Only sites whose normals make less than
/// Theta with n_i count (`cos_angle`: its cosine; -2: all count).
template <class FT>
CGAL_POWER_RTF_HD inline FT distance_to_neighbor(const Sites_view<FT>& view, int i, int k,
                                                 FT cos_angle = FT(-2))
{
  FT nearest[8]; // ascending squared distances
  int found = 0;
  const Vec3<FT> p = view.sites[i].point;
  const auto insert = [&](int begin, int end) {
    for (int j = begin; j < end; ++j) {
      if (j == i) continue;
      const FT d = squared_length(view.sites[j].point - p);
      if (found == k && !(d < nearest[k - 1])) continue;
      if (!view.same_patch(i, j)) continue;
      if (!are_compatible(view.normals[j], view.normals[i], cos_angle)) continue;
      int place = found < k ? found++ : k - 1;
      for (; place > 0 && nearest[place - 1] > d; --place) nearest[place] = nearest[place - 1];
      nearest[place] = d;
    }
  };
  // The own leaf first: it gives a bound that prunes nearly all the rest.
  const int own = i / Packed_tree_layout::arity;
  insert(view.tree.children_begin(own), view.tree.children_end(0, own));
  traverse(
      view.tree,
      [&](int node) { return found < k || squared_distance(view.boxes[node], p) < nearest[k - 1]; },
      [&](int begin, int end) {
        if (begin != view.tree.children_begin(own)) insert(begin, end);
      });
  return found > 0 ? std::sqrt(nearest[found - 1]) : FT(0);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_SITES_VIEW_H
