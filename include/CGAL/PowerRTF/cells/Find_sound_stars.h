// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CELLS_FIND_SOUND_STARS_H
#define CGAL_POWER_RTF_CELLS_FIND_SOUND_STARS_H

#include <CGAL/PowerRTF/cells/Cell_triangles.h>
#include <CGAL/PowerRTF/geometry/Surface_walk.h>

#include <functional>

namespace CGAL::PowerRTF {

/// Writes, where an engine works, for each cell whether its triangles are sound for sure: the cells
/// at their corners agree on all of them, and they lie well; see `Cell_triangles`. Those at samples
/// without a cell are left to the caller. Returns `false` where it does nothing.
using Find_sound_stars = std::function<bool(const Surface& surface, const Cell_triangles& triangles,
                                            unsigned char* is_sound)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_FIND_SOUND_STARS_H
