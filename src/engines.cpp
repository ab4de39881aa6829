// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: the engines of the default traits.
#include <CGAL/PowerRTF/PowerRTF_traits_3.h>
#include <CGAL/PowerRTF/engines/Host_engine_impl.h>
#include <CGAL/PowerRTF/exact/Exact_construction.h>

namespace CGAL::PowerRTF {

template struct Make_host_engine<double, Filtered_construction, Sequential_tag>;
#ifdef CGAL_LINKED_WITH_TBB
template struct Make_host_engine<double, Filtered_construction, Parallel_tag>;
#endif

} // namespace CGAL::PowerRTF
