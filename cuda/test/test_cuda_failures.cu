// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is said where a GPU cannot be used. This needs none.
#include "../backend/failures.h"

#include <CGAL/PowerRTF/engines/Cuda_engine_api.h>

#include <doctest/doctest.h>

#include <map>
#include <string>

using namespace CGAL::PowerRTF;
using namespace CGAL::PowerRTF::device;

TEST_CASE("each way to fail has words of its own, and what the runtime says")
{
  const std::map<cudaError_t, const char*> words{
      {cudaErrorNoKernelImageForDevice, "this program has no code for the GPU"},
      {cudaErrorInvalidDeviceFunction, "this program has no code for the GPU"},
      {cudaErrorDevicesUnavailable, "the GPU is busy"},
      {cudaErrorECCUncorrectable, "the GPU is lost to this process"},
      {cudaErrorLaunchFailure, "the GPU is lost to this process"},
      {cudaErrorIllegalAddress, "the GPU is lost to this process"},
      {cudaErrorUnsupportedPtxVersion, "the driver of the GPU is too old"},
      {cudaErrorSystemNotReady, "the GPU's driver is not ready"},
      {cudaErrorInvalidValue, "the GPU failed"}};
  for (const auto& [code, begin] : words) {
    const std::string message = failure(code, "starting a kernel");
    CHECK(message.find(begin) == 0);
    CHECK(message.find("starting a kernel") != std::string::npos);
    CHECK(message.find(cudaGetErrorString(code)) != std::string::npos);
  }
}

TEST_CASE("where there is no code for a GPU, it is said what there is code for")
{
  const std::string message = failure(cudaErrorNoKernelImageForDevice, "starting a kernel");
  constexpr int architectures[] = {__CUDA_ARCH_LIST__};
  for (const int a : architectures)
    CHECK(message.find(std::to_string(a / 100) + "." + std::to_string(a / 10 % 10)) !=
          std::string::npos);
}

TEST_CASE("no driver, one too old, and no GPU are told apart")
{
  CHECK(reason_for_none(cudaErrorNoDevice, 0, 0, 13000).find("no driver") == 0);
  const std::string old = reason_for_none(cudaErrorInsufficientDriver, 0, 11040, 13000);
  CHECK(old.find("too old") != std::string::npos);
  CHECK(old.find("11.4") != std::string::npos);
  CHECK(old.find("13.0") != std::string::npos);
  CHECK(reason_for_none(cudaErrorNoDevice, 0, 13000, 13000).find("no GPU") == 0);
  CHECK(reason_for_none(cudaSuccess, 0, 13000, 13000).find("no GPU") == 0);
  CHECK(reason_for_none(cudaErrorSystemNotReady, 0, 13000, 13000).find("not ready") !=
        std::string::npos);
  CHECK(reason_for_none(cudaSuccess, 1, 13000, 13000).empty());
}

TEST_CASE("a call that fails throws the words, one that does not throws nothing")
{
  CHECK_NOTHROW(check(cudaSuccess, "clock"));
  CHECK_THROWS_WITH_AS(check(cudaErrorDevicesUnavailable, "clock"), doctest::Contains("busy"),
                       Cuda_error);
}

TEST_CASE("a GPU that cannot be started ahead fails only where it is used")
{
  constexpr int device = 1000; // there are not so many
  CHECK_NOTHROW(start_cuda_device(device).get());
  CHECK_THROWS_AS(release_cuda_memory(device), Cuda_error);
}
