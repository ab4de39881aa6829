// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All stages of the remesher, for each traits class. performance.py runs this and makes tables and
// plots; by hand: stages --benchmark_filter='construction/cpu/1/.*'
#include "stages.h"

int main(int argc, char** argv)
{
  register_cpu_stages();
  register_exact_stages();
#ifdef POWER_RTF_HAS_CUDA_BENCHMARK
  register_cuda_stages();
#endif
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
