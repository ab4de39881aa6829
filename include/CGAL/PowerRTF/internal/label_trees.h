// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Connected components by trees of labels, which all threads join at the same time.
#ifndef CGAL_POWER_RTF_INTERNAL_LABEL_TREES_H
#define CGAL_POWER_RTF_INTERNAL_LABEL_TREES_H

#include <CGAL/PowerRTF/internal/atomics.h>

namespace CGAL::PowerRTF {

/// The root of a tree of labels that fall from item to item; halves the way for those who follow.
/// A label never rises, so one that somebody has set to the root meanwhile stays so.
CGAL_POWER_RTF_HD inline int root_of(int* label, int i)
{
  for (int next = atomic_load(label + i); next < i;) {
    const int after = atomic_load(label + next);
    if (after < next) atomic_min(label + i, after);
    i = next;
    next = after;
  }
  return i;
}

/// Hangs the tree with the larger root under the other: in the end each root is the least item of
/// its component, whatever the order. (Jaiganesh, Burtscher, "A high-performance connected
/// components implementation for GPUs", 2018.)
CGAL_POWER_RTF_HD inline void join_trees(int* label, int i, int j)
{
  int u = root_of(label, i), v = root_of(label, j);
  while (u != v) {
    const int low = u < v ? u : v, high = u < v ? v : u;
    const int before = atomic_exchange_if(label + high, high, low);
    if (before == high) return;
    u = root_of(label, before);
    v = low;
  }
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INTERNAL_LABEL_TREES_H
