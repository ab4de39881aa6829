// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: the engines of the exact traits, for the usual kernel.
#include <CGAL/PowerRTF/PowerRTF_exact_traits_3.h>
#include <CGAL/PowerRTF/exact/Power_neighbors_impl.h>

namespace CGAL::PowerRTF {

template struct Make_host_engine<
    double, Exact_construction<Exact_predicates_inexact_constructions_kernel>, Sequential_tag>;
#ifdef CGAL_LINKED_WITH_TBB
template struct Make_host_engine<
    double, Exact_construction<Exact_predicates_inexact_constructions_kernel>, Parallel_tag>;
#endif

} // namespace CGAL::PowerRTF
