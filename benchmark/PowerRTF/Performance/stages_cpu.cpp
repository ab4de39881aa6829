// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages of the fast CPU path, and those that run on the CPU whatever the traits.
#include "Stage_benchmarks.h"
#include "stages.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/PowerRTF_traits_3.h>
#include <CGAL/PowerRTF/engines/Facet_tree.h>
#include <CGAL/PowerRTF/engines/Site_tree.h>
#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/extraction/improve_mesh.h>
#include <CGAL/PowerRTF/surface/initial_sampling.h>

#include <cmath>
#include <vector>

namespace
{

using namespace CGAL::PowerRTF;

/// The six nearest of each sample, in a tree that is fitted to the samples anew.
template <class Tag>
void neighbour_search(benchmark::State& state, const Workload& w)
{
  const Peak_memory memory;
  Site_tree<Tag> tree;
  tree.resize(w.samples.size(), 0);
  std::size_t i = 0;
  for (const int k : internal::spatial_order(w.samples.points)) {
    tree.sites[i] = {w.samples.points[k], 0};
    tree.normals[i++] = w.samples.normals[k];
  }
  std::vector<double> distances(w.samples.size());
  for (auto _ : state) {
    tree.refit();
    internal::for_each_index<Tag>(int(distances.size()), [&](int j) {
      distances[j] = distance_to_neighbor(tree.view(), j, 6);
    });
    benchmark::DoNotOptimize(distances.data());
  }
  count(state, w.kind.n, memory);
}

/// To the nearest facet, from a tenth of the spacing beside the sample, its last facet known.
template <class Tag>
void projection(benchmark::State& state, const Workload& w)
{
  const Peak_memory memory;
  const Facet_tree tree(w.surface.points, w.surface.triangles);
  const double step = 0.1 * std::sqrt(w.surface.area / w.kind.n);
  std::vector<Vec3d> targets;
  std::vector<int> facets;
  for (const int k : internal::spatial_order(w.samples.points)) {
    const Tangent_frame<double> frame(w.samples.normals[k]);
    targets.push_back(w.samples.points[k] + frame.u * (step * std::cos(k)) +
                      frame.v * (step * std::sin(k)));
    facets.push_back(w.samples.facets[k]);
  }
  std::vector<Vec3d> result(targets.size());
  for (auto _ : state) {
    internal::for_each_index<Tag>(int(targets.size()), [&](int i) {
      result[i] = tree.nearest(targets[i], facets[i]).point;
    });
    benchmark::DoNotOptimize(result.data());
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
  register_stage("neighbour_search", "cpu", threads, kind, neighbour_search<Tag>);
  register_stage("projection", "cpu", threads, kind, projection<Tag>);
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
