// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `limit_growth()` where a backend works: all vertices at once, in rounds.
#ifndef CGAL_POWER_RTF_FIELDS_GROWTH_ROUNDS_H
#define CGAL_POWER_RTF_FIELDS_GROWTH_ROUNDS_H

#include <CGAL/PowerRTF/fields/density_steps.h>
#include <CGAL/PowerRTF/internal/atomics.h>

namespace CGAL::PowerRTF::internal {

/// A vertex that the last round has lowered lowers its neighbors; in round 0, every vertex does.
struct Lower_neighbors {
  Growth_bound bound;
  double* h;
  int* lowered; ///< by vertex, the last round that has lowered it; -1 before round 0
  int* last;    ///< the last round that has lowered any
  int round;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    if (atomic_load(lowered + v) != round - 1) return;
    const Edges_view& edges = bound.edges;
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e) {
      const int u = edges.neighbor[e];
      if (!atomic_min(h + u, bound(v, e))) continue;
      atomic_store(lowered + u, round);
      atomic_store(last, round);
    }
  }
};

/// What the host's `limit_growth()` makes of `h`, which is at `n` vertices. `lowered` has room for
/// as many, `last` for one.
template <class Backend>
void limit_growth(Backend& backend, int n, const Edges_view& edges, double gradation, double* h,
                  int* lowered, int* last)
{
  constexpr int rounds_at_once = 16; // to look after each would take longer than a few in vain
  backend.fill(lowered, -1, n);
  backend.fill(last, -1, 1);
  int round = 0, last_round;
  do {
    for (int k = 0; k < rounds_at_once; ++k, ++round)
      backend.for_each(n, Lower_neighbors{{edges, gradation, h}, h, lowered, last, round});
    backend.download(&last_round, last, 1);
  } while (last_round == round - 1);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_FIELDS_GROWTH_ROUNDS_H
