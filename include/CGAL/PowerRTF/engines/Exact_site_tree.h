// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells of the engines that ask for exact combinatorics: all of them by the oracle, or only
// those that the fast path's filter cannot prove.
#ifndef CGAL_POWER_RTF_ENGINES_EXACT_SITE_TREE_H
#define CGAL_POWER_RTF_ENGINES_EXACT_SITE_TREE_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/engines/Site_tree.h>
#include <CGAL/PowerRTF/exact/construct_exact_cell.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <utility>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

/// The oracle over the samples of a view.
template <class Kernel>
Exact_cells<Kernel> exact_cells(const Sites_view<double>& view, double cos_angle,
                                Exact_neighbours source)
{
  std::vector<Vec3d> points, normals(view.normals, view.normals + view.size());
  std::vector<double> weights;
  points.reserve(view.size());
  weights.reserve(view.size());
  for (int i = 0; i < view.size(); ++i) {
    points.push_back(view.sites[i].point);
    weights.push_back(view.sites[i].weight);
  }
  std::vector<int> patches;
  if (view.patches) patches.assign(view.patches, view.patches + view.size());
  return {std::move(points), std::move(normals), std::move(weights), cos_angle, source,
          std::move(patches)};
}

} // namespace internal

/// All cells by the oracle.
template <class Kernel, class ConcurrencyTag>
class Exact_site_tree : public Site_tree<ConcurrencyTag>
{
public:
  explicit Exact_site_tree(const Remeshing_options&) {}

  /// As `Site_tree::construct_cells()`.
  template <class Sink>
  void construct_cells(double cos_angle, Sink&& sink)
  {
    const auto view = this->view();
    const auto cells =
        internal::exact_cells<Kernel>(view, cos_angle, Exact_neighbours::automatic);
    internal::for_each_index<ConcurrencyTag>(
        view.size(), [&](int i) {
          if (this->is_fixed.empty() || !this->is_fixed[i])
            construct_exact_cell(cells, view, i, sink);
        });
  }
};

/// All cells by the fast path; with `certified_combinatorics`, those whose neighbours it cannot
/// prove by the oracle.
template <class ConcurrencyTag>
class Filtered_site_tree : public Site_tree<ConcurrencyTag>
{
  using Base = Site_tree<ConcurrencyTag>;
  bool m_certified;

public:
  explicit Filtered_site_tree(const Remeshing_options& options)
      : m_certified(options.certified_combinatorics)
  {
  }

  /// As `Site_tree::construct_cells()`.
  template <class Sink>
  void construct_cells(double cos_angle, Sink&& sink)
  {
    if (!m_certified) return Base::construct_cells(cos_angle, sink);
    const auto view = this->view();
    std::vector<char> is_doubtful(view.size(), 0);
    Base::template construct_cells<true>(
        cos_angle, [&](int i, Cell_status status, const Tangent_polygon<double>& polygon,
                       const Tangent_frame<double>& frame, bool certain) {
          if (certain)
            sink(i, status, polygon, frame);
          else
            is_doubtful[i] = 1;
        });
    std::vector<int> doubtful;
    for (int i = 0; i < view.size(); ++i)
      if (is_doubtful[i]) doubtful.push_back(i);
    if (doubtful.empty()) return;
    using Kernel = Exact_predicates_inexact_constructions_kernel; // the samples are doubles
    const auto cells = internal::exact_cells<Kernel>(view, cos_angle, Exact_neighbours::search);
    internal::for_each_index<ConcurrencyTag>(int(doubtful.size()), [&](int k) {
      construct_exact_cell(cells, view, doubtful[k], sink);
    });
  }
};

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_ENGINES_EXACT_SITE_TREE_H
