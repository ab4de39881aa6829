// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the program does where a GPU fails.
#ifdef CGAL_POWER_RTF_WITH_CUDA

#include "../../../tools/traits.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace {

struct Call {
  std::string traits, gpu_not_used;
  bool has_failed;
};

/// What is called for `traits` where the GPU fails in the middle of a run.
std::vector<Call> calls_with(const std::string& traits)
{
  CGAL::PowerRTF::Remeshing_options options;
  options.number_of_samples = 1000000000;
  std::vector<Call> calls;
  tools::with_traits(traits, options, [&](auto type, const std::string& why, bool has_failed) {
    calls.push_back({decltype(type)::type::name(), why, has_failed});
    if (calls.back().traits == "cuda") throw CGAL::PowerRTF::Cuda_error("the GPU is lost");
  });
  return calls;
}

} // namespace

TEST_CASE("where a GPU fails in the middle of a run, the CPU begins anew and knows why")
{
  const std::vector<Call> calls = calls_with("auto");
  REQUIRE(calls.size() == 2);
  CHECK(calls[0].traits == "cuda");
  CHECK_FALSE(calls[0].has_failed);
  CHECK(calls[1].traits == "cpu");
  CHECK(calls[1].has_failed);
  CHECK(calls[1].gpu_not_used == "the GPU is lost");
}

TEST_CASE("who wants the GPU only gets no other where it fails")
{
  CHECK_THROWS_WITH_AS(calls_with("cuda"),
                       doctest::Contains("the CUDA traits cannot be used: the GPU is lost"),
                       CGAL::PowerRTF::Cuda_error);
}

#endif
