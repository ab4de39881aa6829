// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages of the fast CPU path, and those that run on the CPU whatever the traits.
#include "Stage_benchmarks.h"
#include "stages.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/PowerRTF_traits_3.h>
#include <CGAL/PowerRTF/cells/Tree_cells.h>
#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/improvement/improve_mesh.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <vector>

namespace {

using namespace CGAL::PowerRTF;

/// The six nearest of each sample, in a tree that is fitted to the samples anew.
template <class Tag>
void neighbor_search(benchmark::State& state, const Workload& w)
{
  const Peak_memory memory;
  const int n = int(w.samples.size());
  Owned_sites sites;
  for (const int k : internal::spatial_order(w.samples.points))
    sites.add(w.samples.points[k], w.samples.normals[k], 0);
  Host_backend<Tag> backend;
  Tree_cells<double, Host_backend<Tag>> cells(backend, n, -2, 0, {});
  std::vector<double> distances(n);
  for (auto _ : state) {
    cells.set_sites(sites.arrays());
    backend.for_each(n, [&](int j) { distances[j] = distance_to_neighbor(cells.view(), j, 6); });
    benchmark::DoNotOptimize(distances.data());
  }
  count(state, w.kind.n, memory);
}

void sampling(benchmark::State& state, const Workload& w)
{
  const Peak_memory memory;
  for (auto _ : state) benchmark::DoNotOptimize(sample_surface(w.surface, w.options));
  count(state, w.kind.n, memory);
}

void extraction(benchmark::State& state, const Workload& w)
{
  const Peak_memory memory;
  for (auto _ : state) benchmark::DoNotOptimize(extract_by_insertion(w.surface, w.samples));
  count(state, w.kind.n, memory);
}

void improvement(benchmark::State& state, const Workload& w)
{
  const Extracted_mesh raw = extract_by_insertion(w.surface, w.samples);
  const Peak_memory memory;
  for (auto _ : state) {
    state.PauseTiming();
    Extracted_mesh mesh = raw;
    state.ResumeTiming();
    benchmark::DoNotOptimize(improve_mesh(w.surface, mesh));
  }
  count(state, w.kind.n, memory);
}

template <class Tag>
void register_for(const std::string& threads, const Workload::Kind& kind)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  register_stage("neighbor_search", "cpu", threads, kind, neighbor_search<Tag>);
  Stage_benchmarks<CGAL::PowerRTF_traits_3<Kernel, Tag>>::register_all(threads, kind, 1000000);
}

} // namespace

void register_cpu_stages()
{
  for (const Workload::Kind& kind : Workload::kinds(1000000)) {
    register_for<CGAL::Sequential_tag>("1", kind);
    register_for<CGAL::Parallel_if_available_tag>("all", kind);
    register_stage("sampling", "cpu", "1", kind, sampling);
    register_stage("extraction", "cpu", "1", kind, extraction);
    if (kind.regular) register_stage("improvement", "cpu", "1", kind, improvement);
  }
}
