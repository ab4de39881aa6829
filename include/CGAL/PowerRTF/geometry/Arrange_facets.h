// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_ARRANGE_FACETS_H
#define CGAL_POWER_RTF_GEOMETRY_ARRANGE_FACETS_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>

#include <functional>

namespace CGAL::PowerRTF {

/// Makes the tree of a surface's facets where an engine works: their order along a curve, and the
/// nodes of a `Packed_tree_layout` over them. Returns `false` where it does not: then nothing has
/// changed.
using Arrange_facets = std::function<bool(const Surface& surface, int* order, Child_boxes* nodes)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_ARRANGE_FACETS_H
