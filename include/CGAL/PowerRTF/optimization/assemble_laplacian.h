// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Laplacian of the cells from the edges that each cell has found, in the memory of these.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_ASSEMBLE_LAPLACIAN_H
#define CGAL_POWER_RTF_OPTIMIZATION_ASSEMBLE_LAPLACIAN_H

#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/optimization/Laplacian_rows.h>

#include <cstddef>

namespace CGAL::PowerRTF {

namespace internal {

/// Adds up the values of row i that belong to column j, and sets them to 0.
template <class Row>
CGAL_POWER_RTF_HD inline double take_values(const Laplacian_rows<Row>& a, int i, int j, int length)
{
  double sum = 0;
  for (int k = 0; k < length; ++k) {
    if (a.column[a.place(k, i)] != j) continue;
    sum += a.value[a.place(k, i)];
    a.value[a.place(k, i)] = 0;
  }
  return sum;
}

/// Orders the first `length` entries of row i by their columns.
template <class Row>
CGAL_POWER_RTF_HD inline void sort_row(const Laplacian_rows<Row>& a, int i, int length)
{
  for (int k = 1; k < length; ++k) {
    const int column = a.column[a.place(k, i)];
    const Row value = a.value[a.place(k, i)];
    int to = k;
    for (; to > 0 && a.column[a.place(to - 1, i)] > column; --to) {
      a.column[a.place(to, i)] = a.column[a.place(to - 1, i)];
      a.value[a.place(to, i)] = a.value[a.place(to - 1, i)];
    }
    a.column[a.place(to, i)] = column;
    a.value[a.place(to, i)] = value;
  }
}

} // namespace internal

/// Makes rows of L_ij = -(e_ij/d_ij + e_ji/d_ji) / 4 where the edges are that the cells have found:
/// their numbers, neighbors and ratios (see `Cell_outputs`) are `a.size`, `a.column` and `a.value`.
/// The diagonal makes the sums 0, plus the edges with sites that have no cell, from n on: the
/// weights of these stay. It is screened. L is symmetric.
///
/// \param length n numbers, to work with
/// \param is_tied whether a cell has an edge with a site that has none
template <class Row, class Backend>
void assemble_laplacian(Backend& backend, const Laplacian_rows<Row>& a, int* length,
                        unsigned char* is_tied)
{
  constexpr int capacity = Laplacian_rows<Row>::capacity;
  const int n = a.n;
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) { length[i] = a.size[i]; });
  // The first of two cells writes what is the same for both. A value below 0: the other cell had
  // not found the edge, and has it now if there is room.
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    const int size = a.size[i];
    for (int k = 0; k < size; ++k) {
      const int j = a.column[a.place(k, i)];
      if (j >= n || a.entry(i, j, k) < k) continue;
      const int there = a.entry(j, i, a.size[j]);
      const bool is_mutual = there < a.size[j];
      if (is_mutual && j < i) continue;
      double sum = internal::take_values(a, i, j, size);
      if (is_mutual) sum += internal::take_values(a, j, i, a.size[j]);
      const Row value = Row(sum / 4);
      a.value[a.place(k, i)] = is_mutual ? value : -value;
      if (is_mutual) a.value[a.place(there, j)] = value;
      if (is_mutual) continue;
      const int place = atomic_add(&length[j], 1);
      if (place >= capacity) continue;
      a.column[a.place(place, j)] = i;
      a.value[a.place(place, j)] = value;
    }
  });
  // Where there was not room for all others, which of them came first is chance: none stays.
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    const int size = length[i] > capacity ? a.size[i] : length[i];
    internal::sort_row(a, i, size);
    double sum = 0;
    int k = 0;
    for (; k < size && a.column[a.place(k, i)] < n; ++k) {
      Row& value = a.value[a.place(k, i)];
      if (value < 0) value = length[a.column[a.place(k, i)]] > capacity ? Row(0) : -value;
      sum += value;
    }
    a.size[i] = k;
    is_tied[i] = k < size;
    for (; k < size; ++k) sum += double(a.value[a.place(k, i)]) / 2;
    a.diagonal[i] = sum * (1 + a.screening);
  });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_ASSEMBLE_LAPLACIAN_H
