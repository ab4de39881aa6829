// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// cuda_cells [most sites, default 10000000]
// cuda_cells --profile SITES
//
// Times of the GPU's cells alone, on a torus whose sites are relaxed by Lloyd's method: medians in
// ms, and the rates that follow. `take`: the sites into the order of their curve, and the tree over
// them; `search`: the lists of the sites that may cut each cell; `construct`: the cells from these
// lists, with area, mass, centroid and status, most of them with the edges of the construction
// before; `areas`: the cells after a change of the weights, areas only; `pass`: a whole pass of the
// paper's rule, masses, weights and areas. Where sites are few the cells are made without lists, so
// that `search` is a part of `construct`. A list holds all sites that may cut the cell as long as
// its radius is no more than 1.15 (`search`) or 1.4 (`areas`, `pass`) times that of the last one.
//
// `--profile`: each of these once, between cudaProfilerStart() and -Stop(), for cuda_rooflines.py.
#include "../../../cuda/cells/cell_builder.h"
#include "../../../cuda/test/plain_weight_passes.h"
#include "../../../cuda/test/torus_sites.h"

#include <cuda_profiler_api.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
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

/// Relaxed sites with their cells, and what the passes of the paper's rule need.
template <class Real>
struct Workload {
  Workload(Cuda_backend& b, int n, double contrast)
      : backend(b), torus(torus_of(contrast)), sites(b, random_torus_sites(torus, n, 7)),
        bytes_before(b.bytes()), cells(b, n, Real(-0.766), 3), bytes(b.bytes() - bytes_before)
  {
    sites.sort();
    sites.relax(cells, torus, 33);
    cells.set_sites(sites.arrays());
    cells.build(sites.outputs());
    first.allocate(backend, n);
    sixth.allocate(backend, n);
    density.allocate(backend, n);
    find_densities();
    cells.neighbor_distances(true, first.data(), sixth.data());
  }

  void find_densities()
  {
    const Site<Real>* const s = sites.sites.data();
    Real* const rho = density.data();
    const Torus<Real> t = torus;
    backend.for_each(sites.size(), [=] __device__(int i) {
      const Vec3<Real> p = s[i].point;
      rho[i] = Real(t.density({p.x, p.y, p.z}) / t.density({0, 0, 0}));
    });
  }
  static Torus<Real> torus_of(double contrast)
  {
    Torus<Real> t;
    t.contrast = contrast;
    return t;
  }
  /// Passes that never find all masses inside; the density is that of the sites.
  void make_passes(int count)
  {
    const Multiplicative_weight_rule rule{1e-6, 0.01, false, 0};
    if (!cells.start_weight_passes(
            {sites.arrays(), sites.sites.data(), density.data(), rule, count, sites.outputs()}))
      plain_weight_passes(backend, cells, sites, density.data(), first.data(), sixth.data(), rule,
                          count);
  }
  Cell_outputs<Real> areas()
  {
    Cell_outputs<Real> out;
    out.area = sites.area.data();
    return out;
  }

  Cuda_backend& backend;
  Torus<Real> torus;
  Device_sites<Real> sites;
  std::size_t bytes_before;
  Cell_builder<Real> cells;
  std::size_t bytes; ///< that the cells take
  Cuda_backend::Buffer<Real> first, sixth, density;
};

template <class Real>
void measure(Cuda_backend& backend, Timer& time, int n, double contrast)
{
  Workload<Real> w(backend, n, contrast);
  const int runs = n <= 1000000 ? 17 : 9;
  const auto arrays = w.sites.arrays();
  const auto outputs = w.sites.outputs();
  const double take = time(runs, [&] { w.cells.set_sites(arrays); });
  const double both = time(runs, [&] {
    w.cells.set_sites(arrays);
    w.cells.build(outputs);
  });
  const double construct = time(runs, [&] { w.cells.build(outputs); });
  const double search = std::max(both - take - construct, 0.0); // 0: a part of `construct`

  w.cells.set_weights(arrays); // lists are made
  w.cells.build(w.areas());
  w.cells.set_weights(arrays); // and read
  const double areas = time(runs, [&] { w.cells.build(w.areas()); });
  const double distances =
      time(3, [&] { w.cells.neighbor_distances(true, w.first.data(), w.sixth.data()); });
  constexpr int passes = 32;
  const auto run_passes = [&](int count) {
    return time(3, [&] {
      w.cells.set_sites(arrays);
      w.make_passes(count);
    });
  };
  const double pass = (run_passes(passes) - run_passes(1)) / (passes - 1);
  std::vector<unsigned char> status(n);
  backend.download(status.data(), w.sites.status.data(), n);
  const auto other = n - std::count(status.begin(), status.end(), 0);

  const auto rate = [&](double ms) { return ms > 0 ? n / ms * 1e-6 : 0; };
  std::printf("%9d %8.0f %6s | %8.4f | %8.4f %6.2f | %8.4f %6.2f | %8.4f %6.2f | %8.4f %6.2f | "
              "%8.4f | %5.0f %6d\n",
              n, contrast, sizeof(Real) == 4 ? "float" : "double", take, search, rate(search),
              construct, rate(construct), areas, rate(areas), pass, rate(pass), distances,
              double(w.bytes) / n, int(other));
  std::fflush(stdout);
}

/// Each step once, in this order.
void profile(Cuda_backend& backend, int n)
{
  Workload<float> w(backend, n, 1);
  const auto arrays = w.sites.arrays();
  backend.synchronize();
  check(cudaProfilerStart(), "profiling");
  w.cells.set_sites(arrays);
  w.cells.build(w.sites.outputs());
  w.cells.set_weights(arrays);
  w.cells.build(w.areas());
  w.cells.set_weights(arrays);
  w.cells.build(w.areas());
  w.make_passes(2);
  backend.synchronize();
  check(cudaProfilerStop(), "profiling");
}

} // namespace

int main(int argc, char** argv)
{
  try {
    Cuda_backend backend(0);
    Timer time(backend);
    const double bandwidth = copy_bandwidth(backend, time);
    std::printf("%s, copies at %.2f TB/s\n", backend.name().c_str(), bandwidth * 1e-12);
    if (argc > 2 && std::strcmp(argv[1], "--profile") == 0) {
      profile(backend, std::atoi(argv[2]));
      return 0;
    }
    const int most = argc > 1 ? std::atoi(argv[1]) : 10000000;
    std::printf("%9s %8s %6s | %8s | %8s %6s | %8s %6s | %8s %6s | %8s %6s | %8s | %5s %6s\n",
                "sites", "contrast", "", "take", "search", "G/s", "construc", "G/s", "areas", "G/s",
                "pass", "G/s", "D1, D6", "B/site", "not ok");
    for (int n : {3000, 30000, 1000000, 10000000, 30000000})
      if (n <= most) measure<float>(backend, time, n, 1);
    for (double contrast : {10.0, 100.0})
      if (most >= 1000000) measure<float>(backend, time, 1000000, contrast);
    for (int n : {3000, 1000000})
      if (n <= most) measure<double>(backend, time, n, 1);
  } catch (const Cuda_error& error) {
    std::printf("%s\n", error.what());
    return 77;
  }
}
