// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// cuda_cells [most sites, default 10000000]
//
// Times of the GPU's cells alone, on a torus whose sites are relaxed by Lloyd's method: medians in
// ms, and the rates that follow. Beside them what device memory alone would take for the bytes that
// a construction must move: per site 16 (site), 16 (normal), 4 (order), 4 (density), 4 + 4 (radius)
// and 21 (area, mass, centroid, status).
#include "../../../cuda/cells/cell_builder.h"
#include "../../../cuda/test/torus_sites.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace CGAL::PowerRTF;
using namespace CGAL::PowerRTF::device;

namespace {

class Timer {
public:
  explicit Timer(Cuda_backend& backend) : m_backend(backend)
  {
    check(cudaEventCreate(&m_begin), "timing");
    check(cudaEventCreate(&m_end), "timing");
  }
  ~Timer()
  {
    cudaEventDestroy(m_begin);
    cudaEventDestroy(m_end);
  }
  /// Median in ms, after two runs to warm up.
  template <class F>
  double operator()(int runs, F&& f)
  {
    std::vector<float> times(runs);
    for (int k = -2; k < runs; ++k) {
      check(cudaEventRecord(m_begin, m_backend.stream()), "timing");
      f();
      check(cudaEventRecord(m_end, m_backend.stream()), "timing");
      check(cudaEventSynchronize(m_end), "timing");
      if (k >= 0) check(cudaEventElapsedTime(&times[k], m_begin, m_end), "timing");
    }
    std::sort(times.begin(), times.end());
    return times[runs / 2];
  }

private:
  Cuda_backend& m_backend;
  cudaEvent_t m_begin = nullptr, m_end = nullptr;
};

/// Bytes per second of a copy, read and written.
double copy_bandwidth(Cuda_backend& backend, Timer& time)
{
  constexpr std::size_t n = std::size_t(1) << 28;
  Cuda_backend::Buffer<float> a, b;
  a.allocate(backend, n);
  b.allocate(backend, n);
  backend.fill(a.data(), 1.0f, n);
  const double ms = time(9, [&] {
    check(cudaMemcpyAsync(b.data(), a.data(), 4 * n, cudaMemcpyDeviceToDevice, backend.stream()),
          "copy");
  });
  return 8 * n / ms * 1e3;
}

template <class Real>
void measure(Cuda_backend& backend, Timer& time, int n, double contrast, double bandwidth)
{
  Torus<Real> torus;
  torus.contrast = contrast;
  Device_sites<Real> d(backend, random_torus_sites(torus, n, 7));
  d.sort();
  Cell_builder<Real> cells(backend, n, Real(-0.766), 3);
  d.relax(cells, torus, 33);
  cells.set_sites(d.arrays());
  cells.build(d.outputs());

  const int runs = n <= 1000000 ? 17 : 9;
  const double take = time(runs, [&] { cells.set_sites(d.arrays()); });
  const double build = time(runs, [&] { cells.build(d.outputs()); });
  cells.set_weights(d.arrays()); // lists are made
  cells.build(d.outputs());
  cells.set_weights(d.arrays()); // and read
  const double list = time(runs, [&] { cells.build(d.outputs()); });

  // Passes that never find all masses inside; the density is that of the sites.
  Cuda_backend::Buffer<Real> first, sixth, density;
  first.allocate(backend, n);
  sixth.allocate(backend, n);
  density.allocate(backend, n);
  {
    const Site<Real>* const s = d.sites.data();
    Real* const rho = density.data();
    backend.for_each(n, [=] __device__(int i) {
      const Vec3<Real> p = s[i].point;
      rho[i] = Real(torus.density({p.x, p.y, p.z}) / torus.density({0, 0, 0}));
    });
  }
  cells.neighbor_distances(true, first.data(), sixth.data());
  const double distances =
      time(3, [&] { cells.neighbor_distances(true, first.data(), sixth.data()); });
  constexpr int passes = 32;
  const auto run_passes = [&](int count) {
    return time(3, [&] {
      cells.set_sites(d.arrays());
      const Multiplicative_weight_rule rule{1e-6, 0.01, false, 0};
      cells.paper_weight_passes(d.arrays(), d.sites.data(), density.data(), first.data(),
                                sixth.data(), rule, count, d.outputs());
    });
  };
  const double pass = (run_passes(passes) - run_passes(1)) / (passes - 1);
  std::vector<unsigned char> status(n);
  backend.download(status.data(), d.status.data(), n);
  const auto other = n - std::count(status.begin(), status.end(), 0);

  const double bytes = 5 * sizeof(Real) * 4 / 4.0 + 2 * 4 * sizeof(Real) + 8 + 5 * sizeof(Real) + 1;
  std::printf(
      "%9d %8.0f %6s | %8.4f %8.4f %6.2f %8.4f | %8.4f %6.2f | %8.4f %6.2f | %8.4f | %5.0f %6d\n",
      n, contrast, sizeof(Real) == 4 ? "float" : "double", take, build, n / build * 1e-6,
      n * bytes / bandwidth * 1e3, list, n / list * 1e-6, pass, n / pass * 1e-6, distances,
      double(cells.bytes()) / n, int(other));
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
  try {
    const int most = argc > 1 ? std::atoi(argv[1]) : 10000000;
    Cuda_backend backend(0);
    Timer time(backend);
    const double bandwidth = copy_bandwidth(backend, time);
    std::printf("%s, copies at %.2f TB/s\n", backend.name().c_str(), bandwidth * 1e-12);
    std::printf("%9s %8s %6s | %8s %8s %6s %8s | %8s %6s | %8s %6s | %8s | %5s %6s\n", "sites",
                "contrast", "", "take", "cells", "G/s", "DRAM", "by list", "G/s", "pass", "G/s",
                "D1, D6", "B/site", "not ok");
    for (int n : {3000, 30000, 1000000, 10000000, 30000000})
      if (n <= most) measure<float>(backend, time, n, 1, bandwidth);
    for (double contrast : {10.0, 100.0})
      if (most >= 1000000) measure<float>(backend, time, 1000000, contrast, bandwidth);
    for (int n : {3000, 1000000})
      if (n <= most) measure<double>(backend, time, n, 1, bandwidth);
  } catch (const Cuda_error& error) {
    std::printf("%s\n", error.what());
    return 77;
  }
}
