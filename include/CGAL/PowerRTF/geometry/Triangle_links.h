// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_TRIANGLE_LINKS_H
#define CGAL_POWER_RTF_GEOMETRY_TRIANGLE_LINKS_H

#include <CGAL/PowerRTF/internal/Unset_vector.h>

#include <functional>

namespace CGAL::PowerRTF {

/// How the triangles of an oriented 2-manifold hang together. Halfedge `3 f + i` runs from corner
/// `i` of triangle `f` to the next one.
struct Triangle_links {
  internal::Unset_vector<int> opposite;    ///< of each halfedge; -1: it is on the border
  internal::Unset_vector<int> last_corner; ///< by vertex: the largest halfedge from it; -1: none

  bool are_known() const { return !opposite.empty(); }
};

/// Writes the links of some triangles. Returns `false` where it does not: then they are left to the
/// caller.
using Find_links = std::function<bool(Triangle_links& links)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_TRIANGLE_LINKS_H
