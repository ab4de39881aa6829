// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole runs from mesh to mesh in one process: milliseconds of each stage, medians of the runs
// after one to warm up; `--runs 0`: that one. Memory is that of the program
// (tools/memory_blocks.cpp).
//
//   whole_runs MODEL [--refine N] [--samples N,N,...] [--traits cpu|cuda] [--runs N]
//              [--density uniform|curvature] [--seed N] [--threads N]
//
// `--refine`: N times by Loop's subdivision. `--threads`: at most (default: all).
#include <CGAL/power_rtf_remeshing.h>
#ifdef CGAL_POWER_RTF_WITH_CUDA
#include <CGAL/PowerRTF/PowerRTF_cuda_traits_3.h>
#endif

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/subdivision_method_3.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/info.h>
#endif

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace CGAL::PowerRTF;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct Arguments {
  std::string model, traits = "cpu", density = "uniform";
  std::vector<std::size_t> samples = {3000};
  int refine = 0, runs = 5, threads = 0;
  unsigned seed = 0;
};

Arguments parse(int argc, char** argv)
{
  Arguments a;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word.rfind("--", 0) != 0) {
      a.model = word;
      continue;
    }
    if (++k >= argc) throw std::invalid_argument(word + " needs a value");
    const std::string value = argv[k];
    if (word == "--refine")
      a.refine = std::stoi(value);
    else if (word == "--runs")
      a.runs = std::stoi(value);
    else if (word == "--threads")
      a.threads = std::stoi(value);
    else if (word == "--seed")
      a.seed = unsigned(std::stoul(value));
    else if (word == "--traits")
      a.traits = value;
    else if (word == "--density")
      a.density = value;
    else if (word == "--samples") {
      a.samples.clear();
      std::stringstream list(value);
      for (std::string n; std::getline(list, n, ',');) a.samples.push_back(std::stoul(n));
    } else
      throw std::invalid_argument("what is " + word + "?");
  }
  if (a.model.empty()) throw std::invalid_argument("no MODEL");
  return a;
}

double median(std::vector<double> x)
{
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

template <class Traits>
void measure(const Arguments& a, const Mesh& mesh, std::size_t n)
{
  Remeshing_options options;
  options.density = a.density == "uniform" ? Density::uniform : Density::curvature;
  options.random_seed = a.seed;
  std::vector<Stage_seconds> runs;
  for (int run = 0; run <= a.runs; ++run) {
    Mesh out;
    const auto start = std::chrono::steady_clock::now();
    const Remeshing_report report = CGAL::power_rtf_remeshing(
        mesh, n, out, CGAL::PowerRTF::parameters::remeshing_options(options).geom_traits(Traits()));
    Stage_seconds seconds = report.seconds;
    seconds.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (run > 0 || a.runs == 0) runs.push_back(seconds);
  }
  std::printf("%-5s n %-9zu facets %-8zu", a.traits.c_str(), n, std::size_t(num_faces(mesh)));
  const auto print = [&](const char* name, double Stage_seconds::*stage) {
    std::vector<double> values;
    for (const Stage_seconds& s : runs) values.push_back(1e3 * (s.*stage));
    std::printf("  %s %.1f", name, median(values));
  };
  print("surface", &Stage_seconds::surface);
  print("sampling", &Stage_seconds::sampling);
  print("optimization", &Stage_seconds::optimization);
  print("extraction", &Stage_seconds::extraction);
  print("improvement", &Stage_seconds::improvement);
  print("quality", &Stage_seconds::quality);
  print("total", &Stage_seconds::total);
  std::printf("\n");
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
  try {
    const Arguments a = parse(argc, argv);
#ifdef CGAL_LINKED_WITH_TBB
    const tbb::global_control limit(
        tbb::global_control::max_allowed_parallelism,
        std::size_t(a.threads > 0 ? a.threads : tbb::info::default_concurrency()));
#endif
    Mesh mesh;
    if (!CGAL::IO::read_polygon_mesh(a.model, mesh))
      throw std::invalid_argument(a.model + ": cannot be read");
    if (a.refine > 0)
      CGAL::Subdivision_method_3::Loop_subdivision(
          mesh, CGAL::parameters::number_of_iterations(a.refine));
    for (const std::size_t n : a.samples)
      if (a.traits == "cpu") measure<CGAL::PowerRTF_traits_3<Kernel>>(a, mesh, n);
#ifdef CGAL_POWER_RTF_WITH_CUDA
      else if (a.traits == "cuda")
        measure<CGAL::PowerRTF_cuda_traits_3<Kernel>>(a, mesh, n);
#endif
      else
        throw std::invalid_argument("no traits " + a.traits);
    return 0;
  } catch (const std::exception& e) {
    std::cerr << "whole_runs: " << e.what() << '\n';
    return 1;
  }
}
