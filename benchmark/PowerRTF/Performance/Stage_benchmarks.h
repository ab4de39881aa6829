// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Benchmarks of the stages that a traits class runs: construction, weights, positions, and whole
// runs. A file for each traits class registers them, see stages_cpu.cpp. Names read
// stage/traits/threads/samples/density/n, e.g. construction/cpu/1/regular/uniform/1000.
#ifndef POWER_RTF_BENCHMARK_STAGE_BENCHMARKS_H
#define POWER_RTF_BENCHMARK_STAGE_BENCHMARKS_H

#include "Peak_memory.h"
#include "Workload.h"

#include <CGAL/PowerRTF/Remeshing_visitor.h>
#include <CGAL/PowerRTF_remesher.h>

#include <benchmark/benchmark.h>

#include <string>

/// What is registered: a function per stage, with how many iterations it takes (0: as many as fill
/// the time).
using Stage_function = void (*)(benchmark::State&, const Workload&);

/// Registers a stage for a workload. `threads`: "1" (then CPU time counts) or "all" (then real time
/// does).
inline void register_stage(const std::string& stage, const std::string& traits,
                           const std::string& threads, const Workload::Kind& kind,
                           Stage_function function, int iterations = 0)
{
  const std::string name = stage + '/' + traits + '/' + threads + '/' + kind.name();
  auto* b = benchmark::RegisterBenchmark(
      name.c_str(), [=](benchmark::State& state) { function(state, Workload::get(kind)); });
  b->Unit(benchmark::kMillisecond);
  if (threads != "1") b->MeasureProcessCPUTime()->UseRealTime();
  if (iterations > 0) b->Iterations(iterations);
}

/// Counters: samples per second, and bytes of memory per sample above what there was before.
inline void count(benchmark::State& state, int n, const Peak_memory& memory)
{
  using benchmark::Counter;
  state.counters["per_second"] = Counter(n, Counter::kIsIterationInvariantRate);
  if (memory.known()) state.counters["bytes_per_sample"] = Counter(memory.bytes() / n);
}

struct Nothing_to_wait_for {
  void operator()() const {}
};

/// The stages of one traits class. `Wait`: until what has been asked of the device is done.
template <class Traits, class Wait = Nothing_to_wait_for>
struct Stage_benchmarks {
  using Engine = typename Traits::Engine;

  /// All cells. Engines make them when something is asked of them: the statistics that every run
  /// asks for are part of it.
  static void build_cells(Engine& engine)
  {
    engine.build_cells();
    engine.capacity();
  }

  /// The counters of a stage; the memory of a device is the device's.
  static void count(benchmark::State& state, int n, const Engine& engine, const Peak_memory& memory)
  {
    ::count(state, n, memory);
    if (const std::size_t bytes = engine.device_report().bytes)
      state.counters["bytes_per_sample"] = benchmark::Counter(double(bytes) / n);
  }

  /// Algorithm 1, neighbor search included. The radii of the searches are known from the last
  /// construction, as in all of a run but the first.
  static void construction(benchmark::State& state, const Workload& w)
  {
    const Peak_memory memory;
    Engine engine(w.surface, w.options);
    engine.set_samples(w.samples);
    build_cells(engine);
    for (auto _ : state) build_cells(engine);
    if (w.kind.regular && engine.cell_counts().ok != w.samples.size())
      state.SkipWithError("some cells of regular samples are not certified");
    count(state, w.kind.n, engine, memory);
  }

  /// A pass of the paper's rule (Algorithm 2), with the construction that follows it.
  static void weight_pass(benchmark::State& state, const Workload& w)
  {
    const Peak_memory memory;
    CGAL::PowerRTF::Remeshing_options options = w.options;
    options.capacity_tolerance = 0.04;
    options.weight_method = CGAL::PowerRTF::Weight_method::multiplicative;
    Engine engine(w.surface, options);
    engine.set_samples(w.samples);
    build_cells(engine);
    for (auto _ : state) engine.optimize_weights(1);
    count(state, w.kind.n, engine, memory);
  }

  /// A step of Newton's method on the weights, from weights 0: edges, linear system, constructions.
  static void newton_step(benchmark::State& state, const Workload& w)
  {
    const Peak_memory memory;
    Engine engine(w.surface, w.options);
    for (auto _ : state) {
      state.PauseTiming();
      engine.set_samples(w.samples);
      build_cells(engine);
      state.ResumeTiming();
      benchmark::DoNotOptimize(engine.newton_weights());
    }
    count(state, w.kind.n, engine, memory);
  }

  /// A step of L-BFGS with its projection onto the surface and the samples' new attributes.
  static void position_step(benchmark::State& state, const Workload& w)
  {
    step(state, w, CGAL::PowerRTF::Position_method::lbfgs);
  }

  /// Back to the surface after a step to the center of mass, with the samples' new attributes.
  static void projection(benchmark::State& state, const Workload& w)
  {
    step(state, w, CGAL::PowerRTF::Position_method::lloyd);
  }

  /// All of a run but reading and writing files: sampling, optimization, extraction, improvement,
  /// and the assessment of the result.
  static void whole_run(benchmark::State& state, const Workload& w)
  {
    const Peak_memory memory;
    std::size_t constructions = 0;
    for (auto _ : state) {
      CGAL::PowerRTF_remesher<Traits> remesher(w.surface, w.options);
      CGAL::PowerRTF::Remeshing_default_visitor visitor;
      remesher.optimize(visitor);
      benchmark::DoNotOptimize(remesher.extract(visitor));
      constructions = remesher.report().constructions;
    }
    ::count(state, w.kind.n, memory);
    state.counters["constructions"] = benchmark::Counter(double(constructions));
  }

  /// Registers all of them; whole runs up to `largest_run` samples.
  static void register_all(const std::string& threads, const Workload::Kind& kind, int largest_run)
  {
    const std::string traits = Traits::name();
    register_stage("construction", traits, threads, kind, construction);
    register_stage("weight_pass", traits, threads, kind, weight_pass);
    register_stage("newton_step", traits, threads, kind, newton_step);
    register_stage("position_step", traits, threads, kind, position_step);
    register_stage("projection", traits, threads, kind, projection);
    // the kind of samples is where the stages start from; a run makes its own
    if (kind.regular && kind.n <= largest_run)
      register_stage("whole_run", traits, threads, kind, whole_run, 1);
  }

private:
  static void step(benchmark::State& state, const Workload& w,
                   CGAL::PowerRTF::Position_method method)
  {
    const Peak_memory memory;
    Engine engine(w.surface, w.options);
    engine.set_samples(w.samples);
    for (auto _ : state) {
      state.PauseTiming();
      build_cells(engine);
      state.ResumeTiming();
      engine.move_samples(method);
      Wait()();
    }
    count(state, w.kind.n, engine, memory);
  }
};

#endif // POWER_RTF_BENCHMARK_STAGE_BENCHMARKS_H
