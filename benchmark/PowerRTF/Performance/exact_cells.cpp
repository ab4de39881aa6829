// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cost of exactness: one construction of all cells by the fast path, by the fast path with
// certified combinatorics, and by the oracle, on even and on random samples of a sphere. Counters:
// seconds per cell; share of the oracle's predicates that its interval filter decides; share
// of the cells that the fast path's filter proves.
#include <CGAL/PowerRTF/engines/Exact_site_tree.h>
#include <CGAL/PowerRTF/engines/Spatial_order.h>

#include <benchmark/benchmark.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <random>
#include <vector>

namespace
{

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

template <class Tree>
void fill(Tree& tree, Sampling_kind kind, int n)
{
  const std::vector<Vec3d> points = sample(kind, n);
  tree.resize(n, kind == grid ? 2 : 2 * std::sqrt(12.57 / n));
  int i = 0;
  for (int k : internal::spatial_order(points)) {
    tree.sites[i] = {points[k], 0};
    tree.normals[i++] = kind == grid ? Vec3d{0, 0, 1} : normalized(points[k]);
  }
  tree.refit();
}

template <class Tree>
void construct(benchmark::State& state, Tree& tree)
{
  const int n = int(state.range(1));
  fill(tree, Sampling_kind(state.range(0)), n);
  const auto ignore = [](int, Cell_status status, const auto&, const auto&) {
    benchmark::DoNotOptimize(status);
  };
  tree.construct_cells(cos_angle, ignore); // the radii are known from here on
  for (auto _ : state) tree.construct_cells(cos_angle, ignore);
  state.counters["time_per_cell"] = benchmark::Counter(
      double(n), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void fast(benchmark::State& state)
{
  Filtered_site_tree<Tag> tree{Remeshing_options()};
  construct(state, tree);
}

void certified(benchmark::State& state)
{
  Remeshing_options options;
  options.certified_combinatorics = true;
  Filtered_site_tree<Tag> tree(options);
  construct(state, tree);
  int proved = 0;
  static_cast<Site_tree<Tag>&>(tree).construct_cells<true>(
      cos_angle, [&](int, Cell_status, const auto&, const auto&, bool certain) {
        proved += certain;
      });
  state.counters["proved"] = proved / double(state.range(1));
}

void exact(benchmark::State& state)
{
  Exact_site_tree<Kernel, Tag> tree{Remeshing_options()};
  construct(state, tree);
  const auto cells =
      internal::exact_cells<Kernel>(tree.view(), cos_angle, Exact_neighbours::automatic);
  Filter_statistics statistics;
  for (int i = 0; i < int(cells.size()); ++i) cells.cell(i, nullptr, &statistics);
  state.counters["filtered"] = statistics.filtered_share();
  state.counters["predicates_per_cell"] =
      double(statistics.filtered + statistics.exact) / double(cells.size());
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
