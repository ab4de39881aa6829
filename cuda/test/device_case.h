// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sites on the device, their cells, and the comparison of these with the host's.
#ifndef CGAL_POWER_RTF_CUDA_DEVICE_CASE_H
#define CGAL_POWER_RTF_CUDA_DEVICE_CASE_H

#include "../cells/cell_builder.h"
#include "host_cells.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

namespace CGAL::PowerRTF::device {

inline std::unique_ptr<Cuda_backend> backend;

template <class Real>
struct Case {
  Host_sites<Real> host;
  std::vector<int> patches;
  double cos_angle = -0.766, guard_factor = 3;
};

/// Sites, their builder and its cells.
template <class Real>
class Device_case {
public:
  explicit Device_case(const Case<Real>& c)
      : m_case(c), sites(*backend, c.host),
        cells(*backend, sites.size(), Real(c.cos_angle), Real(c.guard_factor))
  {
    if (c.patches.empty()) return;
    m_patches.allocate(*backend, c.patches.size());
    backend->upload(m_patches.data(), c.patches.data(), c.patches.size());
  }

  Sites_arrays<Real> arrays() const
  {
    Sites_arrays<Real> a = sites.arrays();
    if (m_patches.size() > 0) a.patches = m_patches.data();
    return a;
  }

  /// The cells of the current state; moments from `build()`, the rest from `polygons()`.
  std::vector<Plain_cell> download()
  {
    constexpr int capacity = Tangent_polygon<Real>::capacity;
    const int n = sites.size();
    cells.build(sites.outputs());
    Cuda_backend::Buffer<int> size, neighbor;
    Cuda_backend::Buffer<Real> x, y;
    Cuda_backend::Buffer<unsigned char> status;
    size.allocate(*backend, n);
    status.allocate(*backend, n);
    neighbor.allocate(*backend, std::size_t(n) * capacity);
    x.allocate(*backend, std::size_t(n) * capacity);
    y.allocate(*backend, std::size_t(n) * capacity);
    backend->fill(neighbor.data(), 0, neighbor.size()); // most rows are not full
    backend->fill(x.data(), Real(0), x.size());
    backend->fill(y.data(), Real(0), y.size());
    cells.polygons(0, n, size.data(), x.data(), y.data(), neighbor.data(), status.data());
    const auto get = [](auto& buffer) {
      std::vector<std::remove_pointer_t<decltype(buffer.data())>> v(buffer.size());
      backend->download(v.data(), buffer.data(), v.size());
      return v;
    };
    const auto sizes = get(size), neighbors = get(neighbor);
    const auto xs = get(x), ys = get(y), areas = get(sites.area), masses = get(sites.mass);
    const auto offsets = get(sites.offset);
    const auto states = get(status), again = get(sites.status);
    CHECK(states == again);
    std::vector<Plain_cell> result(n);
    for (int i = 0; i < n; ++i) {
      Plain_cell& c = result[i];
      c.status = static_cast<Cell_status>(states[i]);
      c.area = areas[i];
      c.mass = masses[i];
      c.offset = {offsets[i].x, offsets[i].y, offsets[i].z};
      const std::size_t first = std::size_t(i) * capacity;
      for (int k = 0; k < sizes[i]; ++k) {
        const int l = k + 1 < sizes[i] ? k + 1 : 0;
        c.cycle.push_back(neighbors[first + k]);
        c.lengths.push_back(
            std::hypot(xs[first + l] - xs[first + k], ys[first + l] - ys[first + k]));
      }
    }
    return result;
  }

  /// Compares the current cells with the host's.
  Cell_comparison compare(const char* name)
  {
    const std::vector<Plain_cell> own = download();
    Host_cells host(sites.download(), m_case.patches, m_case.cos_angle, m_case.guard_factor);
    const Cell_comparison c = compare_cells(own, host.construct(), twins(host.sites));
    std::printf("%-28s n %6d ok %6d | other status %d, other cycle %d (edge %.0e) | area p99 %.1e "
                "most %.1e | centroid p99 %.1e most %.1e\n",
                name, c.cells, c.ok, c.other_status, c.other_cycle, c.longest_edge, c.area_p99,
                c.area_most, c.centroid_p99, c.centroid_most);
    // Cells with more than 32 edges, or on the guard radius.
    CHECK(c.other_status <= c.cells / 5000);
    CHECK(c.longest_edge < 1e-4);
    return c;
  }

private:
  Case<Real> m_case;
  Cuda_backend::Buffer<int> m_patches;

public:
  Device_sites<Real> sites;
  Cell_builder<Real> cells;
};

template <class Real>
Case<Real> torus_case(int n, double contrast = 1)
{
  Torus<Real> torus;
  torus.contrast = contrast;
  Case<Real> c;
  c.host = random_torus_sites(torus, n, 1);
  return c;
}

/// Of n sites on the torus, whose area is 4 pi^2 ring tube.
inline double spacing(int n) { return std::sqrt(1.7765 / n); }

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_DEVICE_CASE_H
