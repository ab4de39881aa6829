// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The three passes that a run on the CPU consists of, in double precision on one core: construction
// of all cells, neighbour search included; projection onto the surface; one pass of the weight rule
// with the construction that follows it. Even samples of a sphere. Counters: `per_cell`, seconds;
// `cells_per_second`; for the construction `ratio_to_limit`, the latter over the 0.7 million cells
// per second and core that this package promises (1 or more: kept).
#include <CGAL/PowerRTF/engines/Cpu_engine.h>
#include <CGAL/PowerRTF/surface/import_surface.h>

#include <benchmark/benchmark.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

namespace
{

using namespace CGAL::PowerRTF;
using Tag = CGAL::Sequential_tag;

constexpr double promised_rate = 0.7e6; // cells per second and core
constexpr double pi = 3.14159265358979323846;

/// Even samples of the sphere of radius 1/2 around the origin (Fibonacci's spiral), in the order
/// that trees ask for.
std::vector<Vec3d> even_samples(int n)
{
  std::vector<Vec3d> points, ordered;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - 2 * (i + 0.5) / n, r = std::sqrt(1 - z * z), t = i * 2.399963229728653;
    points.push_back(Vec3d{r * std::cos(t), r * std::sin(t), z} * 0.5);
  }
  for (int k : internal::spatial_order(points)) ordered.push_back(points[k]);
  return ordered;
}

/// The same sphere as a surface of 81920 facets.
Surface sphere()
{
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  CGAL::Surface_mesh<Point> mesh;
  CGAL::make_icosahedron<CGAL::Surface_mesh<Point>, Point>(mesh);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(6));
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    const Vec3d q = normalized(Vec3d{p.x(), p.y(), p.z()}) * 0.5;
    mesh.point(v) = Point(q.x, q.y, q.z);
  }
  Repair_counts repairs;
  Surface surface = import_surface(mesh, CGAL::parameters::default_values(), repairs);
  surface.vertex_density.assign(surface.points.size(), 1);
  return surface;
}

void count_cells(benchmark::State& state, int n)
{
  using benchmark::Counter;
  state.counters["cells_per_second"] = Counter(n, Counter::kIsIterationInvariantRate);
  state.counters["per_cell"] =
      Counter(n, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

void construction(benchmark::State& state)
{
  const int n = int(state.range(0));
  const std::vector<Vec3d> points = even_samples(n);
  Site_tree<Tag> tree;
  tree.resize(n, std::sqrt(pi / n)); // h, for the first pass
  for (int i = 0; i < n; ++i) {
    tree.sites[i] = {points[i], 0};
    tree.normals[i] = normalized(points[i]);
  }
  std::vector<Cell_moments<double>> moments(n);
  int bad = 0;
  const auto pass = [&]() {
    tree.refit(); // the samples have moved
    tree.construct_cells(compatibility_cosine(Remeshing_options().normal_angle),
                         [&](int i, Cell_status status, const Tangent_polygon<double>& polygon,
                             const Tangent_frame<double>&) {
                           moments[i] = cell_moments(polygon);
                           bad += status != Cell_status::ok;
                         });
  };
  pass(); // from here on the radii are known, as in all passes of a run but the first
  for (auto _ : state) pass();
  double area = 0;
  for (const auto& m : moments) area += m.area;
  if (bad > 0 || !(std::abs(area / pi - 1) < 10.0 / n))
    state.SkipWithError("the cells are not those of even samples of a sphere");
  count_cells(state, n);
  state.counters["ratio_to_limit"] = benchmark::Counter(
      n / promised_rate, benchmark::Counter::kIsIterationInvariantRate);
}

void projection(benchmark::State& state)
{
  const Surface surface = sphere();
  const Facet_tree tree(surface.points, surface.triangles);
  const int n = int(state.range(0));
  // A tenth of the spacing away from where the hint was found, as after a step.
  std::vector<Vec3d> targets = even_samples(n);
  std::vector<int> hints;
  const double step = 0.1 * std::sqrt(pi / n);
  for (int i = 0; i < n; ++i) {
    hints.push_back(tree.nearest(targets[i]).facet);
    const Tangent_frame<double> frame(normalized(targets[i]));
    targets[i] += frame.u * (step * std::cos(i)) + frame.v * (step * std::sin(i));
  }
  for (auto _ : state)
    for (int i = 0; i < n; ++i) benchmark::DoNotOptimize(tree.nearest(targets[i], hints[i]));
  count_cells(state, n);
}

void weight_pass(benchmark::State& state)
{
  const Surface surface = sphere();
  const Facet_tree tree(surface.points, surface.triangles);
  const int n = int(state.range(0));
  Samples samples;
  for (const Vec3d& p : even_samples(n)) {
    const Surface_point<double> q = tree.nearest(p);
    samples.points.push_back(q.point);
    samples.facets.push_back(q.facet);
  }
  Remeshing_options options;
  options.number_of_samples = n;
  options.capacity_tolerance = 0; // every weight changes
  Cpu_engine<Tag> engine(surface, options);
  engine.set_samples(samples);
  engine.build_cells();
  const auto pass = [&]() {
    engine.update_weights();
    engine.build_cells();
  };
  pass(); // D_i is found once per position step, of up to N_m^w passes
  for (auto _ : state) pass();
  if (engine.cell_counts().ok != samples.size()) state.SkipWithError("the weights diverge");
  count_cells(state, n);
}

void sizes(benchmark::internal::Benchmark* b)
{
  b->ArgName("n")->Unit(benchmark::kMillisecond);
  for (int n : {1000, 10000, 100000, 1000000}) b->Arg(n);
}

} // namespace

BENCHMARK(construction)->Apply(sizes);
BENCHMARK(projection)->Apply(sizes);
BENCHMARK(weight_pass)->Apply(sizes);

BENCHMARK_MAIN();
