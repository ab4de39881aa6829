// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stages on the GPU; said to be skipped where there is none. The neighbor search by itself:
// cuda_cells.cu; whole runs of more than a million: cuda_remeshing.cpp.
#include "Stage_benchmarks.h"
#include "stages.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/PowerRTF_cuda_traits_3.h>

#include <cuda_runtime_api.h>

#include <iostream>
#include <stdexcept>
#include <vector>

namespace {

struct Wait_for_device {
  void operator()() const
  {
    const cudaError_t error = cudaDeviceSynchronize();
    if (error != cudaSuccess) throw std::runtime_error(cudaGetErrorString(error));
  }
};

} // namespace

void register_cuda_stages()
{
  try {
    CGAL::PowerRTF::cuda_devices();
  } catch (const CGAL::PowerRTF::Cuda_error& error) {
    std::cerr << "skipped: the stages on a GPU (" << error.what() << ")\n";
    return;
  }
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Workload::Kind> kinds = Workload::kinds(1000000);
  for (const int n : {10000000, 30000000}) kinds.push_back({n, true, false});
  for (const Workload::Kind& kind : kinds)
    Stage_benchmarks<CGAL::PowerRTF_cuda_traits_3<Kernel>, Wait_for_device>::register_all(
        "gpu", kind, 1000000);
}
