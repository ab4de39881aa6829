// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lets programs that do not link PowerRTF::core, which has this, resolve or wrap intersections of
// the input (`Remeshing_options::intersections`). One file of the program has to include it.
#ifndef CGAL_POWER_RTF_INTERSECTIONS_H
#define CGAL_POWER_RTF_INTERSECTIONS_H

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/input/cured_soup_impl.h>

namespace CGAL::PowerRTF::internal {

inline const bool has_soup_curer = (soup_curer = &make_cured_soup) != nullptr;

} // namespace CGAL::PowerRTF::internal
#endif

#endif // CGAL_POWER_RTF_INTERSECTIONS_H
