// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The memory that a run takes on a GPU, as it is told before. (Without the cells, on the host:
// test_device_memory.cpp.)
#include "../engine_comparison.h"

#ifdef CGAL_POWER_RTF_WITH_CUDA

#include <CGAL/PowerRTF/engines/Cuda_engine.h>

#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

using namespace engine_comparison;

namespace {

std::vector<Case> memory_cases()
{
  const shapes::Soup torus = shapes::torus(96, 48, 1, 0.3);
  std::vector<Case> all;
  for (const bool paper : {false, true})
    for (const Density density : {Density::uniform, Density::curvature})
      for (const Sampling sampling : {Sampling::lattice, Sampling::stratified}) {
        all.push_back({paper ? "paper" : "quality", torus, options_of(paper, density, 60000)});
        all.back().options.sampling = sampling; // the lattice takes most
      }
  all.push_back({"more than threads", torus, options_of(false, Density::uniform, 400000)});
  all.back().options.sampling = Sampling::stratified;
  all.push_back(
      {"facets", shapes::torus(600, 300, 1, 0.3), options_of(true, Density::uniform, 5000)});
  return all;
}

template <class Real>
void check_memory(const Case& c, Cuda_precision precision)
{
  CAPTURE(c.name);
  const Start start(c);
  const std::size_t taken = memory_of_run<Cuda_engine<Real>>(c, start);
  const std::size_t told = cuda_memory(sizes_of(c, start), c.options, precision);
  const double ratio = double(taken) / double(told);
  std::cout << c.name << ": " << taken << " bytes, "
            << double(taken) / double(c.options.number_of_samples) << " a sample, told " << told
            << ", ratio " << ratio << '\n';
  CHECK(ratio >= 0.99);
  CHECK(ratio <= 1.1);
}

/// How many samples would fit, as those hear who ask for too many.
std::size_t samples_that_fit(const Case& c, const Surface& surface)
{
  try {
    Cuda_engine<float>(surface, c.options);
  } catch (const Cuda_error& e) {
    const std::string said = e.what();
    MESSAGE(said);
    CHECK(said.find("the memory of the GPU does not suffice") == 0);
    CHECK(said.find(std::to_string(c.options.number_of_samples) + " samples") != std::string::npos);
    const std::size_t end = said.find(" samples would fit");
    REQUIRE(end != std::string::npos);
    return std::strtoull(said.c_str() + said.rfind(' ', end - 1) + 1, nullptr, 10);
  }
  return 0;
}

} // namespace

TEST_CASE("the memory that a run takes is what was told before")
{
  for (const Case& c : memory_cases()) check_memory<float>(c, Cuda_precision::single_precision);
  check_memory<double>(memory_cases()[1], Cuda_precision::double_precision);
}

TEST_CASE("what does not fit is refused before the run, with what would fit")
{
  Case c = cases()[0];
  const Start start(c);
  const Surface& surface = start.patches->surface();
  c.options.number_of_samples = 1000000000;
  const std::size_t most = samples_that_fit(c, surface);
  REQUIRE(most > 1000000);
  c.options.number_of_samples = most - most / 100; // others may use the GPU, too
  CHECK_NOTHROW(Cuda_engine<float>(surface, c.options));
  c.options.number_of_samples = most + most / 100;
  CHECK_THROWS_AS(Cuda_engine<float>(surface, c.options), Cuda_error);
}

#endif
