// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cost of exactness: one construction of all cells by the fast path, by the fast path with
// certified combinatorics, and by the oracle, on even and on random samples of a sphere. Counters:
// seconds per cell; share of the oracle's predicates that its interval filter decides; share
// of the cells that the fast path's filter proves.
#include <CGAL/PowerRTF/exact/Exact_construction.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>

#include <benchmark/benchmark.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace CGAL::PowerRTF;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Tag = CGAL::Sequential_tag;

constexpr double cos_angle = -0.766; // Theta = 140 degrees

enum Sampling_kind { even, random, grid };

std::vector<Vec3d> sample(Sampling_kind kind, int n)
{
  std::vector<Vec3d> points;
  std::mt19937_64 engine(1);
  std::normal_distribution<double> d;
  const int side = int(std::sqrt(double(n)));
  for (int i = 0; i < n; ++i) {
    const double z = 1 - 2 * (i + 0.5) / n, r = std::sqrt(1 - z * z), t = i * 2.399963229728653;
    if (kind == even) points.push_back({r * std::cos(t), r * std::sin(t), z});
    if (kind == random) points.push_back(normalized(Vec3d{d(engine), d(engine), d(engine)}));
    if (kind == grid) points.push_back({double(i % side), double(i / side), 0});
  }
  return points;
}

using Backend = Host_backend<Tag>;
template <class Construction>
using Cells = Tree_cells<double, Backend, Construction>;

/// Constructs the cells and hands them to `and_then(cells)` when all is measured.
template <class Construction, class AndThen>
void construct(benchmark::State& state, const Remeshing_options& options, AndThen&& and_then)
{
  const Sampling_kind kind = Sampling_kind(state.range(0));
  const int n = int(state.range(1));
  const std::vector<Vec3d> points = sample(kind, n);
  Owned_sites sites;
  for (const int k : internal::spatial_order(points))
    sites.add(points[k], kind == grid ? Vec3d{0, 0, 1} : normalized(points[k]), 0);
  Backend backend;
  Cells<Construction> cells(backend, n, cos_angle, kind == grid ? 2 : 2 * std::sqrt(12.57 / n),
                            options);
  cells.set_sites(sites.arrays());
  const auto ignore = [](int, Cell_status status, const auto&, const auto&) {
    benchmark::DoNotOptimize(status);
  };
  cells.for_each_cell(ignore); // the radii are known from here on
  for (auto _ : state) cells.for_each_cell(ignore);
  state.counters["time_per_cell"] = benchmark::Counter(
      double(n), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  and_then(cells);
}

void fast(benchmark::State& state)
{
  construct<Filtered_construction>(state, {}, [](auto&) {});
}

void certified(benchmark::State& state)
{
  Remeshing_options options;
  options.certified_combinatorics = true;
  construct<Filtered_construction>(state, options, [&](auto& cells) {
    int proved = 0;
    cells.template construct_by_leaves<true>(
        [&](int, Cell_status, const auto&, const auto&, bool certain) { proved += certain; });
    state.counters["proved"] = proved / double(state.range(1));
  });
}

void exact(benchmark::State& state)
{
  construct<Exact_construction<Kernel>>(state, {}, [&](auto& cells) {
    auto oracle = internal::exact_cells<Kernel>(cells.view(), cos_angle);
    oracle.triangulate();
    Filter_statistics statistics;
    for (int i = 0; i < int(oracle.size()); ++i) oracle.cell(i, nullptr, &statistics);
    state.counters["filtered"] = statistics.filtered_share();
    state.counters["predicates_per_cell"] =
        double(statistics.filtered + statistics.exact) / double(oracle.size());
  });
}

void arguments(benchmark::internal::Benchmark* b)
{
  b->ArgNames({"sampling", "n"})->Unit(benchmark::kMillisecond);
  for (Sampling_kind kind : {even, random}) b->Args({kind, 10000});
}

} // namespace

BENCHMARK(fast)->Apply(arguments);
BENCHMARK(certified)->Apply(arguments);
BENCHMARK(exact)->Apply(arguments);
// All ties: the worst case of every filter.
BENCHMARK(fast)->Args({grid, 900});
BENCHMARK(certified)->Args({grid, 900});
BENCHMARK(exact)->Args({grid, 900});

BENCHMARK_MAIN();
