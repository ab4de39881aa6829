// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Owns the arrays behind a `Sites_view` and constructs all cells (Algorithm 1) on the CPU.
#ifndef CGAL_POWER_RTF_ENGINES_SITE_TREE_H
#define CGAL_POWER_RTF_ENGINES_SITE_TREE_H

#include <CGAL/PowerRTF/cells/construct_cell.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace CGAL {
namespace PowerRTF {

/// Weighted samples with normals, in a packed tree. The samples should come in spatial order.
template <class ConcurrencyTag>
class Site_tree {
public:
  using View = Sites_view<double>;

  std::vector<Site<double>> sites; ///< call `refit()` after a change
  std::vector<Vec3d> normals;      ///< unit
  std::vector<int> patches;        ///< see `Sites_view`; empty: one patch
  std::vector<char> is_fixed;      ///< sites without a cell of their own; empty: none
  double guard_factor = 3;         ///< see `Sites_view`

  /// Sets the number of sites; `radius` is the first guess of the cells' radii.
  void resize(std::size_t n, double radius)
  {
    sites.resize(n);
    normals.resize(n);
    m_tree = Packed_tree_layout(static_cast<int>(n));
    m_boxes.resize(m_tree.nodes());
    m_max_weights.resize(m_tree.nodes());
    m_radii.assign(n, radius);
  }

  void refit()
  {
    for (int level = 0; level < m_tree.levels; ++level)
      internal::for_each_index<ConcurrencyTag>(m_tree.nodes(level), [&](int k) {
        refit_sites_node(m_tree, level, k, sites.data(), m_boxes.data(), m_max_weights.data());
      });
  }

  View view() const
  {
    return {sites.data(), normals.data(), m_boxes.data(), m_max_weights.data(), m_tree,
            guard_factor, patches.empty() ? nullptr : patches.data()};
  }

  /// Constructs the cells of all sites that are not fixed and calls `sink(i, status, polygon, frame)` for each, concurrently.
  /// `cos_angle` is the cosine of Theta. `Filtered`: see `construct_cell()`.
  template <bool Filtered = false, class Sink>
  void construct_cells(double cos_angle, Sink&& sink)
  {
    constexpr int leaves_per_chunk = 32, arity = Packed_tree_layout::arity;
    const View v = view();
    internal::for_each_chunk<ConcurrencyTag>(
        v.size(), leaves_per_chunk * arity, [&](int begin, int end) {
          std::vector<int> gathered;
          for (int leaf = begin; leaf < end; leaf += arity)
            construct_leaf<Filtered>(v, leaf, std::min(end, leaf + arity), cos_angle, gathered, sink);
        });
  }

private:
  /// Constructs the cells of the sites of one leaf from candidates gathered for all of them at once.
  template <bool Filtered, class Sink>
  void construct_leaf(const View& v, int begin, int end, double cos_angle,
                      std::vector<int>& gathered, Sink& sink)
  {
    // After a step the radii differ from the last ones by a few per cent.
    constexpr double growth = 1.1;
    double group_radius = 0, min_weight = std::numeric_limits<double>::infinity();
    const auto has_cell = [this](int i) { return is_fixed.empty() || !is_fixed[i]; };
    for (int i = begin; i < end; ++i) {
      if (!has_cell(i)) continue;
      group_radius = std::max(group_radius, growth * m_radii[i]);
      min_weight = std::min(min_weight, sites[i].weight);
    }
    if (min_weight == std::numeric_limits<double>::infinity()) return; // all fixed
    gathered.clear();
    for_each_possible_neighbor(v, m_boxes[begin / Packed_tree_layout::arity], min_weight,
                               group_radius, [&](int j) { gathered.push_back(j); });
    for (int i = begin; i < end; ++i) {
      if (!has_cell(i)) continue;
      const auto candidates = [&](double radius, auto&& f) {
        if (radius <= group_radius)
          for (int j : gathered) f(j);
        else
          for_each_possible_neighbor(v, Box3<double>{sites[i].point, sites[i].point},
                                     sites[i].weight, radius, f);
      };
      construct_cell<Filtered>(
          v, i, growth * m_radii[i], cos_angle, candidates,
          [&](int site, Cell_status status, const Tangent_polygon<double>& polygon,
              const Tangent_frame<double>& frame, auto... certain) {
            if (status == Cell_status::ok) m_radii[site] = std::sqrt(polygon.squared_radius());
            sink(site, status, polygon, frame, certain...);
          });
    }
  }

  Packed_tree_layout m_tree;
  std::vector<Box3<double>> m_boxes;
  std::vector<double> m_max_weights;
  std::vector<double> m_radii; ///< R of the last construction: the next one's guess
};

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_ENGINES_SITE_TREE_H
