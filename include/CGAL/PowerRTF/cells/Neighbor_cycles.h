// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The neighbors of all cells, in the order in which they follow each other around a cell.
#ifndef CGAL_POWER_RTF_CELLS_NEIGHBOR_CYCLES_H
#define CGAL_POWER_RTF_CELLS_NEIGHBOR_CYCLES_H

#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>

namespace CGAL::PowerRTF {

/// Those of cell i are `neighbors[first[i]]` to `neighbors[first[i + 1] - 1]`, counter-clockwise
/// seen from outside; negative: a side of the guard square.
struct Neighbor_cycles {
  internal::Unset_vector<std::size_t> first = {0};
  internal::Unset_vector<int> neighbors;

  class Cycle {
  public:
    Cycle(const int* begin, const int* end) : m_begin(begin), m_end(end) {}
    const int* begin() const { return m_begin; }
    const int* end() const { return m_end; }
    std::size_t size() const { return m_end - m_begin; }

  private:
    const int *m_begin, *m_end;
  };

  Neighbor_cycles() = default;
  /// Of `cells` cells. `cycle`: function i -> `Cycle`.
  template <class Cycle_of>
  Neighbor_cycles(int cells, const Cycle_of& cycle,
                  internal::Concurrency concurrency = Sequential_tag())
      : first(cells + 1)
  {
    internal::for_each_index(concurrency, cells, [&](int i) { first[i] = cycle(i).size(); });
    first[cells] = internal::exclusive_scan(concurrency, cells, first.data());
    neighbors.resize(first[cells]);
    internal::for_each_index(concurrency, cells, [&](int i) {
      std::copy(cycle(i).begin(), cycle(i).end(), neighbors.begin() + first[i]);
    });
  }

  /// The number of cells.
  std::size_t size() const { return first.size() - 1; }
  Cycle operator[](std::size_t i) const
  {
    return {neighbors.data() + first[i], neighbors.data() + first[i + 1]};
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_NEIGHBOR_CYCLES_H
