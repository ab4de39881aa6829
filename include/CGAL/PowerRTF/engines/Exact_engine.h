// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exact engine: the steps of the CPU engine over cells whose combinatorics are exact.
#ifndef CGAL_POWER_RTF_ENGINES_EXACT_ENGINE_H
#define CGAL_POWER_RTF_ENGINES_EXACT_ENGINE_H

#include <CGAL/PowerRTF/engines/Exact_site_tree.h>
#include <CGAL/PowerRTF/engines/Host_engine.h>

namespace CGAL {
namespace PowerRTF {

/// \ingroup PkgPowerRTFTraits
/// Cells by exact predicates. Which neighbors bound each cell, and which cells are empty, is exact
/// for the current samples, weights and normals as doubles; areas, centroids and all steps are double
/// arithmetic.
///
/// \cgalModels `PowerRTFEngine`
template <class Kernel, class ConcurrencyTag>
using Exact_engine = Host_engine<Exact_site_tree<Kernel, ConcurrencyTag>, ConcurrencyTag>;

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_ENGINES_EXACT_ENGINE_H
