// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fast CPU engine, sequential or with TBB.
#ifndef CGAL_POWER_RTF_ENGINES_CPU_ENGINE_H
#define CGAL_POWER_RTF_ENGINES_CPU_ENGINE_H

#include <CGAL/PowerRTF/engines/Exact_site_tree.h>
#include <CGAL/PowerRTF/engines/Host_engine.h>

namespace CGAL {
namespace PowerRTF {

/// \ingroup PkgPowerRTFTraits
/// Cells by a search in a tree, in double precision.
///
/// \cgalModels `PowerRTFEngine`
template <class ConcurrencyTag>
using Cpu_engine = Host_engine<Filtered_site_tree<ConcurrencyTag>, ConcurrencyTag>;

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_ENGINES_CPU_ENGINE_H
