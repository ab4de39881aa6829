// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_FIND_CLOSE_FACES_H
#define CGAL_POWER_RTF_GEOMETRY_FIND_CLOSE_FACES_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <functional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// Pairs of faces, by number.
using Face_pairs = std::vector<std::pair<int, int>>;

/// Writes the pairs of `n` faces that may intersect, where an engine works: all but those where it
/// is clear that they do not; and, as a pair with itself, each face that may have no area. They
/// come in any order, each once. `corners`: three for each face, of `vertices` points, which are
/// finite. Returns `false` where it finds none or too many: then they are left to the caller.
using Find_close_faces = std::function<bool(int vertices, const Vec3d* points, int n,
                                            const int* corners, Face_pairs& pairs)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_FIND_CLOSE_FACES_H
