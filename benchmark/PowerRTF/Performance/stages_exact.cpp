// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Stage_benchmarks.h"
#include "stages.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/PowerRTF_exact_traits_3.h>

void register_exact_stages()
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  for (const Workload::Kind& kind : Workload::kinds(100000))
    Stage_benchmarks<CGAL::PowerRTF_exact_traits_3<Kernel>>::register_all("1", kind, 1000);
}
