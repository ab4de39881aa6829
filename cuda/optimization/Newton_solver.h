// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Newton's direction for the weights on the device: the system of `newton_weights_direction()`,
// solved by conjugate gradients. The direction is damped and its step judged afterwards, so the
// residual need only fall to a small part.
#ifndef CGAL_POWER_RTF_CUDA_NEWTON_SOLVER_H
#define CGAL_POWER_RTF_CUDA_NEWTON_SOLVER_H

#include "../cells/cell_arrays.h"
#include "Resident_gradients.h"
#include "component_trees.h"

#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/optimization/Multigrid_gradients.h>

#include <cmath>
#include <cstddef>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// The areas of the cells that have to become equal, and their shares of them.
template <class Real>
struct Counted_area {
  const Real* area;
  const unsigned char* keeps_area;
  CGAL_POWER_RTF_HD double operator()(int i) const { return keeps_area[i] ? 0 : double(area[i]); }
};
template <class Real>
struct Counted_share {
  const Real* density;
  const unsigned char* keeps_area;
  CGAL_POWER_RTF_HD double operator()(int i) const
  { return keeps_area[i] ? 0 : 1 / double(density[i]); }
};

template <class Real, class Backend>
class Newton_solver
{
public:
  static constexpr int edge_capacity = 16;
  /// A direction is near enough when it would bring all areas within this part of the capacity
  /// interval around their targets, or leave this part of the residual's norm. What one step
  /// leaves, the next one takes.
  static constexpr double part_of_interval = 0.5, tolerance = 0.03;

  explicit Newton_solver(Backend& backend) : m_backend(backend), m_gradients(backend)
  {
    m_scalars.allocate(backend, 4);
  }

  /// Where `build()` shall write the edges of n cells.
  void add_outputs(int n, Cell_outputs<Real>& out)
  {
    m_edge_count.allocate(m_backend, n);
    m_edge_neighbor.allocate(m_backend, std::size_t(n) * edge_capacity);
    m_edge_ratio.allocate(m_backend, std::size_t(n) * edge_capacity);
    out.edge_count = m_edge_count.data();
    out.edge_neighbor = m_edge_neighbor.data();
    out.edge_ratio = m_edge_ratio.data();
    out.edge_capacity = edge_capacity;
  }

  /// Solves for the direction from areas and densities, after the edges have been written; 0 when
  /// the system cannot be solved. Cells with `keeps_area[i]` have their own area as the target.
  /// `find_components`: the cells may hang together in another way
  /// than last time.
  void solve(int n, const Real* area, const Real* density, const unsigned char* keeps_area,
             double capacity_tolerance, bool find_components);

  /// n weights' changes; their mean on each component is 0 if nothing fixes it.
  const double* direction() const { return m_x.data(); }

  // Public for the device compiler alone.
  void make_rows(int n);
  void label_components();
  void set_residual(const Real* area, const Real* density, const unsigned char* keeps_area,
                    double capacity_tolerance);
  void iterate();
  void subtract_means();
  /// Adds `f(i)`, at most `most` in size, up over each component, exactly, hence in any order.
  template <class F>
  void component_sums(F f, const double* most, long long* sums);

private:
  static constexpr int most_resident = 300000; ///< threads that a GPU runs at once
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Laplacian_rows<Real> rows()
  {
    return {m_row_size.data(), m_column.data(), m_value.data(), m_diagonal.data(), m_n};
  }

  Backend& m_backend;
  int m_n = 0;
  bool m_is_connected = false;
  Buffer<int> m_edge_count, m_edge_neighbor;
  Buffer<Real> m_edge_ratio;
  Buffer<int> m_row_size, m_column, m_label, m_is_anchored;
  Buffer<Real> m_value;
  Buffer<double> m_diagonal, m_x, m_r, m_exchanged[2], m_limits, m_scalars;
  Multigrid_gradients<Real, Backend> m_gradients;
  Buffer<long long> m_sums[3];
};

template <class Real, class Backend>
void Newton_solver<Real, Backend>::solve(int n, const Real* area, const Real* density,
                                         const unsigned char* keeps_area,
                                         double capacity_tolerance, bool find_components)
{
  m_n = n;
  for (Buffer<double>* b : {&m_diagonal, &m_x, &m_r, &m_limits}) b->allocate(m_backend, n);
  make_rows(n);
  if (find_components) label_components();
  set_residual(area, density, keeps_area, capacity_tolerance);
  iterate();
  subtract_means();
}

template <class Real, class Backend>
void Newton_solver<Real, Backend>::make_rows(int n)
{
  constexpr int capacity = Laplacian_rows<Real>::capacity;
  m_row_size.allocate(m_backend, n);
  m_column.allocate(m_backend, std::size_t(n) * capacity);
  m_value.allocate(m_backend, std::size_t(n) * capacity);
  const Laplacian_rows<Real> a = rows();
  const int *const count = m_edge_count.data(), *const neighbor = m_edge_neighbor.data();
  const Real* const ratio = m_edge_ratio.data();
  const std::size_t stride = n;

  // Own edges, with the other side's where the other cell has the edge too.
  m_backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    int size = 0;
    for (int k = 0; k < count[i]; ++k) {
      const int j = neighbor[k * stride + i];
      if (j >= n) continue; // a site without a cell: see below
      Real sum = ratio[k * stride + i];
      for (int l = 0; l < count[j]; ++l)
        if (neighbor[l * stride + j] == i) sum += ratio[l * stride + j];
      a.column[size * stride + i] = j;
      a.value[size++ * stride + i] = sum / 4;
    }
    a.size[i] = size;
  });
  // Edges that only the other cell has; they come in any order and are sorted.
  m_backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    for (int k = 0; k < count[i]; ++k) {
      const int j = neighbor[k * stride + i];
      if (j >= n) continue;
      bool is_mutual = false;
      for (int l = 0; l < count[j]; ++l) is_mutual = is_mutual || neighbor[l * stride + j] == i;
      if (is_mutual) continue;
      const int place = atomic_add(&a.size[j], 1);
      if (place >= capacity) continue;
      a.column[place * stride + j] = i;
      a.value[place * stride + j] = ratio[k * stride + i] / 4;
    }
  });
  m_backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    if (a.size[i] > capacity) a.size[i] = capacity;
    const int size = a.size[i];
    double sum = 0;
    for (int k = 0; k < count[i]; ++k) // the weight of a site without a cell stays
      if (neighbor[k * stride + i] >= n) sum += double(ratio[k * stride + i]) / 2;
    for (int k = 1; k < size; ++k) {
      const int column = a.column[k * stride + i];
      const Real value = a.value[k * stride + i];
      int place = k;
      for (; place > 0 && a.column[(place - 1) * stride + i] > column; --place) {
        a.column[place * stride + i] = a.column[(place - 1) * stride + i];
        a.value[place * stride + i] = a.value[(place - 1) * stride + i];
      }
      a.column[place * stride + i] = column;
      a.value[place * stride + i] = value;
    }
    for (int k = 0; k < size; ++k) sum += a.value[k * stride + i];
    a.diagonal[i] = sum;
  });
}

template <class Real, class Backend>
void Newton_solver<Real, Backend>::label_components()
{
  m_label.allocate(m_backend, m_n);
  const Laplacian_rows<Real> a = rows();
  int* const label = m_label.data();
  m_backend.for_each(m_n, [=] CGAL_POWER_RTF_HD(int i) { label[i] = i; });
  m_backend.for_each(m_n, [=] CGAL_POWER_RTF_HD(int i) {
    for (int k = 0; k < a.size[i]; ++k) {
      const int j = a.column[std::size_t(k) * a.n + i];
      if (j < i) join_trees(label, i, j);
    }
  });
  m_backend.for_each(m_n, [=] CGAL_POWER_RTF_HD(int i) { label[i] = root_of(label, i); });
  double* const scalars = m_scalars.data();
  m_backend.template reduce<1, 0>(
      m_n, [=] CGAL_POWER_RTF_HD(int i, Totals<1, 0>& t) { t.add(0, label[i] == i); },
      [=] CGAL_POWER_RTF_HD(const Totals<1, 0>& t) { scalars[0] = t.sum(0); });
  double components;
  m_backend.download(&components, scalars, 1);
  m_is_connected = components == 1;

  // Components with an edge with a site without a cell: their weights are relative to its weight.
  m_is_anchored.allocate(m_backend, m_n);
  m_backend.fill(m_is_anchored.data(), 0, m_n);
  int* const is_anchored = m_is_anchored.data();
  const int *const count = m_edge_count.data(), *const neighbor = m_edge_neighbor.data();
  const int n = m_n;
  m_backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    for (int k = 0; k < count[i]; ++k)
      if (neighbor[std::size_t(k) * n + i] >= n) is_anchored[label[i]] = 1;
  });
}

template <class Real, class Backend>
template <class F>
void Newton_solver<Real, Backend>::component_sums(F f, const double* most, long long* sums)
{
  m_backend.fill(sums, 0ll, m_n);
  const int* const label = m_label.data();
  m_backend.for_each(m_n, [=] CGAL_POWER_RTF_HD(int i) {
    atomic_add(&sums[label[i]], static_cast<long long>(f(i) / *most * 0x1p61));
  });
}

template <class Real, class Backend>
void Newton_solver<Real, Backend>::set_residual(const Real* area, const Real* density,
                                                const unsigned char* keeps_area,
                                                double capacity_tolerance)
{
  double* const scalars = m_scalars.data();
  double *const r = m_r.data(), *const limits = m_limits.data();
  const double part = part_of_interval * capacity_tolerance;
  const Counted_area<Real> area_of{area, keeps_area};
  const Counted_share<Real> share_of{density, keeps_area};
  m_backend.template reduce<2, 0>(
      m_n,
      [=] CGAL_POWER_RTF_HD(int i, Totals<2, 0>& t) {
        t.add(0, area_of(i));
        t.add(1, share_of(i));
      },
      [=] CGAL_POWER_RTF_HD(const Totals<2, 0>& t) {
        scalars[0] = t.sum(0);
        scalars[1] = t.sum(1);
      });
  if (m_is_connected) {
    m_backend.for_each(m_n, [=] CGAL_POWER_RTF_HD(int i) {
      const double target = scalars[0] / scalars[1] / density[i];
      r[i] = keeps_area[i] ? 0 : target - area[i];
      limits[i] = part * target;
    });
    return;
  }
  for (auto& s : m_sums) s.allocate(m_backend, m_n);
  long long *const areas = m_sums[0].data(), *const shares = m_sums[1].data();
  const int* const label = m_label.data();
  component_sums(area_of, scalars, areas);
  component_sums(share_of, scalars + 1, shares);
  m_backend.for_each(m_n, [=] CGAL_POWER_RTF_HD(int i) {
    const double ratio = double(areas[label[i]]) / double(shares[label[i]]);
    const double target = ratio * scalars[0] / scalars[1] / density[i];
    r[i] = keeps_area[i] ? 0 : target - area[i];
    limits[i] = part * (keeps_area[i] ? area[i] : target);
  });
}

template <class Real, class Backend>
void Newton_solver<Real, Backend>::iterate()
{
  if (m_n <= most_resident) {
    for (Buffer<double>& b : m_exchanged) b.allocate(m_backend, m_n);
    const Resident_gradients<Real> resident{
        rows(),          m_x.data(), m_r.data(), {m_exchanged[0].data(), m_exchanged[1].data()},
        m_limits.data(), tolerance,  200 + 4 * int(std::sqrt(double(m_n)))};
    if (m_backend.run_resident_team(m_n, resident)) return;
  }
  m_gradients.solve(rows(), m_x.data(), m_r.data(), m_limits.data(), tolerance);
}

template <class Real, class Backend>
void Newton_solver<Real, Backend>::subtract_means()
{
  if (m_is_connected) return; // the caller subtracts the mean of all weights, unless it is anchored
  double* const scalars = m_scalars.data();
  double* const x = m_x.data();
  const int n = m_n;
  m_backend.template reduce<0, 1>(
      n, [=] CGAL_POWER_RTF_HD(int i, Totals<0, 1>& t) { t.raise(0, std::fabs(x[i])); },
      [=] CGAL_POWER_RTF_HD(const Totals<0, 1>& t) {
        scalars[0] = t.maximum(0) > 0 ? n * t.maximum(0) : 1;
        scalars[1] = n;
      });
  long long *const sums = m_sums[0].data(), *const counts = m_sums[1].data();
  const int *const label = m_label.data(), *const is_anchored = m_is_anchored.data();
  component_sums([=] CGAL_POWER_RTF_HD(int i) { return x[i]; }, scalars, sums);
  component_sums([=] CGAL_POWER_RTF_HD(int) { return 1.; }, scalars + 1, counts);
  m_backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) {
    if (is_anchored[label[i]]) return;
    x[i] -= double(sums[label[i]]) / double(counts[label[i]]) * (scalars[0] / scalars[1]);
  });
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_NEWTON_SOLVER_H
