// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole optimizations on the GPU, extraction excluded: seconds on the device (median of the runs
// after one to warm up) and memory.
//
//   cuda_remeshing MODEL [--refine N] [--samples N,N,...] [--preset quality|paper]
//                  [--density uniform|curvature] [--seed N] [--runs N] [--iterations N]
//                  [--cpu] [--check] [--meshes SEEDS]
//
// MODEL is an OFF file; `--refine`: N times by Loop's subdivision. `--cpu`: the same work on this
// machine's CPU, too. `--check`: what the oracle says of the cells of the first iteration, the one
// in the middle and the last. `--meshes`: the least and largest figures of the meshes that the
// GPU's and the CPU's samples make, over so many seeds. From 200 000 samples on, the first samples
// are stratified random ones instead of those of a lattice, which takes the host long.
#include <CGAL/PowerRTF/PowerRTF_cuda_traits_3.h>
#include <CGAL/PowerRTF/PowerRTF_traits_3.h>
#include <CGAL/PowerRTF/exact/check_cells.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/input/import_surface.h>
#include <CGAL/PowerRTF_remesher.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace CGAL::PowerRTF;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Gpu = CGAL::PowerRTF_cuda_traits_3<Kernel>;
using Cpu = CGAL::PowerRTF_traits_3<Kernel>;

struct Arguments {
  std::string model, preset = "quality", density = "uniform";
  std::vector<std::size_t> samples = {3000};
  int refine = 0, runs = 5, iterations = -1, meshes = 0;
  unsigned seed = 0;
  bool cpu = false, check = false;
};

Arguments parse(int argc, char** argv)
{
  Arguments a;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const auto value = [&]() -> std::string {
      if (++k >= argc) throw Invalid_input_error(word + " needs a value");
      return argv[k];
    };
    if (word == "--refine")
      a.refine = std::stoi(value());
    else if (word == "--runs")
      a.runs = std::stoi(value());
    else if (word == "--iterations")
      a.iterations = std::stoi(value());
    else if (word == "--meshes")
      a.meshes = std::stoi(value());
    else if (word == "--seed")
      a.seed = unsigned(std::stoul(value()));
    else if (word == "--preset")
      a.preset = value();
    else if (word == "--density")
      a.density = value();
    else if (word == "--cpu")
      a.cpu = true;
    else if (word == "--check")
      a.check = true;
    else if (word == "--samples") {
      a.samples.clear();
      std::stringstream list(value());
      for (std::string n; std::getline(list, n, ',');) a.samples.push_back(std::stoul(n));
    } else if (a.model.empty())
      a.model = word;
    else
      throw Invalid_input_error("what is " + word + "?");
  }
  if (a.model.empty()) throw Invalid_input_error("no MODEL");
  return a;
}

/// Compares the cells of some iterations with the exact ones.
struct Checking_visitor : Remeshing_default_visitor {
  CGAL::PowerRTF_remesher<Gpu>& gpu;
  std::size_t middle;

  Checking_visitor(CGAL::PowerRTF_remesher<Gpu>& gpu, std::size_t middle) : gpu(gpu), middle(middle)
  {}
  void on_iteration(const Iteration_report&, double)
  {
    const std::size_t done = gpu.report().outer_iterations;
    if (done == 1) check("start");
    if (done == middle) check("middle");
  }
  void check(const char* when)
  {
    const Remeshing_options& o = gpu.options();
    const Cell_comparison c = check_cells<CGAL::Parallel_if_available_tag>(
        gpu.sites(), gpu.cells(), compatibility_cosine(o.normal_angle),
        std::numeric_limits<float>::epsilon(), o.guard_factor);
    std::printf("  check: %-6s  wrong %zu  uncertified %zu + %zu  differing edges %zu  "
                "area p99 %.1e max %.1e  centroid p99 %.1e max %.1e\n",
                when, c.certified_wrong, c.uncertified_right, c.uncertified_wrong,
                c.differing_edges, c.area.p99, c.area.max, c.centroid.p99, c.centroid.max);
    std::fflush(stdout);
  }
};

/// The least and largest figures of the meshes over `seeds` seeds.
template <class Traits>
void describe_meshes(const char* name, const Surface& surface, Remeshing_options o, int seeds)
{
  struct Range {
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    void add(double x)
    {
      least = std::min(least, x);
      largest = std::max(largest, x);
    }
  } q_min, q_avg, theta, mean, rms, max;
  std::size_t met = 0;
  Remeshing_default_visitor visitor;
  for (int seed = 0; seed < seeds; ++seed) {
    o.random_seed = unsigned(seed);
    CGAL::PowerRTF_remesher<Traits> remesher(surface, o);
    remesher.optimize(visitor);
    remesher.extract(visitor);
    const Remeshing_report& r = remesher.report();
    q_min.add(r.quality.q_min);
    q_avg.add(r.quality.q_avg);
    theta.add(r.quality.theta_min);
    mean.add(r.distance.mean);
    rms.add(r.distance.rms);
    max.add(r.distance.max);
    met += r.missed_guarantees().empty();
  }
  std::printf("  mesh: %s  Q_min %.3f-%.3f  Q_avg %.4f-%.4f  theta_min %.1f-%.1f  distance: mean "
              "%.4f-%.4f  RMS %.4f-%.4f  max %.3f-%.3f  all guarantees met: %zu of %d\n",
              name, q_min.least, q_min.largest, q_avg.least, q_avg.largest, theta.least,
              theta.largest, mean.least, mean.largest, rms.least, rms.largest, max.least,
              max.largest, met, seeds);
  std::fflush(stdout);
}

double median(std::vector<double> x)
{
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

void measure(const Arguments& a, const Mesh& mesh, std::size_t n)
{
  Remeshing_options o =
      a.preset == "paper" ? Remeshing_options::paper_preset() : Remeshing_options();
  o.number_of_samples = n;
  o.density = a.density == "uniform" ? Density::uniform : Density::curvature;
  o.feature_angle = 180;
  o.random_seed = a.seed;
  if (a.iterations >= 0) o.max_iterations = a.iterations;
  if (n >= 200000) o.sampling = Sampling::stratified;
  Repair_counts repairs;
  Surface surface = import_surface(mesh, CGAL::parameters::default_values(), repairs);
  set_density(surface, o);

  Remeshing_default_visitor visitor;
  CGAL::PowerRTF_remesher<Gpu> gpu(surface, o);
  std::vector<double> seconds, walls;
  for (int run = 0; run <= a.runs; ++run) {
    const double before = gpu.report().seconds.optimization;
    gpu.optimize(visitor);
    if (run == 0 && a.runs > 0) continue; // to warm up
    seconds.push_back(gpu.report().device.seconds);
    walls.push_back(gpu.report().seconds.optimization - before);
  }
  const Remeshing_report& r = gpu.report();
  std::printf("%-8s %-9s n %-9zu facets %-8zu gpu %9.2f ms  wall %9.2f ms  %5.2f GB  constructions "
              "%4zu  displacement %.4f  inside %.4f  cells %zu %zu %zu %zu",
              a.preset.c_str(), a.density.c_str(), n, surface.triangles.size(),
              1e3 * median(seconds), 1e3 * median(walls), double(r.device.bytes) * 1e-9,
              r.constructions, r.iterations.back().displacement, r.capacity.inside_interval,
              r.cells.ok, r.cells.guarded, r.cells.empty, r.cells.incomplete);
  std::fflush(stdout);
  if (a.cpu) {
    CGAL::PowerRTF_remesher<Cpu> cpu(surface, o);
    cpu.optimize(visitor);
    const Remeshing_report& c = cpu.report();
    std::printf("  cpu %9.2f ms (x %.0f, displacement %.4f, inside %.4f, constructions %zu)",
                1e3 * c.seconds.optimization, c.seconds.optimization / median(seconds),
                c.iterations.back().displacement, c.capacity.inside_interval, c.constructions);
  }
  std::printf("\n");
  std::fflush(stdout);
  if (a.check) {
    Checking_visitor checks(gpu, (r.outer_iterations + 1) / 2);
    gpu.optimize(checks);
    checks.check("end");
  }
  if (a.meshes > 0) {
    describe_meshes<Gpu>("gpu", surface, o, a.meshes);
    describe_meshes<Cpu>("cpu", surface, o, a.meshes);
  }
}

} // namespace

int main(int argc, char** argv)
{
  try {
    const Arguments a = parse(argc, argv);
    Mesh mesh;
    if (!CGAL::IO::read_OFF(a.model, mesh)) throw Invalid_input_error(a.model + ": cannot be read");
    if (a.refine > 0)
      CGAL::Subdivision_method_3::Loop_subdivision(
          mesh, CGAL::parameters::number_of_iterations(a.refine));
    std::cout << a.model << " on " << cuda_devices().at(0).name << std::endl;
    for (std::size_t n : a.samples) measure(a, mesh, n);
    return 0;
  } catch (const Cuda_error& e) {
    std::cout << "skipped: " << e.what() << '\n';
    return 77;
  } catch (const std::exception& e) {
    std::cerr << "cuda_remeshing: " << e.what() << '\n';
    return 1;
  }
}
