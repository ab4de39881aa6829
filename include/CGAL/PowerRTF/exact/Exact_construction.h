// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells of the engines that ask for exact combinatorics: all of them by the oracle, or only
// those that the fast path's filter cannot prove.
#ifndef CGAL_POWER_RTF_EXACT_EXACT_CONSTRUCTION_H
#define CGAL_POWER_RTF_EXACT_EXACT_CONSTRUCTION_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/cells/Tree_cells.h>
#include <CGAL/PowerRTF/exact/construct_exact_cell.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// The oracle over the samples of a view.
template <class Kernel>
Exact_cells<Kernel> exact_cells(const Sites_view<double>& view, double cos_angle)
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
  return {std::move(points), std::move(normals), std::move(weights), cos_angle, std::move(patches)};
}

} // namespace internal

/// Cells by the oracle, for `Tree_cells`.
template <class Kernel>
struct Exact_construction {
  explicit Exact_construction(const Remeshing_options&) {}

  template <class Cells, class Sink>
  void operator()(Cells& cells, Sink&& sink) const
  {
    const auto view = cells.view();
    auto oracle = internal::exact_cells<Kernel>(view, cells.cos_angle());
    oracle.triangulate();
    cells.backend().for_each(cells.size(),
                             [&](int i) { construct_exact_cell(oracle, view, i, sink); });
  }
};

/// Cells by the fast path; with `certified_combinatorics`, those whose neighbors it cannot prove by
/// the oracle.
class Filtered_construction {
public:
  explicit Filtered_construction(const Remeshing_options& options)
      : m_is_certified(options.certified_combinatorics)
  {}

  template <class Cells, class Sink>
  void operator()(Cells& cells, Sink&& sink) const
  {
    if (!m_is_certified) return cells.construct_by_leaves(sink);
    std::vector<char> is_doubtful(cells.size(), 0);
    cells.template construct_by_leaves<true>([&](int i, Cell_status status,
                                                 const Tangent_polygon<double>& polygon,
                                                 const Tangent_frame<double>& frame, bool certain) {
      if (certain)
        sink(i, status, polygon, frame);
      else
        is_doubtful[i] = 1;
    });
    std::vector<int> doubtful;
    for (int i = 0; i < cells.size(); ++i)
      if (is_doubtful[i]) doubtful.push_back(i);
    if (doubtful.empty()) return;
    using Kernel = Exact_predicates_inexact_constructions_kernel; // the samples are doubles
    const auto view = cells.view();
    const auto oracle = internal::exact_cells<Kernel>(view, cells.cos_angle());
    cells.backend().for_each(int(doubtful.size()),
                             [&](int k) { construct_exact_cell(oracle, view, doubtful[k], sink); });
  }

private:
  bool m_is_certified;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXACT_EXACT_CONSTRUCTION_H
