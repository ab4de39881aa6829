// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: what the result is worth.
#include <CGAL/PowerRTF/quality/assess_impl.h>

#include <CGAL/tags.h>

namespace CGAL::PowerRTF {

template void assess<Sequential_tag>(const Surface&, const Extracted_mesh&, Remeshing_report&);
#ifdef CGAL_LINKED_WITH_TBB
template void assess<Parallel_tag>(const Surface&, const Extracted_mesh&, Remeshing_report&);
#endif

} // namespace CGAL::PowerRTF
