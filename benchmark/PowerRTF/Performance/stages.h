// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files of the benchmark `stages`, one for each traits class.
#ifndef POWER_RTF_BENCHMARK_STAGES_H
#define POWER_RTF_BENCHMARK_STAGES_H

#include <benchmark/benchmark.h>

void register_cpu_stages();
void register_exact_stages();
void register_cuda_stages();

#endif // POWER_RTF_BENCHMARK_STAGES_H
