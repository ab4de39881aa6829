// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_FIND_TOPOLOGY_H
#define CGAL_POWER_RTF_GEOMETRY_FIND_TOPOLOGY_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/Triangle_links.h>

#include <functional>
#include <optional>

namespace CGAL::PowerRTF {

/// Counts, where an engine works, what there is of `n` triangles with vertices in [0, vertices),
/// if they are an oriented 2-manifold. None: they are not, or that is left to the caller.
/// `corners`: three vertices per triangle. `links`: gets those of the triangles; or null.
using Find_topology = std::function<std::optional<Topology_statistics>(
    int vertices, int n, const int* corners, Triangle_links* links)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_FIND_TOPOLOGY_H
