// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Laplacian of the cells from the edges that each cell has found.
#ifndef CGAL_POWER_RTF_OPTIMIZATION_ASSEMBLE_LAPLACIAN_H
#define CGAL_POWER_RTF_OPTIMIZATION_ASSEMBLE_LAPLACIAN_H

#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/optimization/Laplacian_rows.h>

#include <cstddef>

namespace CGAL::PowerRTF {

/// The edges of n cells; see `Cell_outputs`.
template <class Real>
struct Cell_edges {
  const int *count, *neighbor;
  const Real* ratio;
};

/// Writes the rows of L_ij = -(e_ij/d_ij + e_ji/d_ji) / 4 with the diagonal that makes their sums
/// 0, plus the edges with sites that have no cell: the weights of these stay. The diagonal is
/// screened.
template <class Real, class Row, class Backend>
void assemble_laplacian(Backend& backend, const Cell_edges<Real>& edges,
                        const Laplacian_rows<Row>& a)
{
  constexpr int capacity = Laplacian_rows<Real>::capacity;
  const int n = a.n;
  const std::size_t stride = n;

  // Own edges, with the other side's where the other cell has the edge too.
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    int size = 0;
    for (int k = 0; k < edges.count[i]; ++k) {
      const int j = edges.neighbor[k * stride + i];
      if (j >= n) continue; // a site without a cell: see below
      Real sum = edges.ratio[k * stride + i];
      for (int l = 0; l < edges.count[j]; ++l)
        if (edges.neighbor[l * stride + j] == i) sum += edges.ratio[l * stride + j];
      a.column[size * stride + i] = j;
      a.value[size++ * stride + i] = Row(sum / 4);
    }
    a.size[i] = size;
  });
  // Edges that only the other cell has; they come in any order and are sorted.
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    for (int k = 0; k < edges.count[i]; ++k) {
      const int j = edges.neighbor[k * stride + i];
      if (j >= n) continue;
      bool is_mutual = false;
      for (int l = 0; l < edges.count[j]; ++l)
        is_mutual = is_mutual || edges.neighbor[l * stride + j] == i;
      if (is_mutual) continue;
      const int place = atomic_add(&a.size[j], 1);
      if (place >= capacity) continue;
      a.column[place * stride + j] = i;
      a.value[place * stride + j] = Row(edges.ratio[k * stride + i] / 4);
    }
  });
  backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    if (a.size[i] > capacity) { // which of the others came first is chance: the own edges stay
      a.size[i] = 0;
      for (int k = 0; k < edges.count[i]; ++k) a.size[i] += edges.neighbor[k * stride + i] < n;
    }
    const int size = a.size[i];
    double sum = 0;
    for (int k = 0; k < edges.count[i]; ++k) // the weight of a site without a cell stays
      if (edges.neighbor[k * stride + i] >= n) sum += double(edges.ratio[k * stride + i]) / 2;
    for (int k = 1; k < size; ++k) {
      const int column = a.column[k * stride + i];
      const Row value = a.value[k * stride + i];
      int place = k;
      for (; place > 0 && a.column[(place - 1) * stride + i] > column; --place) {
        a.column[place * stride + i] = a.column[(place - 1) * stride + i];
        a.value[place * stride + i] = a.value[(place - 1) * stride + i];
      }
      a.column[place * stride + i] = column;
      a.value[place * stride + i] = value;
    }
    for (int k = 0; k < size; ++k) sum += a.value[k * stride + i];
    a.diagonal[i] = sum * (1 + a.screening);
  });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTIMIZATION_ASSEMBLE_LAPLACIAN_H
