// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells of the engine on the GPU.
#ifndef CGAL_POWER_RTF_CUDA_CELLS_H
#define CGAL_POWER_RTF_CUDA_CELLS_H

#include "cells/cell_builder.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::device {

/// Row i of `padded`, of `sizes[i]` items, to where `first[i] - origin` says.
struct Pack_rows {
  static constexpr int stride = Tangent_polygon<float>::capacity;
  const int* sizes;
  const std::size_t* first;
  std::size_t origin;
  const int* padded;
  int* packed;
  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    for (int k = 0; k < sizes[i]; ++k)
      packed[first[i] - origin + k] = padded[std::size_t(i) * stride + k];
  }
};

/// Models `PowerRTFCells`.
template <class Real>
class Cuda_cells {
public:
  /// The radius of the first search is not needed: lists of near sites are made.
  Cuda_cells(Cuda_backend& backend, int max_sites, Real cos_angle, Real,
             const Remeshing_options& options)
      : m_backend(backend), m_builder(backend, max_sites, cos_angle, Real(options.guard_factor))
  {}

  /// What so many sites take.
  static std::size_t bytes(int sites, bool has_features)
  {
    return Cell_builder<Real>::bytes(sites, has_features);
  }
  /// What `neighbors()` takes beside that.
  static std::size_t neighbors_bytes(int cells)
  {
    const std::size_t n = std::min(cells, rows_chunk);
    return internal::bytes_of_listed<Neighbor_rows>(n) + cells * sizeof(unsigned char) +
           n * least_edges * sizeof(int);
  }

  void set_sites(const Sites_arrays<Real>& in)
  {
    m_cells = in.cells;
    m_builder.set_sites(in);
  }
  void set_weights(const Sites_arrays<Real>& in) { m_builder.set_weights(in); }
  void build(const Cell_outputs<Real>& out) { m_builder.build(out); }

  const int* start_weight_passes(const Sites_arrays<Real>& in, Site<Real>* sites,
                                 const Real* density, const Multiplicative_weight_rule& rule,
                                 int passes, const Cell_outputs<Real>& out)
  {
    return m_builder.start_weight_passes({in, sites, density, rule, passes, out})
               ? &m_builder.weight_pass_state()->done
               : nullptr;
  }
  void neighbor_distances(Real* first, Real* sixth)
  {
    m_builder.neighbor_distances(true, first, sixth);
  }
  /// Of all cells, which takes no longer.
  void empty_cells_distances(const unsigned char*, Real* first, Real* sixth)
  {
    m_builder.neighbor_distances(false, first, sixth);
  }

  /// Brings the cells to the host by and by.
  template <class Sink>
  void for_each_cell(Sink&& sink)
  {
    for_each_chunk(chunk, [&](int begin, int end, unsigned char* statuses) {
      for_each_cell(begin, end, statuses, sink);
    });
  }

  Neighbor_cycles neighbors()
  {
    constexpr std::size_t mostly = 6;
    Neighbor_cycles all;
    all.first.resize(m_cells + std::size_t(1));
    all.neighbors.reserve(mostly * m_cells);
    for_each_chunk(rows_chunk, [&](int begin, int end, unsigned char* statuses) {
      add_neighbors(begin, end, statuses, all);
    });
    return all;
  }

private:
  template <class T>
  using Buffer = Cuda_backend::Buffer<T>;
  static constexpr int stride = Tangent_polygon<Real>::capacity;
  // Cells of 800 megabytes, with coordinates and without; each chunk constructs all cells again.
  static constexpr int chunk = 1 << 20, rows_chunk = 3 << 20;
  static constexpr int least_edges = 5; // of a cell, on average: mostly 6

  struct Neighbor_rows {
    Buffer<int> sizes, padded;
    Buffer<std::size_t> first;

    template <class F>
    static void for_each_array(F&& f, std::size_t cells)
    {
      f(&Neighbor_rows::sizes, cells);
      f(&Neighbor_rows::padded, cells * stride);
      f(&Neighbor_rows::first, cells);
    }
  };

  // Calls `f(begin, end, statuses)` for chunks of `chunk` cells; `statuses`: of all.
  template <class F>
  void for_each_chunk(int chunk, F&& f)
  {
    Buffer<unsigned char> statuses;
    statuses.allocate(m_backend, m_cells);
    for (int begin = 0; begin < m_cells; begin += chunk)
      f(begin, std::min(begin + chunk, m_cells), statuses.data());
  }

  // Only they are brought to the host, without gaps between them.
  void add_neighbors(int begin, int end, unsigned char* statuses, Neighbor_cycles& all)
  {
    const std::size_t n = end - begin, before = all.neighbors.size();
    Neighbor_rows rows;
    internal::allocate_listed(m_backend, rows, n);
    m_builder.polygons(begin, end, rows.sizes.data(), nullptr, nullptr, rows.padded.data(),
                       statuses);
    std::size_t* const first = all.first.data() + begin;
    const auto sizes = downloaded(rows.sizes);
    const internal::Concurrency concurrency = Cuda_backend::concurrency();
    internal::for_each_index(concurrency, int(n), [&](int i) { first[i] = sizes[i]; });
    first[n] = internal::exclusive_scan(concurrency, int(n), first);
    internal::for_each_index(concurrency, int(n) + 1, [&](int i) { first[i] += before; });
    m_backend.upload(rows.first.data(), first, n);
    Buffer<int> packed;
    packed.allocate(m_backend, first[n] - before);
    m_backend.for_each(int(n), Pack_rows{rows.sizes.data(), rows.first.data(), before,
                                         rows.padded.data(), packed.data()});
    all.neighbors.resize(first[n]);
    m_backend.download(all.neighbors.data() + before, packed.data(), packed.size());
  }

  template <class Sink>
  void for_each_cell(int begin, int end, unsigned char* statuses, Sink& sink)
  {
    const std::size_t n = end - begin;
    Buffer<Real> x, y;
    Buffer<int> sizes, neighbors;
    sizes.allocate(m_backend, n);
    neighbors.allocate(m_backend, n * stride);
    m_backend.fill(neighbors.data(), 0, n * stride); // beyond the sizes nothing is written
    for (Buffer<Real>* b : {&x, &y}) {
      b->allocate(m_backend, n * stride);
      m_backend.fill(b->data(), Real(0), n * stride);
    }
    m_builder.polygons(begin, end, sizes.data(), x.data(), y.data(), neighbors.data(), statuses);
    const auto xs = downloaded(x), ys = downloaded(y);
    const auto size = downloaded(sizes), neighbor = downloaded(neighbors);
    std::vector<unsigned char> status(n);
    m_backend.download(status.data(), statuses + begin, n);
    for (std::size_t i = 0; i < n; ++i) {
      Tangent_polygon<double> polygon;
      polygon.size = size[i];
      for (int k = 0; k < polygon.size; ++k) {
        polygon.x[k] = xs[i * stride + k];
        polygon.y[k] = ys[i * stride + k];
        polygon.neighbor[k] = neighbor[i * stride + k];
      }
      sink(begin + int(i), Cell_status(status[i]), polygon, Tangent_frame<double>({0, 0, 1}));
    }
  }

  template <class T>
  internal::Unset_vector<T> downloaded(const Buffer<T>& buffer)
  {
    internal::Unset_vector<T> items(buffer.size());
    m_backend.download(items.data(), buffer.data(), items.size());
    return items;
  }

  Cuda_backend& m_backend;
  Cell_builder<Real> m_builder;
  int m_cells = 0;
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_CELLS_H
