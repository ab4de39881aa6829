// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Halfedge h = 3 f + i runs from corner i to corner i + 1 of facet f.
#ifndef CGAL_POWER_RTF_GEOMETRY_HALFEDGE_NUMBERS_H
#define CGAL_POWER_RTF_GEOMETRY_HALFEDGE_NUMBERS_H

#include <CGAL/PowerRTF/internal/host_device.h>

namespace CGAL::PowerRTF {

CGAL_POWER_RTF_HD inline int next_halfedge(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
CGAL_POWER_RTF_HD inline int previous_halfedge(int h) { return h % 3 == 0 ? h + 2 : h - 1; }

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_HALFEDGE_NUMBERS_H
