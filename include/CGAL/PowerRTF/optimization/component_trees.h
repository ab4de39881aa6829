// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The connected components of the cells, by trees of labels.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_COMPONENT_TREES_H
#define CGAL_POWER_RTF_OPTIMIZATION_COMPONENT_TREES_H

#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/label_trees.h>
#include <CGAL/PowerRTF/optimization/assemble_laplacian.h>

namespace CGAL::PowerRTF {

/// The connected components of the cells.
struct Component_view {
  int* label;       ///< of each cell: the least number in its component
  int* is_anchored; ///< by label: whether a cell has an edge with a site that has none
};

/// Finds the components. \param is_tied see `assemble_laplacian()`
/// \param scalar memory of the backend for one number
/// \returns their number
template <class Row, class Backend>
int find_components(Backend& backend, const Laplacian_rows<Row>& a, const unsigned char* is_tied,
                    const Component_view& components, double* scalar)
{
  const int n = a.n;
  int* const label = components.label;
  int* const is_anchored = components.is_anchored;
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) { label[i] = i; });
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    for (int k = 0; k < a.size[i]; ++k) {
      const int j = a.column[a.place(k, i)];
      if (j < i) join_trees(label, i, j);
    }
  });
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) { atomic_store(label + i, root_of(label, i)); });
  backend.template reduce<1, 0>(
      n, [=] CGAL_POWER_RTF_HD(int i, Totals<1, 0>& t) { t.add(0, label[i] == i); },
      [=] CGAL_POWER_RTF_HD(const Totals<1, 0>& t) { *scalar = t.sum(0); });
  backend.fill(is_anchored, 0, n);
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    if (is_tied[i]) atomic_store(is_anchored + label[i], 1);
  });
  double count;
  backend.download(&count, scalar, 1);
  return int(count);
}

/// Adds `f(i)`, at most `*largest` in size, up over each component, exactly, hence in any order, in
/// units of `*largest` / 2^61.
template <class Backend, class F>
void sum_over_components(Backend& backend, int n, const int* label, F f, const double* largest,
                         long long* sums)
{
  backend.fill(sums, 0ll, n);
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    atomic_add(&sums[label[i]], static_cast<long long>(f(i) / *largest * 0x1p61));
  });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_COMPONENT_TREES_H
