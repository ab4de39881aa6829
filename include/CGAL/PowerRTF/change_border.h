// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The border of a region that is remeshed gets vertices as far apart as those of the region.
#ifndef CGAL_POWER_RTF_CHANGE_BORDER_H
#define CGAL_POWER_RTF_CHANGE_BORDER_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/features/Border_change.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>

namespace CGAL::PowerRTF::internal {

/// The soup `whole` with another border between `region` and the rest: its vertices are as far
/// apart as those that the region would have there if it were remeshed alone. See `Border_change`.
///
/// \param fields what is said about places of `whole`
/// \throws Invalid_input_error as `prepare_surface()`, of the region; and `options` asks for a
///   largest distance, of which no spacing follows
Changed_soup change_border(const Polygon_soup& whole, const Surface_fields& fields,
                           const Soup_region& region, const Remeshing_options& options,
                           Concurrency concurrency = Sequential_tag());

} // namespace CGAL::PowerRTF::internal

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/change_border_impl.h>
#endif

#endif // CGAL_POWER_RTF_CHANGE_BORDER_H
