// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_BRING_FACETS_H
#define CGAL_POWER_RTF_GEOMETRY_BRING_FACETS_H

#include <functional>

namespace CGAL::PowerRTF {

struct Surface;

/// Brings the points and facets of a surface to where an engine works, if they are not there:
/// `Surface::resident`. Returns `false` where it does not: then they go up where they are needed.
using Bring_facets = std::function<bool(Surface& surface)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_BRING_FACETS_H
