// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The connected components of items that hang together in pairs.
#ifndef CGAL_POWER_RTF_INTERNAL_CONNECTED_COMPONENTS_H
#define CGAL_POWER_RTF_INTERNAL_CONNECTED_COMPONENTS_H

#include <CGAL/PowerRTF/internal/label_trees.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The components of `n` items, numbered by their first ones. `for_each_linked(i, f)` calls `f(j)`
/// for the items that hang together with `i`; of a pair, one has to name the other.
/// \returns the component of each item, and their number
template <class F>
std::pair<std::vector<int>, int> connected_components(Concurrency concurrency, int n,
                                                      F&& for_each_linked)
{
  std::vector<int> component(n); // first the least item
  for_each_index(concurrency, n, [&](int i) { component[i] = i; });
  for_each_index(concurrency, n, [&](int i) {
    for_each_linked(i, [&](int j) { join_trees(component.data(), i, j); });
  });
  const std::vector<int> least =
      select(concurrency, n, [&](int i) { return atomic_load(&component[i]) == i; });
  for_each_index(concurrency, n,
                 [&](int i) { atomic_store(&component[i], root_of(component.data(), i)); });
  for_each_index(concurrency, n, [&](int i) {
    component[i] = static_cast<int>(std::lower_bound(least.begin(), least.end(), component[i]) -
                                    least.begin());
  });
  return {std::move(component), static_cast<int>(least.size())};
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_CONNECTED_COMPONENTS_H
