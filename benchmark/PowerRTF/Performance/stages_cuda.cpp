// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Stage_benchmarks.h"
#include "stages.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/PowerRTF_cuda_traits_3.h>

void register_cuda_stages()
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  for (const Workload::Kind& kind : Workload::kinds(1000000))
    Stage_benchmarks<CGAL::PowerRTF_cuda_traits_3<Kernel>>::register_all("gpu", kind, 1000000);
}
